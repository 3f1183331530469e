#include "planning/viewpoints/viewpoint_search.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/plan_params.h"
#include "planning/targets/observation_points.h"
#include "planning/viewpoints/candidate_judge.h"
#include "planning/viewpoints/candidate_source.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

namespace dollytrack::planning {
namespace {

constexpr int kExactGrid = 64;  // decides about objects that can be captured only just
constexpr int kRefined = 5;     // candidates looked at again with the fine grid
constexpr int kConeDirections = 20;
constexpr int kAroundDirections = 64;
constexpr int kRandomPlaces = 160;
constexpr int kEnoughGood = 12;
constexpr double kWorthClimbing = 0.5;  // visible fraction
constexpr int kClimbRounds = 6;
constexpr int kClimbTries = 14;
// The range of fill that the paper searches.
constexpr double kLeastFill = 0.35;
constexpr double kMostFill = 0.85;

/// The search for one observation point.
class Search {
  public:
    Search(const Surroundings& around, const ObservationPoint& point, const ViewpointParams& params,
           Random random)
        : around_(around),
          point_(point),
          params_(params),
          judge_(around, point, params.fill),
          random_(random) {}

    FoundView run() {
        const double half_angle = params_.cone_half_angle_deg * std::numbers::pi / 180.0;
        tryDirections(directionsInCone(point_.direction, half_angle, kConeDirections),
                      {1.0, 0.8, 1.25});
        // A group whose cone holds no good view is split; only single objects are worth more
        // search.
        if (!refineBest() && point_.objects.size() == 1) {
            tryDirections(directionsAllAround(point_.direction, kAroundDirections),
                          {1.0, 0.75, 0.55});
            if (!refineBest()) {
                for (const Eigen::Vector3d& place :
                     randomPlaces(around_.free_space, around_.sphere, around_.views,
                                  judge_.subject(), 0.08, 1.3, kRandomPlaces, random_)) {
                    tryPlace(place);
                }
                if (!refineBest()) climb();
            }
        }
        return finish();
    }

  private:
    void tryDirections(const std::vector<Eigen::Vector3d>& directions,
                       const std::vector<double>& shares_of_wish) {
        const double wish = judge_.wishedFill();
        for (const Eigen::Vector3d& direction : directions) {
            // Directions come with the best first: among so many good views there is a best one.
            const auto good = std::count_if(pending_.begin(), pending_.end(),
                                            [](const Judged& judged) { return judged.all_well; });
            if (good >= kEnoughGood) break;
            for (const double share : shares_of_wish) {
                const double fill =
                    std::clamp(share * wish, std::min(kLeastFill, wish), std::max(kMostFill, wish));
                const double distance =
                    distanceForFill(around_.views, judge_.subject(), direction, fill);
                // With a band of heights most directions lead out of it: keep to it instead.
                tryPlace(around_.sphere.inBand(judge_.subject().center + direction * distance));
            }
        }
    }

    void tryPlace(const Eigen::Vector3d& place) {
        Judged judged = judge_.judge(place, Look::Coarse);
        candidates_.push_back(judged.candidate);
        if (judged.quality < 0.0) return;
        judged.order = static_cast<int>(pending_.size());
        pending_.push_back(std::move(judged));
    }

    /// Looks again, finer, at the best of what is new; true when the best found captures all well.
    bool refineBest() {
        const auto count = std::min<std::size_t>(kRefined, pending_.size());
        std::partial_sort(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(count),
                          pending_.end(), [](const Judged& a, const Judged& b) {
                              return std::pair(a.quality, b.order) > std::pair(b.quality, a.order);
                          });
        for (std::size_t i = 0; i < count; ++i) {
            Judged fine = judge_.judge(pending_[i].candidate.position, Look::Fine);
            if (!best_ || fine.quality > best_->quality) best_ = std::move(fine);
        }
        pending_.clear();
        return best_ && best_->all_well;
    }

    /// Moves the best place found about in shrinking steps, as long as the view improves. What no
    /// sample captures well often lies just beside one.
    void climb() {
        if (!best_ || best_->candidate.visible_fraction < kWorthClimbing) return;
        double step = 0.25 * (best_->candidate.position - judge_.subject().center).norm();
        for (int round = 0; round < kClimbRounds && !best_->all_well; ++round) {
            const Eigen::Vector3d from = best_->candidate.position;
            std::optional<Judged> better;
            for (int i = 0; i < kClimbTries; ++i) {
                const Eigen::Vector3d offset(random_.normal(), random_.normal(), random_.normal());
                Judged tried = judge_.judge(from + step * offset, Look::Closer);
                if (tried.quality > (better ? better->quality : best_->quality)) {
                    better = std::move(tried);
                }
            }
            if (better) better = judge_.judge(better->candidate.position, Look::Fine);
            if (better && better->quality > best_->quality) {
                best_ = std::move(better);
            } else {
                step *= 0.5;
            }
        }
    }

    FoundView finish() {
        FoundView found;
        found.search.candidates = std::move(candidates_);
        if (!best_) {
            found.not_well = point_.objects;
            return found;
        }
        PositionPoint p;
        p.pose = lookAt(best_->candidate.position, judge_.subject().center);
        p.component = around_.free_space.componentAt(p.pose.position);
        p.fill = best_->candidate.fill;
        for (const int id : point_.objects) {
            // By every pixel and without the margins: this very pose is flown to, and an object
            // that can be captured only just is better captured than not.
            const ObjectView view = makeView(around_.views.estimate(p.pose, id, kExactGrid), id, 0);
            if (isWellCaptured(view)) {
                p.well_captured.push_back(id);
            } else {
                found.not_well.push_back(id);
            }
            if (isCaptured(view)) p.captured.push_back(id);
        }
        if (!p.captured.empty()) found.best = std::move(p);
        return found;
    }

    const Surroundings& around_;
    const ObservationPoint& point_;
    const ViewpointParams& params_;
    CandidateJudge judge_;
    Random random_;
    std::vector<Candidate> candidates_;
    std::vector<Judged> pending_;
    std::optional<Judged> best_;
};

/// Random numbers of a search's own: by its first object, and whether it is alone in it.
std::uint64_t streamOf(const ObservationPoint& point) {
    const auto id = static_cast<std::uint64_t>(point.objects.front());
    return 2 * id + (point.objects.size() > 1 ? 1 : 0);
}

}  // namespace

const FoundView* SearchMemo::find(const ObservationPoint& point) const {
    const auto entry = entries_.find(point.objects);
    return entry != entries_.end() && entry->second.point == point ? &entry->second.found : nullptr;
}

void SearchMemo::keep(const ObservationPoint& point, FoundView found) {
    entries_.insert_or_assign(point.objects, Entry{point, std::move(found)});
}

Result<Viewpoints> searchViewpoints(const Surroundings& around,
                                    std::vector<ObservationPoint> observation_points,
                                    const ViewpointParams& params, int seed, const JobContext& job,
                                    SearchMemo* memo) {
    Viewpoints result;
    result.observation_points = std::move(observation_points);
    std::size_t begin = 0;
    // The second round searches for the members that the first split off their groups.
    for (int round = 0; round < 2; ++round) {
        const std::size_t end = result.observation_points.size();
        std::vector<FoundView> found(end - begin);
        std::atomic<bool> cancelled = false;
        parallelFor(found.size(), [&](std::size_t i) {
            if (cancelled || job.cancelled()) {
                cancelled = true;
                return;
            }
            const ObservationPoint& point = result.observation_points[begin + i];
            if (const FoundView* known = memo ? memo->find(point) : nullptr) {
                found[i] = *known;
                return;
            }
            found[i] = Search(around, point, params,
                              Random(static_cast<std::uint64_t>(seed), streamOf(point)))
                           .run();
        });
        if (cancelled) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        job.report(round == 0 ? 0.7 : 1.0);

        for (std::size_t i = 0; i < found.size(); ++i) {
            const ObservationPoint point = result.observation_points[begin + i];
            if (memo) memo->keep(point, found[i]);
            if (found[i].best) {
                found[i].best->observation_point = static_cast<int>(begin + i);
                found[i].search.position_point = static_cast<int>(result.position_points.size());
                result.position_points.push_back(std::move(*found[i].best));
            }
            result.searches.push_back(std::move(found[i].search));
            if (point.objects.size() < 2) continue;
            for (const int id : found[i].not_well) {
                result.observation_points.push_back(alone(around.views, point, id));
            }
        }
        begin = end;
    }
    return result;
}

}  // namespace dollytrack::planning
