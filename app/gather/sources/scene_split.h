#pragma once

#include "app/gather/sources/source.h"
#include "engine/core/result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::gather {

/// The parts of a published dataset, as its folders are called.
inline constexpr std::array<const char*, 3> kParts = {"train", "val", "test"};
using PartIndex = std::size_t;  // into kParts

/// How datasets are distributed: each with its whole scene, so that no room is in two parts. Rooms
/// of one scene see each other through doors and stay together.
struct SplitOrder {
    bool by_room = false;                           // else all are for training
    std::array<double, kParts.size()> shares = {};  // of the frames; add up to 1
    std::uint64_t seed = 1;
};

/// `kind`: "none" or "by-room"; `shares`: "80/10/10" or "80/20". Error: Usage.
[[nodiscard]] Result<SplitOrder> parseSplit(const std::string& kind, const std::string& shares);

/// Whether a text is meant as shares.
[[nodiscard]] bool looksLikeShares(const std::string& text);

/// A number for each dataset; those of one scene have the same. A scene is known by the hash of its
/// file or of its geometry, whichever two datasets share.
[[nodiscard]] std::vector<std::size_t> scenesOf(std::span<const Source> sources);

/// The part of each dataset. The numbers of frames come as close to the shares as whole scenes
/// allow; each part that has a share gets at least one scene. Error: Usage where there are fewer
/// scenes than parts.
[[nodiscard]] Result<std::vector<PartIndex>> splitByScene(std::span<const Source> sources,
                                                          const SplitOrder& order);

}  // namespace dollytrack::gather
