#pragma once

#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/framing.h"

#include <vector>

namespace dollytrack::planning {

/// A candidate with what its view is worth.
struct Judged {
    Candidate candidate;
    double quality = -1.0;  // below 0: not legal
    double at_most = 0.0;   // no finer look values the place higher; 0: nor captures anything
    int order = 0;          // among candidates of equal quality the first is taken
    bool all_well = false;  // every object is captured well, with a margin
    std::vector<ShownObject> shown;  // by a fine look: those captured well, with a margin
    double nearness = 0.0;  // 0..2, of the worst object: how much of what capturing it well asks
                            // for is reached, by its visible fraction and by its box
};

/// By a close look; where that finds the object safely captured with little to spare, and every
/// pixel says that it is not, by every pixel. Of hundreds of places the best is often one that some
/// rays flatter.
[[nodiscard]] ViewEstimator::Estimate estimateSurely(const ViewEstimator& views, const Pose& pose,
                                                     int object_id, int grid);

/// Quality of a view that shows all in full and as large as wished for.
[[nodiscard]] double highestQuality();

/// How carefully a candidate is looked at: rays along each side of each object's extent.
enum class Look : int { Coarse = 8, Closer = 14, Fine = 24 };

/// Judges places for one observation point: legality first, the view by rays second.
class CandidateJudge {
  public:
    CandidateJudge(const Surroundings& around, const ObservationPoint& point, double wished_fill);

    [[nodiscard]] Judged judge(const Eigen::Vector3d& position, Look look) const;

    [[nodiscard]] const Subject& subject() const { return subject_; }
    [[nodiscard]] double wishedFill() const { return wished_fill_; }

  private:
    [[nodiscard]] Verdict placeVerdict(const Eigen::Vector3d& position, double fill,
                                       int& obstacle) const;
    [[nodiscard]] Verdict viewVerdict(const Pose& pose) const;
    [[nodiscard]] bool isHopeless(const Pose& pose, Judged& judged) const;

    const Surroundings& around_;
    const ObservationPoint& point_;
    Subject subject_;
    double wished_fill_;
};

/// See Judged::nearness; the margins are added to the fraction asked for, and times the box.
double nearnessOf(const ViewEstimator::Estimate& estimate, double fraction_margin = 0.0,
                  double area_margin = 1.0);

/// Estimates by rays and pixels of drawings differ a little: what is to count as well captured
/// must pass the rules with this much to spare.
bool isSafelyWellCaptured(const ViewEstimator::Estimate& estimate);
bool isSafelyCaptured(const ViewEstimator::Estimate& estimate);

}  // namespace dollytrack::planning
