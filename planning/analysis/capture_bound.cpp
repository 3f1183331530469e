#include "planning/analysis/capture_bound.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/remedies/remedy_proposals.h"
#include "planning/viewpoints/candidate_source.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/coarse_grid.h"
#include "planning/visibility/framing.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr int kDirections = 900;
constexpr int kRandomPlaces = 4000;
constexpr std::size_t kRefined = 80;

struct Reach {
    bool captured = false;
    bool well = false;
};

class DenseSearch {
  public:
    DenseSearch(const PlanningEnvironment& environment, int object_id, int seed,
                const JobContext& job)
        : environment_(environment),
          object_id_(object_id),
          seed_(seed),
          subject_(makeSubject(environment.views, {object_id})),
          random_(static_cast<std::uint64_t>(seed),
                  static_cast<std::uint64_t>(object_id) + 100'000U),
          job_(job) {}

    Reach run(const Plan& plan) {
        for (const ObjectCapture& capture : plan.captures) {
            if (capture.object_id != object_id_) continue;
            reach_ = {capture.captured, capture.well_captured};
        }
        if (reach_.well) return reach_;
        for (const Eigen::Vector3d& direction :
             directionsAllAround(Eigen::Vector3d::UnitX(), kDirections)) {
            for (double fill = 0.08; fill < 1.4; fill *= 1.2) {
                const double distance =
                    distanceForFill(environment_.views, subject_, direction, fill);
                consider(environment_.sphere.inBand(subject_.center + direction * distance));
            }
        }
        refine();
        if (reach_.well) return reach_;
        for (const Eigen::Vector3d& place :
             randomPlaces(environment_.free_space, environment_.sphere, environment_.views,
                          subject_, 0.05, 1.5, kRandomPlaces, random_)) {
            consider(place);
        }
        refine();
        if (!reach_.well) askWhatIf();
        return reach_;
    }

  private:
    struct Place {
        Eigen::Vector3d position;
        ViewEstimator::Estimate coarse;
    };

    void consider(const Eigen::Vector3d& position) {
        if (job_.cancelled() || !environment_.sphere.fits(position)) return;
        const Pose pose = aim(position, subject_.center, environment_.pitch);
        Place place{position, environment_.views.estimate(pose, object_id_, kCoarseGrid)};
        if (place.coarse.visible_fraction > 0.6) places_.push_back(std::move(place));
    }

    /// Include the positions at which remedies are searched: no remedy may pin a view that the
    /// bound denies.
    void askWhatIf() {
        const PlanParams params;
        const PlanEdits edits;
        const auto places = hypotheticalPositions(environment_, subject_, object_id_, seed_, job_);
        for (const bool well : {true, false}) {
            if (well ? reach_.well : reach_.captured) continue;
            if (proposePins({environment_, params, edits, subject_, places, object_id_, well})
                    .empty()) {
                continue;
            }
            reach_.captured = true;
            reach_.well |= well;
        }
    }

    /// Estimates exactly the best candidates for each of the two rates.
    void refine() {
        const auto look = [&](auto&& quality) {
            std::stable_sort(places_.begin(), places_.end(), [&](const Place& a, const Place& b) {
                return quality(a.coarse) > quality(b.coarse);
            });
            for (std::size_t i = 0; i < std::min(kRefined, places_.size()) && !reach_.well; ++i) {
                const Pose pose = aim(places_[i].position, subject_.center, environment_.pitch);
                const ObjectView view =
                    makeView(environment_.views.estimateExactly(pose, object_id_), object_id_, 0);
                reach_.captured |= isCaptured(view);
                reach_.well |= isWellCaptured(view);
            }
        };
        const CaptureRules rules;
        look([](const ViewEstimator::Estimate& e) {
            return e.visible_fraction + (e.visible_px >= CaptureRules{}.min_visible_px ? 1.0 : 0.0);
        });
        look([&](const ViewEstimator::Estimate& e) {
            return std::min(e.visible_fraction / rules.min_visible_fraction, 1.1) +
                   std::min(e.box_share / rules.min_box_share, 1.2);
        });
        places_.clear();
    }

    const PlanningEnvironment& environment_;
    int object_id_;
    int seed_;
    Subject subject_;
    Random random_;
    const JobContext& job_;
    std::vector<Place> places_;
    Reach reach_;
};

}  // namespace

Result<CaptureBound> boundCaptures(const PlanningEnvironment& environment, const Plan& plan,
                                   int seed, const JobContext& job) {
    constexpr std::size_t kBetweenReports = 16;
    std::vector<Reach> reaches(plan.captures.size());
    for (std::size_t begin = 0; begin < reaches.size(); begin += kBetweenReports) {
        const std::size_t end = std::min(begin + kBetweenReports, reaches.size());
        parallelFor(end - begin, [&](std::size_t i) {
            if (job.cancelled()) return;
            const int id = plan.captures[begin + i].object_id;
            reaches[begin + i] = DenseSearch(environment, id, seed, job).run(plan);
        });
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        job.report(static_cast<double>(end) / static_cast<double>(reaches.size()));
    }
    CaptureBound bound;
    int captured = 0;
    int well = 0;
    for (std::size_t i = 0; i < reaches.size(); ++i) {
        captured += reaches[i].captured;
        well += reaches[i].well;
        if (!reaches[i].captured) bound.not_capturable.push_back(plan.captures[i].object_id);
        if (!reaches[i].well) bound.not_well_capturable.push_back(plan.captures[i].object_id);
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, reaches.size()));
    bound.capturable_rate = captured / count;
    bound.well_capturable_rate = well / count;
    return bound;
}

}  // namespace dollytrack::planning
