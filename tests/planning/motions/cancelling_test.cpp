#include "engine/jobs/job.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/motions/camera_moves.h"
#include "planning/motions/free_runs.h"
#include "planning/motions/key_motion.h"
#include "planning/motions/motion_check.h"
#include "planning/motions/repair_motion.h"
#include "planning/motions/time_path.h"
#include "planning/pipeline/follow_motion.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::planning::cancelling_test {
namespace {

using Eigen::Vector3d;

/// A job that is cancelled at one of its progress reports.
class CancelledJob {
  public:
    explicit CancelledJob(int at_report) : at_report_(at_report) {}

    [[nodiscard]] JobContext job() {
        return {flag_, [this](double, std::string_view) {
                    if (++reports_ == at_report_) flag_->store(true);
                }};
    }
    [[nodiscard]] int reports() const { return reports_; }

  private:
    int at_report_;
    int reports_ = 0;
    std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

constexpr int kNever = std::numeric_limits<int>::max();

/// Cancels the work at every report except the last; it must then fail with Cancelled, and send at
/// most one more report.
void expectCancels(const std::function<Status(const JobContext&)>& work) {
    CancelledJob whole(kNever);
    const Status done = work(whole.job());
    ASSERT_TRUE(done) << describe(done.error());
    ASSERT_GE(whole.reports(), 2);
    for (int report = 1; report < whole.reports(); ++report) {
        SCOPED_TRACE(report);
        CancelledJob stopped(report);
        const Status result = work(stopped.job());
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
        EXPECT_LE(stopped.reports(), report + 1);
    }
}

/// The work without its value.
template <class Value>
Status statusOf(const Result<Value>& result) {
    if (!result) return tl::unexpected(result.error());
    return {};
}

/// A room with a stool in the middle, and a wall that the line beside it hits.
MappedScene room() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 6, 2.6});
    builder.object("stool").box({3.0, 3.0, 0.3}, {0.4, 0.4, 0.6});
    builder.object("cupboard").box({3.0, 0.5, 1.3}, {2.0, 1.0, 2.6});
    auto made = mapScene(std::make_shared<const Scene>(builder.build()), {}, {}, {});
    return std::move(made.value());  // throws if there is none
}

/// A line that grazes the cupboard, in two paths.
Trajectory brokenLine() {
    Trajectory line{0.1, {}};
    for (int i = 0; i <= 120; ++i) {
        TrajectoryFrame frame;
        frame.time_s = 0.1 * i;
        const Vector3d position(0.5 + 5.0 * i / 120.0, 1.05, 1.2);
        frame.pose = lookAt(position, position + Vector3d::UnitY());
        frame.path = i < 100 ? 0 : 1;
        line.frames.push_back(frame);
    }
    return line;
}

}  // namespace

TEST(Cancelling, ARepairStopsAtEveryReport) {
    const MappedScene scene = room();
    const Trajectory given = brokenLine();
    expectCancels(
        [&](const JobContext& job) { return statusOf(repairMotion(scene, {}, given, job)); });
}

TEST(Cancelling, EveryCameraMoveStopsAtEveryReport) {
    const MappedScene scene = room();
    for (const char* text : {"orbit:target=stool,radius=1.5", "crane:target=stool,radius=1.2",
                             "dolly:target=stool", "walk:from=1;5;1.2,to=5;5;1.2"}) {
        SCOPED_TRACE(text);
        const auto request = parseMove(text);
        ASSERT_TRUE(request);
        expectCancels(
            [&](const JobContext& job) { return statusOf(makeMove(scene, {}, *request, job)); });
    }
}

TEST(Cancelling, AWalkThroughDoorwaysStopsBeforeItLooksForRooms) {
    auto made = mapScene(std::make_shared<const Scene>(test::twoRoomsWithDoor(0.9)), {}, {}, {});
    ASSERT_TRUE(made);
    CancelledJob stopped(1);
    const auto walk = makeMove(*made, {}, *parseMove("walk"), stopped.job());
    ASSERT_FALSE(walk);
    EXPECT_EQ(walk.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(stopped.reports(), 1);
}

TEST(Cancelling, AFollowedMotionStopsAtEveryReport) {
    const MappedScene scene = room();
    const GivenMotion frames = givenMotion("line", brokenLine());
    GivenMotion through_keys;
    through_keys.keys = {{0.0, lookAt({1.0, 5.0, 1.2}, {3.0, 3.0, 0.3})},
                         {9.0, lookAt({5.0, 5.0, 1.2}, {3.0, 3.0, 0.3})}};
    for (const GivenMotion& motion : {frames, through_keys}) {
        expectCancels(
            [&](const JobContext& job) { return statusOf(followMotion(motion, scene, {}, job)); });
    }
}

// Checking a motion and timing a path return nothing when they were cancelled.
TEST(Cancelling, ChecksAndTimesAreNotComputed) {
    const MappedScene scene = room();
    const Trajectory given = brokenLine();
    const std::span<const TrajectoryFrame> frames(given.frames.data(), 100);
    const MotionCheck check(scene);
    const FreeParts parts = findFreeParts(check, frames, {});
    EXPECT_EQ(findRunsToKeep(scene, check, frames, parts, {}).size(), 2U);
    const auto cancelled = std::make_shared<const std::atomic<bool>>(true);
    EXPECT_TRUE(findRunsToKeep(scene, check, frames, parts, JobContext(cancelled, {})).empty());

    std::vector<PathPoint> points;
    for (int i = 0; i < 30; ++i) points.push_back({frames[i].pose.position, 1.0 * i, false});
    PathTiming timing;
    timing.limits = {0.5, 1.0, 1.0, 1.0};
    timing.retime_all = true;
    EXPECT_GT(timePath(*scene.sphere, timing, frames, points, {}).frames.size(), 10U);
    CancelledJob stopped(1);
    EXPECT_TRUE(timePath(*scene.sphere, timing, frames, points, stopped.job()).frames.empty());
}

}  // namespace dollytrack::planning::cancelling_test
