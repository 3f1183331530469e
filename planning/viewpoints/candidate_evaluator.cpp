#include "planning/viewpoints/candidate_evaluator.h"

#include "planning/collision/swept_sphere.h"
#include "planning/viewpoints/gap_test.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr double kFractionMargin = 0.04;
constexpr double kAreaMargin = 1.12;
constexpr double kSure = 0.92;  // visible fraction at which sampling errors cannot exceed the
                                // margin
// A quarter of the exact grid's rays decides, unless their result is this close to the rule.
constexpr int kNearlyExactGrid = 36;
constexpr double kClear = 0.02;  // of the visible fraction
// Step by which visible fractions are rounded, so that a last sliver does not outweigh fill.
constexpr double kFractionStep = 0.03;
constexpr int kScreeningGrid = 4;
constexpr double kHopeless = 0.45;   // well below what counts as captured
constexpr double kMayCapture = 0.6;  // least visible fraction that denser sampling may correct to
                                     // captured

double seenInSteps(double visible_fraction) {
    return std::round(visible_fraction / kFractionStep) * kFractionStep;
}

constexpr double kCapturedWorth = 1.0;
constexpr double kWellWorth = 2.0;

}  // namespace

double nearnessOf(const ViewEstimator::Estimate& estimate, double fraction_margin,
                  double area_margin) {
    const CaptureRules rules;
    return std::min(1.0,
                    estimate.visible_fraction / (rules.min_visible_fraction + fraction_margin)) +
           std::min(1.0, estimate.box_share / (rules.min_box_share * area_margin));
}

bool isSafelyCaptured(const ViewEstimator::Estimate& estimate) {
    const CaptureRules rules;
    return estimate.visible_fraction >= rules.min_visible_fraction + kFractionMargin &&
           estimate.visible_px >= rules.min_visible_px * kAreaMargin;
}

bool isSafelyWellCaptured(const ViewEstimator::Estimate& estimate) {
    return isSafelyCaptured(estimate) &&
           estimate.box_share >= CaptureRules{}.min_box_share * kAreaMargin;
}

ViewEstimator::Estimate estimateSurely(const ViewEstimator& views, const Pose& pose, int object_id,
                                       int grid) {
    const auto close = views.estimateClosely(pose, object_id, grid);
    if (!isSafelyCaptured(close) || close.visible_fraction >= kSure) return close;
    const bool well = isSafelyWellCaptured(close);
    const double least = CaptureRules{}.min_visible_fraction;
    const auto nearly = views.estimate(pose, object_id, kNearlyExactGrid);
    if (nearly.visible_fraction < least - kClear) return nearly;
    if (nearly.visible_fraction >= least + kClear &&
        (well ? isSafelyWellCaptured(nearly) : isSafelyCaptured(nearly))) {
        return close;
    }
    const auto exact = views.estimateExactly(pose, object_id);
    const ObjectView view = makeView(exact, object_id, 0);
    return isWellCaptured(view) || (!well && isCaptured(view)) ? close : exact;
}

double highestQuality() {
    return seenInSteps(1.0) + kCapturedWorth + kWellWorth;
}

CandidateEvaluator::CandidateEvaluator(const PlanningEnvironment& environment,
                                       const ObservationPoint& point, double wished_fill)
    : environment_(environment),
      point_(point),
      subject_(makeSubject(environment.views, point.objects)) {
    // The wished fill is meant as an area: an object as high as wide takes fill * fill of the
    // square on the shorter side, a slender one less. So slender objects get a larger fill, up to
    // 0.85, and up to 0.92 until the box is large enough to count as well captured.
    const double slender =
        std::max(1e-3, slenderness(environment.views, subject_, point.direction));
    const double shorter =
        static_cast<double>(
            std::min(environment.views.intrinsics().width, environment.views.intrinsics().height)) /
        std::max(environment.views.intrinsics().width, environment.views.intrinsics().height);
    const double as_square = wished_fill * std::sqrt(std::max(1.0, shorter / slender));
    const double needed = std::sqrt(1.3 * CaptureRules{}.min_box_share / slender);
    wished_fill_ = std::max({wished_fill, std::min(as_square, 0.85), std::min(needed, 0.92)});
}

Verdict CandidateEvaluator::placeVerdict(const Eigen::Vector3d& position, double fill,
                                         int& obstacle) const {
    if (!std::isfinite(fill)) return Verdict::TooClose;
    const Verdict verdict = environment_.sphere.verdict(position, obstacle);
    if (verdict != Verdict::InObstacle) return verdict;
    const bool own =
        std::find(point_.objects.begin(), point_.objects.end(), obstacle) != point_.objects.end();
    return own ? Verdict::TooClose : Verdict::InObstacle;
}

/// Whether a legal position is in a gap between surfaces, or sees too little of a scan.
Verdict CandidateEvaluator::viewVerdict(const Pose& pose) const {
    if (isInGap(environment_.sphere, environment_.views, pose.position)) return Verdict::InGap;
    return environment_.views.scannedShare(pose) < CaptureRules{}.min_scanned_share
               ? Verdict::Unscanned
               : Verdict::Legal;
}

/// Samples with few rays first: most bad candidates hide most of the target and need no more.
bool CandidateEvaluator::isHopeless(const Pose& pose, EvaluatedCandidate& evaluated) const {
    for (const int id : point_.objects) {
        const auto coarse = environment_.views.estimate(pose, id, kScreeningGrid);
        if (!coarse.tells() || coarse.visible_fraction >= kHopeless) continue;
        evaluated.candidate.visible_fraction = coarse.visible_fraction;
        evaluated.candidate.occluder = coarse.occluder;
        evaluated.candidate.verdict = coarse.occluder == 0 ? Verdict::Cropped : Verdict::OccludedBy;
        return true;
    }
    return false;
}

EvaluatedCandidate CandidateEvaluator::evaluate(const Eigen::Vector3d& position,
                                                SamplingDensity density) const {
    EvaluatedCandidate evaluated;
    evaluated.candidate.position = position;
    evaluated.candidate.fill = fillFrom(environment_.views, subject_, position);
    evaluated.candidate.verdict =
        placeVerdict(position, evaluated.candidate.fill, evaluated.candidate.occluder);
    if (evaluated.candidate.verdict != Verdict::Legal) return evaluated;

    const Pose pose = aim(position, subject_.center, environment_.pitch);
    if (density != SamplingDensity::Fine && isHopeless(pose, evaluated)) return evaluated;
    evaluated.candidate.verdict = viewVerdict(pose);
    if (evaluated.candidate.verdict != Verdict::Legal) return evaluated;
    double sum = 0.0;
    double worst = 1.0;
    int occluder = 0;
    bool cropped = false;
    bool too_small = false;
    bool may_capture = false;
    evaluated.all_well = true;
    evaluated.nearness = 2.0;
    bool all_captured = true;
    for (const int id : point_.objects) {
        const int grid = static_cast<int>(density);
        const auto estimate = density == SamplingDensity::Fine
                                  ? estimateSurely(environment_.views, pose, id, grid)
                                  : environment_.views.estimate(pose, id, grid);
        const bool well = isSafelyWellCaptured(estimate);
        const bool captured = isSafelyCaptured(estimate);
        evaluated.all_well &= well;
        if (well && density == SamplingDensity::Fine)
            evaluated.shown.push_back({id, estimate.box_share});
        all_captured &= captured;
        evaluated.nearness =
            std::min(evaluated.nearness, nearnessOf(estimate, kFractionMargin, kAreaMargin));
        if (estimate.visible_fraction < worst) {
            worst = estimate.visible_fraction;
            occluder = estimate.occluder;
            cropped = estimate.cropped && occluder == 0;
        }
        too_small |= estimate.visible_px < CaptureRules{}.min_visible_px;
        may_capture |= !estimate.tells() || estimate.visible_fraction >= kMayCapture;
        sum += seenInSteps(estimate.visible_fraction) + (captured ? kCapturedWorth : 0.0) +
               (well ? kWellWorth : 0.0);
    }
    evaluated.candidate.visible_fraction = worst;
    // A view that crops its target still shows most of it, so cropping only lowers the quality.
    const double over = std::max(0.0, evaluated.candidate.fill - 0.95);
    const double off = std::abs(std::log(std::max(evaluated.candidate.fill, 0.01) / wished_fill_));
    const double lost = 0.3 * off + over;
    evaluated.quality = sum / static_cast<double>(point_.objects.size()) - lost;
    evaluated.at_most = may_capture ? highestQuality() - lost : 0.0;
    if (!all_captured) {
        evaluated.candidate.occluder = occluder;
        evaluated.candidate.verdict = cropped     ? Verdict::Cropped
                                      : occluder  ? Verdict::OccludedBy
                                      : too_small ? Verdict::TooSmall
                                                  : Verdict::OccludedBy;
    }
    return evaluated;
}

}  // namespace dollytrack::planning
