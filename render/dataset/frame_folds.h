#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::render {

struct DatasetFrame;

/// Cross-validation: how many parts the frames are split into; 0 for none.
struct FoldSettings {
    int count = 0;
    std::uint64_t seed = 1;
};

/// One of the ways to hold a part of the frames back.
struct Fold {
    std::vector<int> train;  // indices of frames, rising
    std::vector<int> val;
};

struct FrameFolds {
    bool by_room = false;  // else by blocks of consecutive frames
    std::vector<Fold> folds;
};

/// Every frame is in the `val` of exactly one fold. Neighbours do not leak: whole rooms are held
/// back where there are enough of about one size; else blocks of the flight, and what was taken
/// within kFoldGuard_s of a held-back frame, or from almost its place, is in neither list. Error:
/// Usage when there are fewer frames than folds.
[[nodiscard]] Result<FrameFolds> splitFrames(const std::vector<DatasetFrame>& frames,
                                             const FoldSettings& settings);

inline constexpr double kFoldGuard_s = 1.0;
inline constexpr double kFoldGuard_m = 0.25;
inline constexpr double kFoldGuard_deg = 20.0;

}  // namespace dollytrack::render
