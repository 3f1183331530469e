#include "planning/viewpoints/exact_viewpoint_search.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr double kNearlyThere = 1.94;  // least nearness, by exact estimates, at which the search
                                       // continues
constexpr std::size_t kExactParents = 5;
constexpr std::size_t kExactChildren = 48;
constexpr int kExactGenerations = 30;
constexpr double kExactFirstSpread = 0.15;  // relative to the distance to the target
constexpr double kLeastSpread = 0.005;
constexpr double kExactShrinking = 0.6;  // factor of the spread if no child is better than its
                                         // parents

struct ExactCandidate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double nearness = 0.0;  // see EvaluatedCandidate::nearness; without margins
    bool well = false;
};

class ExactEstimator {
  public:
    ExactEstimator(const PlanningEnvironment& environment, const CandidateEvaluator& evaluator,
                   int object_id)
        : environment_(environment), evaluator_(evaluator), object_id_(object_id) {}

    [[nodiscard]] ExactCandidate estimate(const Eigen::Vector3d& position) const {
        const Pose pose = aim(position, evaluator_.subject().center, environment_.pitch);
        const auto seen = environment_.views.estimateExactly(pose, object_id_);
        return {position, nearnessOf(seen), isWellCaptured(makeView(seen, object_id_, 0))};
    }

    /// Random positions around the parents that are legal and near enough by a coarser estimate.
    [[nodiscard]] std::vector<ExactCandidate> sampleAround(
        const std::vector<ExactCandidate>& parents, double spread, Random& random,
        std::vector<EvaluatedCandidate>& tried) const {
        std::vector<Eigen::Vector3d> places;
        for (std::size_t i = 0; i < kExactChildren; ++i) {
            const Eigen::Vector3d& parent = parents[i % parents.size()].position;
            const Eigen::Vector3d offset(random.normal(), random.normal(), random.normal());
            const double distance = (parent - evaluator_.subject().center).norm();
            places.push_back(environment_.sphere.onHeight(parent + spread * distance * offset));
        }
        std::vector<EvaluatedCandidate> sampled(places.size());
        std::vector<ExactCandidate> refined(places.size());
        parallelFor(places.size(), [&](std::size_t i) {
            sampled[i] = evaluator_.evaluate(places[i], SamplingDensity::Medium);
            if (sampled[i].nearness >= kPromisingNearness) refined[i] = estimate(places[i]);
        });
        tried.insert(tried.end(), sampled.begin(), sampled.end());
        std::erase_if(refined, [](const ExactCandidate& one) { return one.nearness == 0.0; });
        return refined;
    }

  private:
    const PlanningEnvironment& environment_;
    const CandidateEvaluator& evaluator_;
    int object_id_;
};

void keepBest(std::vector<ExactCandidate>& refined) {
    std::stable_sort(refined.begin(), refined.end(),
                     [](const ExactCandidate& a, const ExactCandidate& b) {
                         return std::pair(a.well, a.nearness) > std::pair(b.well, b.nearness);
                     });
    refined.resize(std::min(refined.size(), kExactParents));
}

}  // namespace

ExactSearchResult searchExactViewpoint(const PlanningEnvironment& environment,
                                       const CandidateEvaluator& evaluator, int object_id,
                                       const std::vector<Eigen::Vector3d>& places, Random& random) {
    const ExactEstimator estimator(environment, evaluator, object_id);
    ExactSearchResult result;
    std::vector<ExactCandidate> best;
    for (std::size_t i = 0; i < std::min(kExactParents, places.size()); ++i) {
        best.push_back(estimator.estimate(places[i]));
    }
    if (best.empty()) return result;
    keepBest(best);
    double spread = kExactFirstSpread;
    for (int generation = 0; generation < kExactGenerations; ++generation) {
        const ExactCandidate before = best.front();
        if (before.well || before.nearness < kNearlyThere || spread < kLeastSpread) break;
        const auto children = estimator.sampleAround(best, spread, random, result.tried);
        best.insert(best.end(), children.begin(), children.end());
        keepBest(best);
        if (best.front().nearness <= before.nearness) spread *= kExactShrinking;
    }
    if (best.front().well) result.place = best.front().position;
    return result;
}

}  // namespace dollytrack::planning
