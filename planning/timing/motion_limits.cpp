#include "planning/timing/motion_limits.h"

#include "planning/plan_params.h"

#include <array>
#include <numbers>

namespace dollytrack::planning {
namespace {

// More than any camera does, but finite, so that arithmetic stays finite.
constexpr double kNoLimit = 1e6;

/// By MotionPreset. There is no published definition of easy and hard; these are a slow pan for
/// feature trackers, a calm walk through a room, and a fast one with motion blur.
struct Preset {
    double speed_mps, acceleration_mps2, turn_dps, turn_acceleration_dps2;
};
constexpr std::array<Preset, 5> kPresets = {{{0.25, 0.4, 20.0, 60.0},
                                             {0.5, 1.0, 45.0, 180.0},
                                             {1.5, 4.0, 120.0, 720.0},
                                             {kNoLimit, kNoLimit, kNoLimit, kNoLimit},
                                             {0.5, 1.0, 40.0, 120.0}}};

}  // namespace

MotionLimits motionLimits(const TimingParams& params) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    const Preset& preset = kPresets[static_cast<std::size_t>(params.motion_preset)];
    const auto choose = [](double own, double of_preset) { return own > 0.0 ? own : of_preset; };
    return {choose(params.max_speed_mps, preset.speed_mps),
            choose(params.max_acceleration_mps2, preset.acceleration_mps2),
            kRadians * choose(params.max_turn_dps, preset.turn_dps),
            kRadians * choose(params.max_turn_acceleration_dps2, preset.turn_acceleration_dps2)};
}

}  // namespace dollytrack::planning
