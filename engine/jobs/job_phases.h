#pragma once

#include "engine/jobs/job.h"

#include <string>
#include <utility>
#include <vector>

namespace dollytrack {

/// Divides a job among phases that follow each other, in proportion to the time that each is
/// expected to take.
class JobPhases {
  public:
    struct Phase {
        std::string name;
        double weight = 0.0;  // expected time in any unit; 0: the phase is left out
    };

    JobPhases(JobContext job, std::vector<Phase> phases)
        : job_(std::move(job)), phases_(std::move(phases)) {
        for (const Phase& phase : phases_) total_ += phase.weight;
    }

    /// The context of the phase with this name. A phase that was not listed has no share: it begins
    /// and ends at the end of the job.
    [[nodiscard]] JobContext of(const std::string& name) const {
        if (total_ <= 0.0) return job_.stage(0.0, 1.0, name);
        double before = 0.0;
        for (const Phase& phase : phases_) {
            const double after = before + phase.weight;
            if (phase.name == name) return job_.stage(before / total_, after / total_, name);
            before = after;
        }
        return job_.stage(1.0, 1.0, name);
    }

  private:
    JobContext job_;
    std::vector<Phase> phases_;
    double total_ = 0.0;
};

}  // namespace dollytrack
