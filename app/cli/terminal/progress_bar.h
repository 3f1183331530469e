#pragma once

#include "engine/jobs/job.h"

#include <memory>
#include <string>

namespace dollytrack::cli {

/// Progress for a person: on a terminal one line that is redrawn, with rate and time left;
/// elsewhere a plain line every ten seconds and at the end. Copies share the line.
class ProgressBar {
  public:
    ProgressBar();

    /// Called with rising fractions; `note` is what is being done.
    void show(double fraction, const std::string& note) const;
    /// Ends the line, so that other output starts on a fresh one. Also done by the last copy.
    void finish() const;

    [[nodiscard]] JobContext::Progress callback() const;

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace dollytrack::cli
