#pragma once

#include "app/editor/timeline/play_clock.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace dollytrack::editor {

/// Progress of the step-by-step display of the roadmap search.
class StepPlayback {
  public:
    /// The next number of steps to stop at; nullopt at the end.
    using Next = std::function<std::optional<std::size_t>(std::size_t taken)>;

    [[nodiscard]] std::size_t taken() const { return taken_; }
    [[nodiscard]] bool playing() const { return clock_.runs(); }
    /// Whether the viewport shows the roadmap as it was built up to here instead of the finished
    /// one.
    [[nodiscard]] bool shown() const { return shown_; }

    void show(bool shown) { shown_ = shown; }
    void goTo(std::size_t taken) { taken_ = taken; }
    /// Starts or stops playing; without a next stop, starts from the beginning.
    void toggle(const Next& next);
    void advance(double steps, const Next& next);

  private:
    std::size_t taken_ = 0;
    bool shown_ = false;
    PlayClock clock_;
};

}  // namespace dollytrack::editor
