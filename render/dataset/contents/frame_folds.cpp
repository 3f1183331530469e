#include "render/dataset/contents/frame_folds.h"

#include "engine/core/random.h"
#include "render/dataset/contents/dataset_contents.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace dollytrack::render {
namespace {

using Parts = std::vector<std::vector<int>>;

/// Frames by room, largest room first; ties in random order.
Parts roomsOf(const std::vector<DatasetFrame>& frames, Random& random) {
    std::map<std::string, std::vector<int>> by_name;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        by_name[frames[i].room].push_back(static_cast<int>(i));
    }
    Parts rooms;
    for (auto& [name, members] : by_name) rooms.push_back(std::move(members));
    for (std::size_t i = rooms.size(); i > 1; --i) {
        std::swap(rooms[i - 1], rooms[random.below(static_cast<std::uint32_t>(i))]);
    }
    std::stable_sort(rooms.begin(), rooms.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return rooms;
}

/// Assigns whole rooms, each to the smallest part; empty if the parts become too unequal.
Parts partsByRoom(const std::vector<DatasetFrame>& frames, std::size_t count, Random& random) {
    const Parts rooms = roomsOf(frames, random);
    if (rooms.size() < count) return {};
    Parts parts(count);
    for (const std::vector<int>& room : rooms) {
        auto& least =
            *std::min_element(parts.begin(), parts.end(),
                              [](const auto& a, const auto& b) { return a.size() < b.size(); });
        least.insert(least.end(), room.begin(), room.end());
    }
    for (std::vector<int>& part : parts) {
        if (part.size() * count > 2 * frames.size() || 2 * part.size() * count < frames.size()) {
            return {};
        }
        std::sort(part.begin(), part.end());
    }
    return parts;
}

/// Blocks of consecutive frames; the first one starts at a random frame.
Parts blocks(std::size_t frames, std::size_t count, Random& random) {
    Parts parts(count);
    const std::size_t start = random.below(static_cast<std::uint32_t>(frames));
    for (std::size_t i = 0; i < frames; ++i) {
        parts[i * count / frames].push_back(static_cast<int>((start + i) % frames));
    }
    for (std::vector<int>& part : parts) std::sort(part.begin(), part.end());
    return parts;
}

bool areNeighbours(const TrajectoryFrame& a, const TrajectoryFrame& b) {
    if (a.path == b.path && std::abs(a.time_s - b.time_s) < kFoldGuard_s) return true;
    return (a.pose.position - b.pose.position).norm() < kFoldGuard_m &&
           angleBetween(a.pose.rotation, b.pose.rotation) <
               kFoldGuard_deg * std::numbers::pi / 180.0;
}

}  // namespace

Result<FrameFolds> splitFrames(const std::vector<DatasetFrame>& frames,
                               const FoldSettings& settings) {
    const std::size_t count = std::max(settings.count, 0);
    if (frames.size() < count) {
        return fail(ErrorCode::Usage,
                    std::to_string(frames.size()) + " frames cannot be split into " +
                        std::to_string(count) +
                        " folds; lower --folds or raise the number of frames",
                    "--folds");
    }
    FrameFolds result;
    if (count == 0) return result;
    Random random(settings.seed);
    Parts parts = partsByRoom(frames, count, random);
    result.by_room = !parts.empty();
    if (parts.empty()) parts = blocks(frames.size(), count, random);
    for (std::vector<int>& part : parts) {
        Fold fold;
        std::vector<char> held_back(frames.size());
        for (const int i : part) held_back[i] = 1;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (held_back[i] != 0) continue;
            const bool leaks =
                !result.by_room && std::any_of(part.begin(), part.end(), [&](int other) {
                    return areNeighbours(frames[i].camera, frames[other].camera);
                });
            if (!leaks) fold.train.push_back(static_cast<int>(i));
        }
        if (fold.train.empty()) {
            return fail(ErrorCode::Usage,
                        "fold " + std::to_string(result.folds.size()) +
                            " has no training frames: all are too close to its validation frames; "
                            "export more of the trajectory, or raise --folds",
                        "--folds");
        }
        fold.val = std::move(part);
        result.folds.push_back(std::move(fold));
    }
    return result;
}

}  // namespace dollytrack::render
