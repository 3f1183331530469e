#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::render {

struct DatasetFrame;

/// Cross-validation: number of folds (0: none) and seed.
struct FoldSettings {
    int count = 0;
    std::uint64_t seed = 1;
};

/// One split of the frames into training and validation.
struct Fold {
    std::vector<int> train;  // frame indices, increasing
    std::vector<int> val;
};

struct FrameFolds {
    bool by_room = false;  // else by blocks of consecutive frames
    std::vector<Fold> folds;
};

/// Splits the frames so that every frame is in `val` of exactly one fold and neighbours do not
/// leak. Whole rooms are held back if they give parts of similar size. Otherwise blocks of
/// consecutive frames are held back, and frames within kFoldGuard_s of a held-back frame on the
/// same path, or at nearly the same pose, are in neither list. Returns Usage if there are fewer
/// frames than folds, or if a fold would have no training frame.
[[nodiscard]] Result<FrameFolds> splitFrames(const std::vector<DatasetFrame>& frames,
                                             const FoldSettings& settings);

inline constexpr double kFoldGuard_s = 1.0;
inline constexpr double kFoldGuard_m = 0.25;
inline constexpr double kFoldGuard_deg = 20.0;

}  // namespace dollytrack::render
