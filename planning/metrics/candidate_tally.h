#pragma once

#include "engine/plan/plan.h"

#include <map>
#include <string>
#include <utility>

namespace dollytrack::planning {

/// What became of places tried for a view of one object, counted; and where the last of them were
/// lost: a place has to be free, then in sight, then large enough, then whole in the image.
class CandidateTally {
  public:
    void add(const Candidate& candidate);

    [[nodiscard]] int tried() const { return tried_; }
    [[nodiscard]] int legal() const { return legal_; }

    /// The first of NoFreePose, Occluded, TooSmall and DoesNotFit after which no place was left.
    [[nodiscard]] Loss loss() const;

    /// With Occluded: what hides it most often; 0 when it hides itself.
    [[nodiscard]] int occluder() const;

    /// A sentence with the numbers, for loss().
    [[nodiscard]] std::string reason(const Scene& scene) const;

    /// "too near to wall (12), hidden by sofa (3)", most frequent first; at most `kinds` of them.
    [[nodiscard]] std::string refusals(const Scene& scene, std::size_t kinds = 2) const;

  private:
    [[nodiscard]] int inSight() const { return small_ + cropped_ + legal_; }
    [[nodiscard]] int free() const { return hidden_ + inSight(); }

    int tried_ = 0;
    int legal_ = 0;
    int hidden_ = 0;
    int small_ = 0;
    int cropped_ = 0;
    double most_visible_ = 0.0;  // share, of the free places
    std::map<int, int> hidden_by_;
    std::map<std::pair<Verdict, int>, int> refused_;  // by verdict and object
};

/// The places tried for the object: alone if it was searched for alone, else for its group.
CandidateTally tallyOf(const Plan& plan, int object_id);

}  // namespace dollytrack::planning
