#pragma once

#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/framing.h"

#include <vector>

namespace dollytrack::planning {

/// A candidate with the quality of its view.
struct EvaluatedCandidate {
    Candidate candidate;
    double quality = -1.0;  // higher is better; below 0: not legal
    double at_most = 0.0;   // upper bound of `quality` with any denser sampling; 0: no object can
                            // be captured
    int order = 0;          // tie-breaker among equal quality: the lowest order wins
    bool all_well = false;  // every object is captured well, with a margin
    std::vector<ShownObject> shown;  // objects captured well, with a margin; only after fine
                                     // sampling
    double nearness = 0.0;  // 0..2, of the worst object: min(1, visible fraction / required) +
                            // min(1, box share / required)
};

/// Estimates by estimateClosely(). If that says safely captured but only just, verifies with denser
/// grids, up to one ray per pixel, and returns the denser estimate if it disagrees. The best of
/// hundreds of candidates is often one that a sparse grid overrates.
[[nodiscard]] ViewEstimator::Estimate estimateSurely(const ViewEstimator& views, const Pose& pose,
                                                     int object_id, int grid);

/// Quality of a view that shows all objects fully and at the wished size.
[[nodiscard]] double highestQuality();

/// Sampling density of a candidate's view: rays along each side of an object's extent.
enum class SamplingDensity : int { Coarse = 8, Medium = 14, Fine = 24 };

/// Evaluates candidate positions for one observation point: first whether they are legal, then the
/// view by ray sampling. Keeps references. Immutable.
class CandidateEvaluator {
  public:
    CandidateEvaluator(const PlanningEnvironment& environment, const ObservationPoint& point,
                       double wished_fill);

    [[nodiscard]] EvaluatedCandidate evaluate(const Eigen::Vector3d& position,
                                              SamplingDensity density) const;

    [[nodiscard]] const Subject& subject() const { return subject_; }
    [[nodiscard]] double wishedFill() const { return wished_fill_; }

  private:
    [[nodiscard]] Verdict placeVerdict(const Eigen::Vector3d& position, double fill,
                                       int& obstacle) const;
    [[nodiscard]] Verdict viewVerdict(const Pose& pose) const;
    [[nodiscard]] bool isHopeless(const Pose& pose, EvaluatedCandidate& evaluated) const;

    const PlanningEnvironment& environment_;
    const ObservationPoint& point_;
    Subject subject_;
    double wished_fill_;
};

/// See EvaluatedCandidate::nearness. `fraction_margin` is added to the required visible fraction;
/// the required box share is multiplied by `area_margin`.
double nearnessOf(const ViewEstimator::Estimate& estimate, double fraction_margin = 0.0,
                  double area_margin = 1.0);

/// Whether the estimate passes the capture rules with a margin for the difference between sampling
/// rays and rendered pixels.
bool isSafelyWellCaptured(const ViewEstimator::Estimate& estimate);
bool isSafelyCaptured(const ViewEstimator::Estimate& estimate);

}  // namespace dollytrack::planning
