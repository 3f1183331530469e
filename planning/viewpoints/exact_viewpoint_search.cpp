#include "planning/viewpoints/exact_viewpoint_search.h"

#include "engine/jobs/parallel.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr double kNearlyThere = 1.94;  // least nearness, by exact estimates, at which the search
                                       // continues
constexpr std::size_t kClimbParents = 5;
constexpr std::size_t kClimbChildren = 48;
constexpr int kClimbGenerations = 30;
constexpr double kClimbFirstSpread = 0.15;  // relative to the distance to the target
constexpr double kLeastSpread = 0.005;
constexpr double kClimbShrinking = 0.6;  // factor of the spread if no child is better than its
                                         // parents

struct Looked {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double nearness = 0.0;  // see Judged::nearness; without margins
    bool well = false;
};

class Climb {
  public:
    Climb(const PlanningEnvironment& environment, const CandidateJudge& judge, int object_id)
        : environment_(environment), judge_(judge), object_id_(object_id) {}

    [[nodiscard]] Looked look(const Eigen::Vector3d& position) const {
        const Pose pose = aim(position, judge_.subject().center, environment_.pitch);
        const auto seen = environment_.views.estimateExactly(pose, object_id_);
        return {position, nearnessOf(seen), isWellCaptured(makeView(seen, object_id_, 0))};
    }

    /// Random positions around the parents that are legal and near enough by a coarser estimate.
    [[nodiscard]] std::vector<Looked> lookBeside(const std::vector<Looked>& parents, double spread,
                                                 Random& random, std::vector<Judged>& tried) const {
        std::vector<Eigen::Vector3d> places;
        for (std::size_t i = 0; i < kClimbChildren; ++i) {
            const Eigen::Vector3d& parent = parents[i % parents.size()].position;
            const Eigen::Vector3d offset(random.normal(), random.normal(), random.normal());
            const double distance = (parent - judge_.subject().center).norm();
            places.push_back(environment_.sphere.onHeight(parent + spread * distance * offset));
        }
        std::vector<Judged> glances(places.size());
        std::vector<Looked> looked(places.size());
        parallelFor(places.size(), [&](std::size_t i) {
            glances[i] = judge_.judge(places[i], Look::Closer);
            if (glances[i].nearness >= kPromisingNearness) looked[i] = look(places[i]);
        });
        tried.insert(tried.end(), glances.begin(), glances.end());
        std::erase_if(looked, [](const Looked& one) { return one.nearness == 0.0; });
        return looked;
    }

  private:
    const PlanningEnvironment& environment_;
    const CandidateJudge& judge_;
    int object_id_;
};

void keepBest(std::vector<Looked>& looked) {
    std::stable_sort(looked.begin(), looked.end(), [](const Looked& a, const Looked& b) {
        return std::pair(a.well, a.nearness) > std::pair(b.well, b.nearness);
    });
    looked.resize(std::min(looked.size(), kClimbParents));
}

}  // namespace

ExactSearchResult searchExactViewpoint(const PlanningEnvironment& environment,
                                       const CandidateJudge& judge, int object_id,
                                       const std::vector<Eigen::Vector3d>& places, Random& random) {
    const Climb climb(environment, judge, object_id);
    ExactSearchResult climbed;
    std::vector<Looked> best;
    for (std::size_t i = 0; i < std::min(kClimbParents, places.size()); ++i) {
        best.push_back(climb.look(places[i]));
    }
    if (best.empty()) return climbed;
    keepBest(best);
    double spread = kClimbFirstSpread;
    for (int generation = 0; generation < kClimbGenerations; ++generation) {
        const Looked before = best.front();
        if (before.well || before.nearness < kNearlyThere || spread < kLeastSpread) break;
        const auto children = climb.lookBeside(best, spread, random, climbed.tried);
        best.insert(best.end(), children.begin(), children.end());
        keepBest(best);
        if (best.front().nearness <= before.nearness) spread *= kClimbShrinking;
    }
    if (best.front().well) climbed.place = best.front().position;
    return climbed;
}

}  // namespace dollytrack::planning
