#pragma once

#include "engine/plan/plan.h"

#include <map>
#include <string>
#include <utility>

namespace dollytrack::planning {

/// Counts the verdicts on candidates for views of one object, and names the stage at which the last
/// of them were lost: a candidate must be free, then unoccluded, then large enough, then completely
/// in the image.
class CandidateTally {
  public:
    void add(const Candidate& candidate);

    [[nodiscard]] int tried() const { return tried_; }
    [[nodiscard]] int legal() const { return legal_; }

    /// The first of NoFreePose, Occluded, TooSmall and DoesNotFit after which no candidate was
    /// left.
    [[nodiscard]] Loss loss() const;

    /// If loss() is Occluded: the id of the object that hides the target in most candidate views; 0
    /// if the target hides itself.
    [[nodiscard]] int occluder() const;

    /// A sentence that says at which stage the last candidates were lost, with their counts.
    [[nodiscard]] std::string reason(const Scene& scene) const;

    /// "too close to wall (12), hidden by sofa (3)": the most frequent reasons, at most `kinds`.
    [[nodiscard]] std::string refusals(const Scene& scene, std::size_t kinds = 2) const;

  private:
    [[nodiscard]] int inSight() const { return small_ + cropped_ + legal_; }
    [[nodiscard]] int free() const { return hidden_ + inSight(); }

    int tried_ = 0;
    int legal_ = 0;
    int hidden_ = 0;
    int small_ = 0;
    int cropped_ = 0;
    double most_visible_ = 0.0;  // visible fraction, over the free candidates
    std::map<int, int> hidden_by_;
    std::map<std::pair<Verdict, int>, int> refused_;  // by verdict and object
};

/// Tally of the candidates for the object: of its own search if there was one, else of its groups.
CandidateTally tallyOf(const Plan& plan, int object_id);

}  // namespace dollytrack::planning
