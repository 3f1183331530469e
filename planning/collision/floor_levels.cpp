#include "planning/collision/floor_levels.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/flat_obstacles.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace dollytrack::planning {
namespace {

// Cell centres are stored as floats, so a position may be off its level by a rounding error.
constexpr double kSameHeight_m = 1e-5;
constexpr double kFarthest_m = 0.25;       // cap of clearance()
constexpr double kLeastLevel_m2 = 0.5;     // a smaller level is a stair tread or a sill
constexpr double kLeastReached_m2 = 0.25;  // a smaller drivable area is ignored
constexpr double kBin_m = 0.001;
// Floors are often modelled room by room, without floor in the doorways between them; gaps up to
// this width are bridged.
constexpr double kWidestGap_m = 0.45;
constexpr double kDeepestGap_m = 1.0;  // a lower floor within this depth makes the gap a step

constexpr std::array<std::array<int, 2>, 8> kAround = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

/// Dilates a set of grid columns by `by` columns.
std::vector<char> grownColumns(const std::vector<char>& set, int width, int height, int by) {
    // The structuring element is a square, so one pass along rows and one along columns do it.
    const auto pass = [&](const std::vector<char>& from, int step_x, int step_y) {
        std::vector<char> grown(from.size(), 0);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int k = -by; k <= by; ++k) {
                    const int nx = x + k * step_x;
                    const int ny = y + k * step_y;
                    if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
                    if (from[ny * width + nx] == 0) continue;
                    grown[y * width + x] = 1;
                    break;
                }
            }
        }
        return grown;
    };
    return pass(pass(set, 1, 0), 0, 1);
}

std::vector<char> invertedColumns(std::vector<char> set) {
    for (char& one : set) one = one == 0 ? 1 : 0;
    return set;
}

/// The height shared by most of the sorted heights, within 1 mm.
double mostCommon(const std::vector<double>& sorted) {
    std::size_t best = 0;
    std::size_t most = 0;
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); ++begin) {
        while (end < sorted.size() && sorted[end] <= sorted[begin] + kBin_m) ++end;
        if (end - begin <= most) continue;
        most = end - begin;
        best = begin + (end - begin) / 2;
    }
    return sorted[best];
}

}  // namespace

FloorLevels::FloorLevels(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                         const FloorHeights& floors, const std::vector<NoGoBox>& no_go,
                         const BodyParams& body, double camera_radius_m)
    : body_(body),
      radius_m_(body.body == BodyShape::Cylinder ? body.body_radius_m : 0.0),
      grid_(floors.grid()) {
    cells_.resize(free_space.rooms().size());
    for (const double height : findHeights(free_space, floors)) {
        levels_.push_back(makeLevel(scene, floors, no_go, height));
        reach(levels_.back(), rays, free_space, no_go, camera_radius_m);
    }
}

Eigen::Vector3d FloorLevels::placeOver(std::size_t column, double height) const {
    const Eigen::Vector2d at = grid_.centreOf(column);
    return {at.x(), at.y(), height + body_.camera_height_m};
}

/// Collects the floor heights under all cells where the camera fits, takes the most common one with
/// all heights within a step of it, and repeats with the rest.
std::vector<double> FloorLevels::findHeights(const FreeSpace& free_space,
                                             const FloorHeights& floors) const {
    std::vector<double> found;
    const std::size_t columns = grid_.size();
    for (std::size_t c = 0; c < columns; ++c) {
        const std::vector<float>& of_column = floors.at(c);
        for (std::size_t i = 0; i < of_column.size(); ++i) {
            // Skip a surface with another one between it and the camera: it is inside a slab.
            const Eigen::Vector3d place = placeOver(c, of_column[i]);
            if (i + 1 < of_column.size() && of_column[i + 1] <= place.z()) continue;
            if (free_space.componentAt(place) >= 0) found.push_back(of_column[i]);
        }
    }
    std::ranges::sort(found);
    std::vector<double> heights;
    const double least = std::min(kLeastLevel_m2 / (grid_.cell_m * grid_.cell_m),
                                  0.5 * static_cast<double>(found.size()));
    while (!found.empty()) {
        const double height = mostCommon(found);
        const std::size_t all = found.size();
        std::erase_if(found,
                      [&](double one) { return std::abs(one - height) <= body_.max_step_m; });
        if (static_cast<double>(all - found.size()) >= least) heights.push_back(height);
    }
    return heights;
}

std::vector<char> FloorLevels::floorOf(double height, const FloorHeights& floors) const {
    std::vector<char> own(grid_.size(), 0);
    std::vector<char> open(own.size(), 0);  // no floor of any level to bridge to
    for (std::size_t c = 0; c < own.size(); ++c) {
        const std::vector<float>& of_column = floors.at(c);
        const auto within = [&](double low, double high) {
            return std::ranges::any_of(of_column,
                                       [&](float floor) { return floor >= low && floor <= high; });
        };
        own[c] = within(height - body_.max_step_m, height + body_.max_step_m) ? 1 : 0;
        open[c] = within(height - kDeepestGap_m, height + body_.max_step_m) ? 0 : 1;
    }
    const int by = static_cast<int>(std::ceil(0.5 * kWidestGap_m / grid_.cell_m));
    const std::vector<char> closed = invertedColumns(
        grownColumns(invertedColumns(grownColumns(own, grid_.columns_x, grid_.columns_y, by)),
                     grid_.columns_x, grid_.columns_y, by));
    for (std::size_t c = 0; c < own.size(); ++c) {
        if (closed[c] != 0 && open[c] != 0) own[c] = 1;
    }
    return own;
}

FloorLevels::Level FloorLevels::makeLevel(const Scene& scene, const FloorHeights& floors,
                                          const std::vector<NoGoBox>& no_go, double height) const {
    const double bottom = height + body_.max_step_m;
    const double top = height + (radius_m_ > 0.0 ? body_.body_height_m : body_.max_step_m);
    FlatObstacles flat(bottom, top);
    std::vector<int> ids;
    if (radius_m_ > 0.0) {
        for (const Object& object : scene.objects) {
            if (flat.addObject(scene, object)) ids.push_back(object.id);
        }
        for (const NoGoBox& box : no_go) {
            if (flat.addBox(box.box)) ids.push_back(0);
        }
    }
    std::vector<char> floor = floorOf(height, floors);
    // Floor edges: columns without floor next to a column with floor.
    flat.beginObject();
    for (int y = 0; y < grid_.columns_y; ++y) {
        for (int x = 0; x < grid_.columns_x; ++x) {
            const auto is = [&](int cx, int cy) {
                return cx >= 0 && cy >= 0 && cx < grid_.columns_x && cy < grid_.columns_y &&
                       floor[cy * grid_.columns_x + cx] != 0;
            };
            if (is(x, y) || std::ranges::none_of(kAround, [&](const std::array<int, 2>& step) {
                    return is(x + step[0], y + step[1]);
                })) {
                continue;
            }
            const Eigen::Vector2d corner = grid_.origin + grid_.cell_m * Eigen::Vector2d(x, y);
            flat.addSquare(corner, corner + Eigen::Vector2d::Constant(grid_.cell_m));
        }
    }
    if (flat.endObject()) ids.push_back(0);
    return {height, std::move(floor), std::vector<char>(grid_.size(), 0), std::move(ids),
            RayCaster(flat.scene())};
}

void FloorLevels::reach(Level& level, const RayCaster& rays, const FreeSpace& free_space,
                        const std::vector<NoGoBox>& no_go, double camera_radius_m) {
    const double reach_m = camera_radius_m + SweptSphere::kMargin;
    std::vector<int> component(level.floor.size(), -1);
    parallelRanges(level.floor.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            if (level.floor[c] == 0) continue;
            const Eigen::Vector3d place = placeOver(c, level.floor_m);
            const int room = free_space.componentAt(place);
            if (room < 0 || clearance(place).free_m < SweptSphere::kMargin) continue;
            const bool is_clear =
                free_space.clearanceLowerBound(place) >= reach_m || rays.isClear(place, reach_m);
            const bool is_allowed = std::ranges::none_of(
                no_go, [&](const NoGoBox& box) { return box.box.distance(place) < reach_m; });
            if (is_clear && is_allowed) component[c] = room;
        }
    });
    std::map<int, std::vector<std::size_t>> largest;  // connected area, by component
    std::vector<char> seen(component.size(), 0);
    for (std::size_t first = 0; first < component.size(); ++first) {
        if (component[first] < 0 || seen[first] != 0) continue;
        std::vector<std::size_t> part = {first};
        seen[first] = 1;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const int x = static_cast<int>(part[i]) % grid_.columns_x;
            const int y = static_cast<int>(part[i]) / grid_.columns_x;
            for (const auto& [dx, dy] : kAround) {
                if (dx != 0 && dy != 0) continue;
                if (x + dx < 0 || y + dy < 0 || x + dx >= grid_.columns_x ||
                    y + dy >= grid_.columns_y) {
                    continue;
                }
                const std::size_t next = (y + dy) * grid_.columns_x + x + dx;
                if (component[next] != component[first] || seen[next] != 0) continue;
                seen[next] = 1;
                part.push_back(next);
            }
        }
        std::vector<std::size_t>& best = largest[component[first]];
        if (part.size() > best.size()) best = std::move(part);
    }
    for (auto& [room, part] : largest) {
        if (static_cast<double>(part.size()) * grid_.cell_m * grid_.cell_m < kLeastReached_m2)
            continue;
        std::ranges::sort(part);
        for (const std::size_t c : part) {
            level.reached[c] = 1;
            cells_[room].push_back(placeOver(c, level.floor_m).cast<float>());
        }
    }
}

int FloorLevels::levelAt(const Eigen::Vector3d& place) const {
    const auto found = std::ranges::find_if(levels_, [&](const Level& level) {
        return std::abs(place.z() - level.floor_m - body_.camera_height_m) <= kSameHeight_m;
    });
    return found == levels_.end() ? -1 : static_cast<int>(found - levels_.begin());
}

Eigen::Vector3d FloorLevels::onLevel(const Eigen::Vector3d& place) const {
    const int column = grid_.columnOf(place);
    const Level* best = nullptr;
    // Prefer a level with floor at this column, then a level below the position.
    const auto rank = [&](const Level& level) {
        const bool is_below = level.floor_m <= place.z() + kSameHeight_m;
        const bool is_there = column >= 0 && level.floor[column] != 0;
        return std::tuple(is_there, is_below, is_below ? level.floor_m : -level.floor_m);
    };
    for (const Level& level : levels_) {
        if (best == nullptr || rank(level) > rank(*best)) best = &level;
    }
    if (best == nullptr) return place;
    return {place.x(), place.y(), best->floor_m + body_.camera_height_m};
}

bool FloorLevels::isReached(const Eigen::Vector3d& place) const {
    const int index = levelAt(place);
    const int column = grid_.columnOf(place);
    if (index < 0 || column < 0) return false;
    const std::vector<char>& reached = levels_[index].reached;
    if (reached[column] != 0) return true;
    // A position may be free although the centre of its own column is not.
    return std::ranges::any_of(kAround, [&](const std::array<int, 2>& step) {
        const int x = column % grid_.columns_x + step[0];
        const int y = column / grid_.columns_x + step[1];
        return x >= 0 && y >= 0 && x < grid_.columns_x && y < grid_.columns_y &&
               reached[y * grid_.columns_x + x] != 0;
    });
}

BodyClearance FloorLevels::clearance(const Eigen::Vector3d& place) const {
    const int index = levelAt(place);
    if (index < 0) return {0.0, 0};
    const Level& level = levels_[index];
    const double limit = radius_m_ + kFarthest_m;
    const ClosestPoint closest = level.plan.closest({place.x(), place.y(), 0.0}, limit);
    if (closest.object_id == 0) return {kFarthest_m, 0};
    return {closest.distance - radius_m_, level.object_ids[closest.object_id - 1]};
}

std::vector<double> FloorLevels::heights() const {
    std::vector<double> heights;
    for (const Level& level : levels_) heights.push_back(level.floor_m);
    return heights;
}

}  // namespace dollytrack::planning
