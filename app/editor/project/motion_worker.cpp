#include "app/editor/project/motion_worker.h"

#include "engine/io/trajectories/trajectory_file.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/motions/key_motion.h"
#include "planning/motions/repair_motion.h"
#include "render/formats/poses/camera_json.h"

#include <exception>
#include <utility>

namespace dollytrack::editor {
namespace {

/// Uses the maps of the displayed plan, which takes no time. Without a plan, computes new ones.
Result<planning::MappedScene> mapOf(const PlanOutcome& shown, const JobContext& job) {
    if (shown.plan) {
        return planning::mappedSceneOf(shown.scene, shown.edits, shown.params, shown.rays,
                                       shown.free_space, shown.region);
    }
    return planning::mapScene(shown.scene, shown.edits, shown.params,
                              job.stage(0.0, 0.2, "free space"));
}

}  // namespace

void MotionWorker::start(Source source, Work work) {
    source_ = source;
    worker_.start(
        [question = ++question_, work = std::move(work), latest = answers_](const JobContext& job) {
            try {
                latest->put({question, work(job)});
            } catch (const std::exception& error) {
                latest->put({question, fail(ErrorCode::Failed, error.what())});
            }
        });
}

void MotionWorker::cancel() {
    ++question_;
    worker_.cancel();
}

void MotionWorker::read(const MotionFile& file, const PlanOutcome& shown) {
    start(Source::File,
          [file, scene = shown.scene, interval_s = 1.0 / shown.params.timing.frame_rate](
              const JobContext&) -> Result<Outcome> {
              TrajectoryReading reading;
              reading.world = file.world;
              reading.source_from_world = scene->source_from_world;
              reading.camera_json_from_world = render::cameraJsonFromWorld(*scene);
              reading.interval_s = interval_s;
              reading.has_options = false;
              Result<LoadedTrajectory> loaded = loadTrajectory(file.path, reading);
              if (!loaded) return tl::unexpected(std::move(loaded.error()));
              return Outcome{Source::File,
                             givenMotion(file.path.filename().string(), loaded->trajectory),
                             {},
                             {file.path, file.world, loaded->format}};
          });
}

void MotionWorker::repair(const SharedMotion& motion, const PlanOutcome& shown) {
    start(Source::Repair, [motion, shown](const JobContext& job) -> Result<Outcome> {
        const auto map = mapOf(shown, job);
        if (!map) return tl::unexpected(map.error());
        auto repaired = planning::repairMotion(*map, shown.params, trajectoryOf(*motion),
                                               job.stage(0.2, 1.0, "repair"));
        if (!repaired) return tl::unexpected(std::move(repaired.error()));
        return Outcome{Source::Repair, givenMotion(motion->name, repaired->trajectory),
                       repaired->change};
    });
}

void MotionWorker::make(const planning::MoveRequest& move, const SharedMotion& after,
                        const PlanOutcome& shown) {
    start(Source::Move, [move, after, shown](const JobContext& job) -> Result<Outcome> {
        const auto map = mapOf(shown, job);
        if (!map) return tl::unexpected(map.error());
        auto made = planning::makeMove(*map, shown.params, move, job.stage(0.2, 0.7, "move"));
        if (!made) return tl::unexpected(std::move(made.error()));
        if (!after) {
            return Outcome{Source::Move, givenMotion(planning::moveText(move), made->trajectory),
                           {},           {},
                           made->note,   made->look_at,
                           made->floor_z};
        }
        GivenMotion longer = *after;
        const planning::TimingParams& timing = shown.params.timing;
        auto keys = planning::withKeysAlong(std::move(longer.keys), made->trajectory, timing,
                                            job.stage(0.7, 0.8, "key frames"));
        if (!keys) return tl::unexpected(std::move(keys.error()));
        keys = planning::withReachableTimes(*map, timing, std::move(*keys),
                                            job.stage(0.8, 1.0, "key times"));
        if (!keys) return tl::unexpected(std::move(keys.error()));
        longer.keys = std::move(*keys);
        return Outcome{Source::Move, std::move(longer), {}, {}, made->note};
    });
}

void MotionWorker::fitKeys(const SharedMotion& motion, const PlanOutcome& shown) {
    start(Source::KeyTimes, [motion, shown](const JobContext& job) -> Result<Outcome> {
        const auto map = mapOf(shown, job);
        if (!map) return tl::unexpected(map.error());
        GivenMotion fitted = *motion;
        auto keys = planning::withReachableTimes(*map, shown.params.timing, std::move(fitted.keys),
                                                 job.stage(0.2, 1.0, "key times"));
        if (!keys) return tl::unexpected(std::move(keys.error()));
        fitted.keys = std::move(*keys);
        return Outcome{Source::KeyTimes, std::move(fitted)};
    });
}

std::optional<Result<MotionWorker::Outcome>> MotionWorker::take() {
    std::optional<Answer> answer = answers_->take();
    if (!answer || answer->question != question_) return std::nullopt;
    return std::move(answer->outcome);
}

}  // namespace dollytrack::editor
