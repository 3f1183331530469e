#include "planning/baselines/two_body.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <set>

namespace dollytrack::planning {
namespace {

constexpr double kStep = 1.0 / 25.0;  // s
constexpr int kBurnIn = 500;          // steps
constexpr int kStepsPerImage = 25;
constexpr double kFastest = 3.0;    // m/s
constexpr double kPush = 0.5;       // m/s, standard deviation of the speed change per push
constexpr double kDrag = 0.1;       // 1/m: deceleration over squared speed
constexpr double kLeastMove = 1.0;  // m
constexpr int kLeastObjects = 10;
constexpr int kTries = 8;
constexpr int kRayColumns = 16;  // rays that determine which objects a frame sees
constexpr int kRayRows = 12;

class Body {
  public:
    Body(const MappedScene& scene, int room, Random& random)
        : scene_(scene), room_(room), position_(randomPlace(scene, room, random)) {}

    void move(Random& random) {
        const double x = random.normal();
        const double y = random.normal();
        const double z = random.normal();
        velocity_ += kPush * std::sqrt(kStep) * Eigen::Vector3d(x, y, z);
        velocity_ -= kStep * kDrag * velocity_.norm() * velocity_;
        if (velocity_.norm() > kFastest) velocity_ *= kFastest / velocity_.norm();
        const Eigen::Vector3d next = position_ + kStep * velocity_;
        // As in the original, only the positions after each step are tested, not the motion
        // between.
        if (scene_.free_space->componentAt(next) == room_ && scene_.sphere->fits(next)) {
            position_ = next;
            return;
        }
        const ClosestPoint wall = scene_.rays->closest(next);
        Eigen::Vector3d normal = position_ - wall.point;
        if (normal.norm() < 1e-9) normal = -velocity_;
        normal.normalize();
        const double into = velocity_.dot(normal);
        velocity_ = into < 0.0 ? Eigen::Vector3d(velocity_ - 2.0 * into * normal)
                               : Eigen::Vector3d(-velocity_);
    }

    [[nodiscard]] const Eigen::Vector3d& position() const { return position_; }

  private:
    const MappedScene& scene_;
    int room_;
    Eigen::Vector3d position_;
    Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

struct Run {
    std::vector<TrajectoryFrame> frames;
    std::vector<std::vector<Eigen::Vector3d>> between;
};

/// Ends early when cancelled.
Run simulate(const MappedScene& scene, int room, int images, Random random, const JobContext& job) {
    Body camera(scene, room, random);
    Body target(scene, room, random);
    const auto step = [&] {
        camera.move(random);
        target.move(random);
    };
    for (int i = 0; i < kBurnIn; ++i) step();
    Run run;
    for (int image = 0; image < images && !job.cancelled(); ++image) {
        TrajectoryFrame frame;
        frame.component = room;
        frame.path = room;
        frame.target_in_world = target.position();
        // The two bodies can pass through each other; the camera then keeps its orientation.
        const bool apart = (target.position() - camera.position()).norm() > 1e-3;
        frame.pose = apart || run.frames.empty()
                         ? lookAt(camera.position(), target.position())
                         : Pose{camera.position(), run.frames.back().pose.rotation};
        run.frames.push_back(frame);
        if (image + 1 == images) break;
        run.between.emplace_back();
        for (int i = 0; i < kStepsPerImage; ++i) {
            step();
            if (i + 1 < kStepsPerImage) run.between.back().push_back(camera.position());
        }
    }
    run.between.emplace_back();
    return run;
}

bool counts(const MappedScene& scene, const Run& run, const JobContext& job) {
    double furthest = 0.0;
    std::set<int> seen;
    const Intrinsics& k = scene.views->intrinsics();
    for (const TrajectoryFrame& frame : run.frames) {
        if (job.cancelled()) return false;
        const Pose& pose = frame.pose;
        furthest = std::max(furthest, (pose.position - run.frames.front().pose.position).norm());
        for (int i = 0; i < kRayColumns * kRayRows; ++i) {
            const Eigen::Vector3d ray =
                pose.rotation * k.unproject((i % kRayColumns + 0.5) * k.width / kRayColumns,
                                            (i / kRayColumns + 0.5) * k.height / kRayRows);
            const int id = scene.rays->cast(pose.position, ray).object_id;
            if (id != 0 && scene.scene->object(id).role == Role::Target) seen.insert(id);
        }
    }
    const auto targets = std::count_if(scene.scene->objects.begin(), scene.scene->objects.end(),
                                       [](const Object& o) { return o.role == Role::Target; });
    const int wanted = std::min<int>(kLeastObjects, static_cast<int>(targets));
    return furthest > kLeastMove && static_cast<int>(seen.size()) >= wanted;
}

}  // namespace

Result<PlannedMotion> planTwoBody(const MappedScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job) {
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = kStepsPerImage * kStep;
    const std::vector<int> shares = shareByRoom(scene, frameBudget(params), 10);
    for (std::size_t room = 0; room < shares.size(); ++room) {
        if (shares[room] == 0) continue;
        Run run;
        for (int attempt = 0; attempt < kTries; ++attempt) {
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
            run = simulate(scene, static_cast<int>(room), shares[room],
                           Random(static_cast<std::uint64_t>(seed), room * kTries + attempt), job);
            if (counts(scene, run, job)) break;
        }
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        auto& frames = motion.trajectory.frames;
        frames.insert(frames.end(), run.frames.begin(), run.frames.end());
        motion.between.insert(motion.between.end(), run.between.begin(), run.between.end());
        job.report(static_cast<double>(room + 1) / static_cast<double>(shares.size()));
    }
    auto& frames = motion.trajectory.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].time_s = static_cast<double>(i) * motion.trajectory.frame_interval_s;
    }
    return motion;
}

}  // namespace dollytrack::planning
