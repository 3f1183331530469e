#include "planning/timing/clip.h"

#include "planning/plan_params.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace dollytrack::planning {

bool keepsFrameRate(const TimingParams& params) {
    return params.keep_frame_rate || params.duration_s > 0.0 ||
           params.motion_preset == MotionPreset::Slam;
}

double imageMotionLimit_rps(const TimingParams& params) {
    const double of_preset_dps = params.motion_preset == MotionPreset::Slam ? 40.0 : 0.0;
    const double limit_dps =
        params.max_image_motion_dps > 0.0 ? params.max_image_motion_dps : of_preset_dps;
    return limit_dps * std::numbers::pi / 180.0;
}

int clipFrames(const TimingParams& params) {
    if (params.duration_s <= 0.0) return keepsFrameRate(params) ? params.max_frames : 0;
    return static_cast<int>(std::lround(params.duration_s * params.frame_rate));
}

Status validateClip(const PlanParams& params) {
    const TimingParams& timing = params.timing;
    if (!keepsFrameRate(timing) || clipFrames(timing) == 0) {
        if (timing.duration_s <= 0.0) return {};
        return fail(ErrorCode::Usage,
                    fmt::format("duration_s={:g} is shorter than one frame at frame_rate={:g}; "
                                "raise either.",
                                timing.duration_s, timing.frame_rate),
                    "duration_s");
    }
    if (params.path.path_mode == PathMode::LongestBranch) {
        return fail(ErrorCode::Usage,
                    "path_mode=longest_branch cannot meet a number of frames at a fixed frame "
                    "rate (keep_frame_rate, duration_s or motion_preset=slam); use path_mode=tour.",
                    "path_mode");
    }
    const int frames = clipFrames(timing);
    // Planning estimates what every frame sees; longer clips would take minutes to plan and days to
    // render.
    constexpr int kMostFrames = 100'000;
    if (timing.duration_s > 0.0 && timing.duration_s * timing.frame_rate > kMostFrames + 0.5) {
        return fail(ErrorCode::Usage,
                    fmt::format("duration_s={:g} at frame_rate={:g} has more than {} frames; "
                                "lower either.",
                                timing.duration_s, timing.frame_rate, kMostFrames),
                    "duration_s");
    }
    if (timing.max_frames > 0 && frames > timing.max_frames) {
        return fail(ErrorCode::Usage,
                    fmt::format("duration_s={:g} at frame_rate={:g} has {} frames, more than "
                                "max_frames={}; change one of the three.",
                                timing.duration_s, timing.frame_rate, frames, timing.max_frames),
                    "duration_s");
    }
    return {};
}

tl::unexpected<Error> tooShortClip(const TimingParams& params) {
    const bool by_duration = params.duration_s > 0.0;
    return fail(ErrorCode::Failed,
                fmt::format("{} frames at frame_rate={:g} are too few for the views that must be "
                            "visited; raise {}, or max_speed_mps.",
                            clipFrames(params), params.frame_rate,
                            by_duration ? "duration_s" : "max_frames"),
                by_duration ? "duration_s" : "max_frames");
}

double meanFrameRate(const Trajectory& trajectory) {
    int steps = 0;
    double time_s = 0.0;
    for (std::size_t i = 1; i < trajectory.frames.size(); ++i) {
        if (!continuesPath(trajectory, i)) continue;
        ++steps;
        time_s += trajectory.frames[i].time_s - trajectory.frames[i - 1].time_s;
    }
    return time_s > 0.0 ? steps / time_s : 1.0 / trajectory.frame_interval_s;
}

std::string_view whyFramesWereLeftOut(const Trajectory& trajectory, const TimingParams& params) {
    if (trajectory.left_out.empty() || params.max_frames <= 0 || keepsFrameRate(params)) return {};
    const bool budget_used = std::cmp_greater_equal(trajectory.frames.size(), params.max_frames);
    return budget_used || params.max_repeat_rate >= 1.0 ? "max_frames" : "max_repeat_rate";
}

std::string frameRateNote(const Trajectory& trajectory, const TimingParams& params) {
    const auto frames = static_cast<int>(trajectory.frames.size());
    if (!keepsFrameRate(params) && frames == 1 && params.max_frames > 1) {
        return fmt::format(
            "only 1 of max_frames={} frames is used: no second view fits; raise max_frames",
            params.max_frames);
    }
    if (keepsFrameRate(params) && params.duration_s <= 0.0 && 2 * frames < params.max_frames) {
        return fmt::format(
            "only {} of max_frames={} frames are used: at frame_rate={:g} no further view fits "
            "into the remaining frames; raise max_frames or lower frame_rate",
            frames, params.max_frames, params.frame_rate);
    }
    const std::string_view reason = whyFramesWereLeftOut(trajectory, params);
    if (reason.empty()) return {};
    return fmt::format(
        "{} of {} frames at frame_rate={:g} are left out for {} ({:.3g} per second remain on "
        "average); keep_frame_rate=true keeps all, but visits fewer objects",
        trajectory.left_out.size(), trajectory.left_out.size() + trajectory.frames.size(),
        params.frame_rate,
        reason == "max_repeat_rate"
            ? fmt::format("max_repeat_rate={:g}, although max_frames={} allows more",
                          params.max_repeat_rate, params.max_frames)
            : fmt::format("max_frames={}", params.max_frames),
        meanFrameRate(trajectory));
}

}  // namespace dollytrack::planning
