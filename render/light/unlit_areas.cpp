#include "render/light/unlit_areas.h"

#include "engine/jobs/parallel.h"
#include "engine/math/quantile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr double kGridStep_m = 0.3;  // between positions, so a room 0.9 m wide has one;
                                     // larger in large scenes
constexpr double kMostColumns = 3e4;
constexpr double kStandingRoom = 1.6;   // m; a lower gap is a shelf, not a storey
constexpr double kUnderCeiling = 0.25;  // m; below door lintels, so that doors separate rooms
constexpr double kFree = 0.3;           // m; free space around a position: walls and cupboards may
                                        // be hollow
constexpr double kSteepest = 1.0;       // largest ceiling slope between connected positions
constexpr double kEyes = 1.0;           // m; above the floor: height at which light is measured
constexpr double kDark = 0.05;          // relative to the median light of lit positions
constexpr double kLitAround = 2.7;  // m; radius that a new lamp lights: three quarters of the lamp
                                    // spacing
constexpr std::size_t kFewest = 2;  // dark positions that justify a lamp
constexpr std::size_t kFewestBeside = 44;  // the same (4 m2) in a room that is mostly lit
constexpr std::size_t kMostLamps = 64;

/// A position where a person can stand, with the point below its ceiling where a lamp can hang.
struct Place {
    Eigen::Vector3d lamp = Eigen::Vector3d::Zero();
    double height_m = 0.0;  // from floor to ceiling
    int column = 0;
    int row = 0;

    [[nodiscard]] Eigen::Vector3d eyes() const {
        return lamp - (height_m - kUnderCeiling - kEyes) * Eigen::Vector3d::UnitZ();
    }
};

using PlaceSet = std::vector<std::size_t>;

class Places {
  public:
    Places(const Scene& scene, const RayCaster& rays, std::span<const Eigen::AlignedBox3d> rooms)
        : rays_(rays) {
        Eigen::AlignedBox3d all;
        for (const Eigen::AlignedBox3d& room : rooms) all.extend(room);
        all = all.intersection(scene.room_bounds);
        if (all.isEmpty()) return;
        const Eigen::Vector3d size = all.sizes();
        step_m_ = std::max(kGridStep_m, std::sqrt(size.x() * size.y() / kMostColumns));
        for (int row = 0; (row + 0.5) * step_m_ < size.y(); ++row) {
            for (int column = 0; (column + 0.5) * step_m_ < size.x(); ++column) {
                addColumn(column, row, all, rooms);
            }
        }
        for (std::size_t i = 0; i < places_.size(); ++i) {
            of_column_[{places_[i].column, places_[i].row}].push_back(i);
        }
    }

    [[nodiscard]] const Place& at(std::size_t i) const { return places_[i]; }
    [[nodiscard]] double step_m() const { return step_m_; }

    /// Direct light at each position from these lamps, on a surface facing the lamp.
    [[nodiscard]] std::vector<double> lightOf(std::span<const Lamp> lamps) const;

    /// Groups positions into sets of neighbours that see each other just below their ceilings.
    [[nodiscard]] std::vector<PlaceSet> connected(std::vector<bool> counts) const;

  private:
    /// Adds the positions below each ceiling over a point of the floor plan.
    void addColumn(int column, int row, const Eigen::AlignedBox3d& all,
                   std::span<const Eigen::AlignedBox3d> rooms) {
        constexpr int kMostSurfaces = 64;
        constexpr double kBelow = 0.5;  // m; the lowest floor may lie slightly below the box
        const Eigen::Vector3d foot =
            all.min() + Eigen::Vector3d((column + 0.5) * step_m_, (row + 0.5) * step_m_, -kBelow);
        double below = -1.0;  // height of the surface below; -1: none yet, so no floor to stand on
        for (int i = 0; i < kMostSurfaces; ++i) {
            const RayHit hit =
                rays_.cast(foot, Eigen::Vector3d::UnitZ(), all.sizes().z() + 2.0 * kBelow,
                           std::max(below, 0.0) + 1e-4);
            if (hit.object_id == 0) return;
            const Eigen::Vector3d lamp =
                foot + (hit.distance - kUnderCeiling) * Eigen::Vector3d::UnitZ();
            const double height_m = hit.distance - below;
            const bool inside =
                std::ranges::any_of(rooms, [&](const auto& room) { return room.contains(lamp); });
            if (below >= 0.0 && height_m >= kStandingRoom && inside && standsFree(lamp)) {
                places_.push_back({lamp, height_m, column, row});
            }
            below = hit.distance;
        }
    }

    /// Whether nothing is near the point at its own height.
    [[nodiscard]] bool standsFree(const Eigen::Vector3d& at) const {
        if (!rays_.isClear(at, 0.8 * kUnderCeiling)) return false;
        for (const double x : {-kFree, kFree}) {
            for (const double y : {-kFree, kFree}) {
                if (!rays_.sees(at, at + Eigen::Vector3d(x, y, 0.0))) return false;
            }
        }
        return true;
    }

    const RayCaster& rays_;
    double step_m_ = kGridStep_m;
    std::vector<Place> places_;
    std::map<std::pair<int, int>, PlaceSet> of_column_;
};

std::vector<double> Places::lightOf(std::span<const Lamp> lamps) const {
    std::vector<double> light(places_.size(), 0.0);
    parallelRanges(light.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Eigen::Vector3d eyes = places_[i].eyes();
            for (const Lamp& lamp : lamps) {
                const Eigen::Vector3d way = lamp.position - eyes;
                const double distance = way.norm();
                if (way.z() <= 0.0 || distance > kLampReach_m) continue;
                const double free = std::max(0.0, 1.0 - kLampShade / distance);
                if (!rays_.sees(eyes, eyes + free * way)) continue;
                light[i] += lamp.intensity * way.z() / std::pow(distance, 3.0);
            }
        }
    });
    return light;
}

std::vector<PlaceSet> Places::connected(std::vector<bool> counts) const {
    std::vector<PlaceSet> sets;
    for (std::size_t start = 0; start < places_.size(); ++start) {
        if (!counts[start]) continue;
        counts[start] = false;
        PlaceSet set = {start};
        for (std::size_t next = 0; next < set.size(); ++next) {
            const Place& from = places_[set[next]];
            for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                const auto column = of_column_.find({from.column + x, from.row + y});
                if (column == of_column_.end()) continue;
                for (const std::size_t i : column->second) {
                    const Eigen::Vector3d& to = places_[i].lamp;
                    const bool level = std::abs(to.z() - from.lamp.z()) <= kSteepest * step_m_;
                    if (!counts[i] || !level || !rays_.sees(from.lamp, to)) continue;
                    counts[i] = false;
                    set.push_back(i);
                }
            }
        }
        sets.push_back(std::move(set));
    }
    return sets;
}

/// Which positions get less than kDark of the median light.
std::vector<bool> darkOf(const std::vector<double>& light) {
    std::vector<double> lit;
    for (const double one : light) {
        if (one > 0.0) lit.push_back(one);
    }
    const double limit = lit.empty() ? 1e-9 : kDark * upperMedian(std::move(lit));
    std::vector<bool> dark;
    for (const double one : light) dark.push_back(one < limit);
    return dark;
}

/// The position nearest to a set's centroid.
std::size_t middleOf(const PlaceSet& set, const Places& places) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::size_t i : set) middle += places.at(i).lamp / static_cast<double>(set.size());
    return *std::ranges::min_element(
        set, {}, [&](std::size_t i) { return (places.at(i).lamp - middle).squaredNorm(); });
}

/// Intensity of a lamp that lights this many positions alone. Surfaces around it get as much light
/// as in an ordinary room with a lamp of intensity 1, so that a store room is no brighter.
double intensityFor(std::size_t places, double step_m, double height_m) {
    const auto surfaces = [](double side, double height) {
        return 2.0 * side * side + 4.0 * side * height;
    };
    const double side = std::sqrt(static_cast<double>(places)) * step_m + 2.0 * kFree;
    return std::clamp(surfaces(side, height_m) / surfaces(3.6, 2.6), 0.25, 2.0);
}

}  // namespace

std::vector<Lamp> lampsForUnlitAreas(const Scene& scene, const RayCaster& rays,
                                     std::span<const Eigen::AlignedBox3d> rooms,
                                     std::span<const Lamp> lamps) {
    const Places places(scene, rays, rooms);
    const std::vector<bool> dark = darkOf(places.lightOf(lamps));
    std::vector<std::size_t> room_size(dark.size(), 0);  // by position: number of positions in its
                                                         // room
    for (const PlaceSet& room : places.connected(std::vector<bool>(dark.size(), true))) {
        for (const std::size_t i : room) room_size[i] = room.size();
    }
    std::vector<Lamp> added;
    for (PlaceSet& part : places.connected(dark)) {
        const bool is_most = 2 * part.size() > room_size[part.front()];
        const std::size_t fewest = is_most ? kFewest : kFewestBeside;
        while (part.size() >= fewest && added.size() < kMostLamps) {
            const Place& place = places.at(middleOf(part, places));
            const std::size_t lit = std::erase_if(part, [&](std::size_t i) {
                const Eigen::Vector3d& other = places.at(i).lamp;
                const double away = (other - place.lamp).norm();
                return away == 0.0 || (away < kLitAround && rays.sees(other, place.lamp));
            });
            Lamp lamp;
            lamp.position = place.lamp;
            lamp.position.z() -= std::max(0.0, place.height_m - kUnderCeiling - kHighestLamp_m);
            lamp.radius_m = 0.2;
            lamp.intensity = intensityFor(lit, places.step_m(), place.height_m);
            added.push_back(lamp);
        }
    }
    return added;
}

}  // namespace dollytrack::render
