#include "planning/baselines/density_walk.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr int kSequence = 100;  // views
constexpr int kCandidates = 20;
constexpr int kDraws = 1000;
const Eigen::Vector3d kNeighbourhood(1.5, 1.5, 0.25);  // m, to each side
constexpr double kLeastDistance = 0.1;                 // m, from the camera to the look-at point
constexpr int kColumns = 64;
constexpr int kRows = 48;

struct WalkView {
    Eigen::Vector3d from = Eigen::Vector3d::Zero();
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

class Walk {
  public:
    Walk(const MappedScene& scene, int room, Random random)
        : scene_(scene), room_(room), random_(random) {}

    WalkView first() {
        std::vector<WalkView> candidates;
        for (int i = 0; i < kCandidates; ++i) {
            WalkView view{randomPlace(scene_, room_, random_), randomPlace(scene_, room_, random_)};
            if ((view.at - view.from).norm() > kLeastDistance) candidates.push_back(view);
        }
        if (candidates.empty()) {
            const Eigen::Vector3d place = randomPlace(scene_, room_, random_);
            return {place, place + Eigen::Vector3d::UnitX()};
        }
        const std::vector<double> scores = scoreAll(candidates);
        return candidates[std::max_element(scores.begin(), scores.end()) - scores.begin()];
    }

    /// Returns the last view again if no candidate is found.
    WalkView next(const WalkView& last) {
        std::vector<WalkView> candidates;
        for (int i = 0; i < kDraws && static_cast<int>(candidates.size()) < kCandidates; ++i) {
            const WalkView view{near(last.from), near(last.at)};
            if ((view.at - view.from).norm() < kLeastDistance || !fits(view.from) ||
                !scene_.rays->sees(last.from, view.from) ||
                scene_.free_space->componentAt(view.at) < 0 ||
                !scene_.rays->sees(last.at, view.at)) {
                continue;
            }
            candidates.push_back(view);
        }
        const std::vector<double> scores = scoreAll(candidates);
        double total = 0.0;
        for (const double score : scores) total += score;
        double pick = random_.uniform() * total;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            pick -= scores[i];
            if (pick < 0.0) return candidates[i];
        }
        return last;
    }

  private:
    Eigen::Vector3d near(const Eigen::Vector3d& center) {
        const double x = random_.uniform(-1.0, 1.0);
        const double y = random_.uniform(-1.0, 1.0);
        const double z = random_.uniform(-1.0, 1.0);
        return center + kNeighbourhood.cwiseProduct(Eigen::Vector3d(x, y, z));
    }

    [[nodiscard]] bool fits(const Eigen::Vector3d& place) const {
        return scene_.free_space->componentAt(place) == room_ && scene_.sphere->fits(place);
    }

    [[nodiscard]] std::vector<double> scoreAll(const std::vector<WalkView>& candidates) const {
        std::vector<double> scores(candidates.size(), 0.0);
        parallelFor(candidates.size(), [&](std::size_t i) { scores[i] = score(candidates[i]); });
        return scores;
    }

    [[nodiscard]] double score(const WalkView& view) const {
        const Pose pose = lookAt(view.from, view.at);
        const Intrinsics& k = scene_.views->intrinsics();
        std::vector<RayCaster::BundleRay> rays;
        rays.reserve(kColumns * kRows);
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                rays.push_back({pose.rotation * k.unproject((column + 0.5) * k.width / kColumns,
                                                            (row + 0.5) * k.height / kRows)});
            }
        }
        std::vector<RayHit> hits(rays.size());
        scene_.rays->castBundle(pose.position, rays, scene_.views->nearDistance(), hits);
        std::vector<std::uint32_t> triangles;
        for (const RayHit& hit : hits) {
            if (hit.object_id != 0) triangles.push_back(hit.triangle);
        }
        const double valid = static_cast<double>(triangles.size()) / (kColumns * kRows);
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        return valid * valid * static_cast<double>(triangles.size());
    }

    const MappedScene& scene_;
    int room_;
    Random random_;
};

}  // namespace

Result<PlannedMotion> planDensityWalk(const MappedScene& scene, const PlanParams& params, int seed,
                                      const JobContext& job) {
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = 1.0;  // metadata_camera.csv: one second per view
    auto& frames = motion.trajectory.frames;
    const int budget = frameBudget(params);
    const std::vector<int> shares = shareByRoom(scene, budget, 10);
    int path = 0;
    for (std::size_t room = 0; room < shares.size(); ++room) {
        for (int done = 0; done < shares[room]; done += kSequence, ++path) {
            Walk walk(scene, static_cast<int>(room),
                      Random(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(path)));
            WalkView view = walk.first();
            for (int i = 0; i < std::min(kSequence, shares[room] - done); ++i) {
                if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
                if (i > 0) view = walk.next(view);
                TrajectoryFrame frame;
                frame.time_s = static_cast<double>(frames.size());
                frame.pose = lookAt(view.from, view.at);
                frame.target_in_world = view.at;
                frame.component = static_cast<int>(room);
                frame.path = path;
                frames.push_back(frame);
                job.report(static_cast<double>(frames.size()) / budget);
            }
        }
    }
    return motion;
}

}  // namespace dollytrack::planning
