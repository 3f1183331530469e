#pragma once

#include "engine/jobs/job.h"

#include <memory>
#include <string>

namespace dollytrack::cli {

/// Progress display for users: on a terminal one line that is redrawn, with the time left;
/// otherwise a plain line every ten seconds. Copies share the line.
class ProgressBar {
  public:
    ProgressBar();

    /// Shows a fraction, 0..1; `note` names the current stage. Calls within the redraw interval are
    /// ignored.
    void show(double fraction, const std::string& note) const;
    /// Clears the line, so that other output starts on a fresh one. The last copy's destructor does
    /// the same.
    void finish() const;

    [[nodiscard]] JobContext::Progress callback() const;

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace dollytrack::cli
