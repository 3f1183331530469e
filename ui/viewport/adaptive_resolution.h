#pragma once

#include "render/view/view.h"

#include <chrono>

namespace dollytrack::ui {

/// Chooses the resolution of the viewport so that it follows the mouse: reduced while the view
/// moves and a full image takes longer than kFluent_ms, full once the view rests.
class AdaptiveResolution {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// After this time without a change the view rests and is drawn in full resolution; after as
    /// long as a full image takes, if that is longer, so that an uneven drag does not wait for one.
    static constexpr std::chrono::milliseconds kRest{150};
    static constexpr double kFluent_ms = 50.0;  // full images that take no longer are not reduced

    /// Returns by how much width and height are divided: 1 (full), 2 or 3. `same`: the view equals
    /// the previous one; only its overlays may differ.
    [[nodiscard]] int shrinkFor(bool same, Time now) const;

    /// Records a drawn image. Only a full image (shrink 1) that included the scene updates the
    /// measured time.
    void drew(int shrink, bool same, bool scene, double milliseconds, Time now);
    /// Resets the measurement, for a different scene.
    void forget() { *this = {}; }

    /// The time at which the view counts as resting.
    [[nodiscard]] Time restsAt() const;

  private:
    double whole_ms_ = 0.0;
    int shrink_ = 1;
    Time moved_;  // when a new view was last drawn
};

/// Whether two views of an unchanged scene give the same image.
[[nodiscard]] bool samePicture(const render::View& a, const render::View& b);

/// The same view with its width and height divided by `by`.
[[nodiscard]] render::View shrunk(render::View view, int by);

}  // namespace dollytrack::ui
