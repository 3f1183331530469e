#include "engine/io/object_parts/numbered_pieces.h"

#include "engine/core/disjoint_sets.h"
#include "engine/geometry/contact.h"
#include "engine/io/object_parts/piece_merge.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace dollytrack {
namespace {

constexpr float kLargestFurniture_m = 3.5F;  // diagonal
// Largest number of pieces of an object, and difference of the numbers of two that are joined.
constexpr std::size_t kMostPieces = 200;

/// The number at the end of "Pied_2_59" or of "225".
std::optional<std::size_t> numberOf(std::string_view name) {
    const std::size_t last = name.find_last_not_of("0123456789");
    const std::size_t first = last == std::string_view::npos ? 0 : last + 1;
    if (first > 0 && name[first - 1] != '_') return std::nullopt;
    std::size_t number = 0;
    const auto read = std::from_chars(name.data() + first, name.data() + name.size(), number);
    if (read.ec != std::errc() || read.ptr != name.data() + name.size()) return std::nullopt;
    return number;
}

/// Whether the exporter gave a mesh this name because it is a part of the building.
bool isBuilding(std::string_view name) {
    constexpr std::array<std::string_view, 5> kPrefixes = {"ground_", "wall_", "room_", "polyline_",
                                                           "baseboard_"};
    return std::ranges::any_of(kPrefixes, [&](auto prefix) { return name.starts_with(prefix); });
}

/// Whether only the exporter names meshes so: "wall_2_17" or "room_5_33".
bool isExporters(std::string_view name) {
    const std::size_t last = name.rfind('_');
    return (name.starts_with("wall_") || name.starts_with("room_")) && last > 5 &&
           last != name.npos && numberOf(name) && numberOf(name.substr(0, last));
}

/// The drafts' numbers, if they are those of the exporter: nearly all drafts have one, none occurs
/// twice, they begin at 1 and hardly skip any, and there are walls or rooms.
std::vector<std::optional<std::size_t>> exportersNumbers(const std::vector<ObjectDraft>& drafts) {
    constexpr std::size_t kFewest = 10;
    std::vector<std::optional<std::size_t>> numbers;
    std::vector<std::size_t> found;
    bool exporters = false;
    for (const ObjectDraft& draft : drafts) {
        exporters |= isExporters(draft.name);
        numbers.push_back(numberOf(draft.name));
        if (numbers.back()) found.push_back(*numbers.back());
    }
    std::ranges::sort(found);
    const bool repeats = std::ranges::adjacent_find(found) != found.end();
    const bool most = 10 * found.size() >= 9 * drafts.size();
    if (!exporters || repeats || !most || found.size() < kFewest || found.front() > 2 ||
        found.back() > found.size() + found.size() / 10) {
        return {};
    }
    return numbers;
}

class FurniturePieces {
  public:
    FurniturePieces(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                    const std::vector<std::size_t>& pieces)
        : groups_(pieces.size()) {
        for (const std::size_t piece : pieces) {
            boxes_.push_back(boundsOf(raw, drafts[piece]));
            around_.push_back(boxes_.back());
            surfaces_.push_back(surfacesOf(raw, drafts[piece]));
            const std::string& name = drafts[piece].name;
            const std::size_t end = name.rfind('_');
            names_.emplace_back();
            if (end != std::string::npos) names_.back().insert(name.substr(0, end));
        }
    }

    std::size_t find(std::size_t i) { return groups_.find(i); }
    [[nodiscard]] const Eigen::AlignedBox3f& box(std::size_t i) const { return boxes_[i]; }

    void joinAttached() {
        constexpr float kGap_m = 0.02F;
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            for (std::size_t j = i + 1; j < std::min(boxes_.size(), i + kMostPieces); ++j) {
                if (find(i) == find(j) || boxes_[i].exteriorDistance(boxes_[j]) > kGap_m) continue;
                const auto contact = findContact(surfaces_[i], surfaces_[j], kGap_m);
                const bool inside =
                    liesInside(boxes_[i], boxes_[j]) || liesInside(boxes_[j], boxes_[i]);
                if (contact.empty() && !inside) continue;
                if (!contact.empty() && (standsOn(boxes_[i], boxes_[j], contact) ||
                                         standsOn(boxes_[j], boxes_[i], contact))) {
                    continue;
                }
                join(i, j);
            }
        }
    }

    /// A piece of furniture has consecutive numbers: what is numbered between two of its pieces
    /// and lies within it belongs to it, such as the burners that stand on a hob.
    void joinBetween() {
        std::vector<std::size_t> last(boxes_.size());  // index of the last piece, by group
        for (std::size_t i = 0; i < boxes_.size(); ++i) last[find(i)] = i;
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            for (std::size_t j = i + 1; j < std::min(last[find(i)], i + kMostPieces); ++j) {
                if (find(j) == find(i) || !liesWithin(boxes_[j], around_[find(i)])) continue;
                const std::size_t end = std::max(last[find(i)], last[find(j)]);
                join(i, j);
                if (find(i) == find(j)) last[find(i)] = end;
            }
        }
    }

  private:
    static bool liesWithin(const Eigen::AlignedBox3f& piece, const Eigen::AlignedBox3f& whole) {
        constexpr float kReach_m = 0.05F;
        const Eigen::Vector3f reach = Eigen::Vector3f::Constant(kReach_m);
        return Eigen::AlignedBox3f(whole.min() - reach, whole.max() + reach).contains(piece);
    }

    void join(std::size_t i, std::size_t j) {
        const std::size_t first = std::min(find(i), find(j));
        const std::size_t second = std::max(find(i), find(j));
        const Eigen::AlignedBox3f together = around_[first].merged(around_[second]);
        if (first == second || together.diagonal().norm() > kLargestFurniture_m) return;
        // The shapes of one piece of furniture have different names.
        const bool two = std::ranges::any_of(
            names_[second], [&](const std::string& name) { return names_[first].contains(name); });
        if (two) return;
        names_[first].merge(names_[second]);
        groups_.join(first, second);
        around_[first] = together;
    }

    DisjointSets<> groups_;
    std::vector<Eigen::AlignedBox3f> boxes_;
    std::vector<Eigen::AlignedBox3f> around_;   // by group
    std::vector<std::set<std::string>> names_;  // without numbers, by group
    std::vector<std::vector<SurfaceView>> surfaces_;
};

/// Whether the pieces form one connected group, with gaps of at most 5 cm, no larger than
/// furniture.
bool lieTogether(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                 const std::vector<std::size_t>& pieces) {
    constexpr float kNear_m = 0.05F;
    if (pieces.size() > kMostPieces) return false;
    std::vector<Eigen::AlignedBox3f> boxes;
    Eigen::AlignedBox3f whole;
    for (const std::size_t i : pieces) whole.extend(boxes.emplace_back(boundsOf(raw, drafts[i])));
    if (whole.diagonal().norm() > kLargestFurniture_m) return false;
    DisjointSets<> groups(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            if (boxes[i].exteriorDistance(boxes[j]) <= kNear_m) groups.join(i, j);
        }
    }
    for (std::size_t i = 1; i < boxes.size(); ++i) {
        if (groups.find(i) != groups.find(0)) return false;
    }
    return true;
}

}  // namespace

std::size_t joinNumberedPieces(const RawScene& raw, std::vector<ObjectDraft>& drafts) {
    const std::vector<std::optional<std::size_t>> numbers = exportersNumbers(drafts);
    if (numbers.empty()) return 0;
    std::vector<std::size_t> indices;  // of the pieces, by their numbers
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (numbers[i] && !isBuilding(drafts[i].name)) indices.push_back(i);
    }
    std::ranges::sort(indices, {}, [&](std::size_t i) { return *numbers[i]; });
    FurniturePieces pieces(raw, drafts, indices);
    pieces.joinAttached();
    pieces.joinBetween();
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < indices.size(); ++i) members[pieces.find(i)].push_back(i);
    std::vector<bool> joined(drafts.size(), false);
    for (const auto& [group, group_members] : members) {
        if (group_members.size() < 2) continue;
        const std::size_t largest = *std::ranges::max_element(
            group_members, {},
            [&](std::size_t member) { return pieces.box(member).diagonal().norm(); });
        ObjectDraft& whole = drafts[indices[largest]];
        for (const std::size_t member : group_members) {
            if (member == largest) continue;
            ObjectDraft& piece = drafts[indices[member]];
            whole.parts.insert(whole.parts.end(), piece.parts.begin(), piece.parts.end());
            joined[indices[member]] = true;
        }
        std::ranges::sort(whole.parts);
    }
    // The structure finder must not take a bed for a platform by its shape.
    for (const std::size_t i : indices) {
        Label& label = drafts[i].label;
        if (label.kind != LabelKind::Target && label.kind != LabelKind::Structure) {
            label.kind = LabelKind::Target;
        }
    }
    return dropJoined(joined, drafts);
}

std::size_t joinPiecesOfPaths(const RawScene& raw, const LabelTable& labels,
                              std::vector<ObjectDraft>& drafts) {
    constexpr std::size_t kFewestPieces = 3;  // of an object, for the names to count as paths
    constexpr std::size_t kFewestPaths = 3;   // smallest number of such objects in the file
    struct Path {
        Label label;
        std::vector<std::size_t> pieces;
    };
    std::map<std::string, Path> paths;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const std::string& name = drafts[i].name;
        const std::size_t blank = name.rfind(' ');
        if (blank == std::string::npos || blank == 0) continue;
        if (labels.find(name.substr(blank + 1)).kind != LabelKind::None) continue;
        const std::string path = name.substr(0, blank);
        const Label label = labels.find(path.substr(path.rfind(' ') + 1));
        if (label.kind != LabelKind::Target) continue;
        paths[path].label = label;
        paths[path].pieces.push_back(i);
    }
    std::erase_if(paths, [&](const auto& entry) {
        const std::vector<std::size_t>& pieces = entry.second.pieces;
        return pieces.size() < kFewestPieces || !lieTogether(raw, drafts, pieces);
    });
    if (paths.size() < kFewestPaths) return 0;
    std::vector<bool> joined(drafts.size(), false);
    for (auto& [name, path] : paths) {
        ObjectDraft& whole = drafts[path.pieces.front()];
        whole.name = name;
        whole.label = path.label;
        for (const std::size_t i : path.pieces) {
            if (i == path.pieces.front()) continue;
            whole.parts.insert(whole.parts.end(), drafts[i].parts.begin(), drafts[i].parts.end());
            joined[i] = true;
        }
        std::ranges::sort(whole.parts);
    }
    return dropJoined(joined, drafts);
}

}  // namespace dollytrack
