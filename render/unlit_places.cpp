#include "render/unlit_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr double kStep = 0.4;  // m; between places, more where there would be too many
constexpr double kMostColumns = 2e4;
constexpr double kStandingRoom = 1.6;   // m; a lower gap is a shelf, not a storey
constexpr double kUnderCeiling = 0.25;  // m; below lintels of doors, so these part rooms
constexpr double kFree = 0.3;           // m; around a place: walls and cupboards are hollow, too
constexpr double kSteepest = 1.0;       // of a ceiling, along which places belong together
constexpr double kLitAround = 2.7;  // m; what a new lamp lights: three quarters of their spacing
constexpr double kLitAtMost = 8.0;  // m; what any lamp lights
constexpr std::size_t kFewest = 2;  // places that are worth a lamp
constexpr std::size_t kFewestFar = 24;  // the same, in a room that has a lamp
constexpr std::size_t kMostLamps = 64;

/// A place below a ceiling, where a lamp could hang.
struct Place {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    double height_m = 0.0;  // of the room there
    int column = 0;
    int row = 0;
    int region = -1;
};

class Ceilings {
  public:
    Ceilings(const Scene& scene, const RayCaster& rays, std::span<const Eigen::AlignedBox3d> rooms)
        : rays_(rays) {
        Eigen::AlignedBox3d all;
        for (const Eigen::AlignedBox3d& room : rooms) all.extend(room);
        all = all.intersection(scene.room_bounds);
        if (all.isEmpty()) return;
        low_ = all.min();
        const Eigen::Vector3d size = all.sizes();
        step_ = std::max(kStep, std::sqrt(size.x() * size.y() / kMostColumns));
        for (int row = 0; (row + 0.5) * step_ < size.y(); ++row) {
            for (int column = 0; (column + 0.5) * step_ < size.x(); ++column) {
                addColumn(column, row, all, rooms);
            }
        }
        findRegions();
    }

    [[nodiscard]] const std::vector<Place>& places() const { return places_; }
    [[nodiscard]] int regions() const { return regions_; }
    [[nodiscard]] double step_m() const { return step_; }

    /// The region that a lamp hangs in; -1: none.
    [[nodiscard]] int regionOf(const Lamp& lamp) const {
        const Place* nearest = nullptr;
        double least = 3.0 * step_;
        for (const Place& place : places_) {
            const double away = (place.at - lamp.position).norm();
            if (away >= least || !rays_.sees(place.at, lamp.position)) continue;
            least = away;
            nearest = &place;
        }
        return nearest == nullptr ? -1 : nearest->region;
    }

  private:
    /// Places below each ceiling over a point of the plan.
    void addColumn(int column, int row, const Eigen::AlignedBox3d& all,
                   std::span<const Eigen::AlignedBox3d> rooms) {
        constexpr int kMostSurfaces = 64;
        const Eigen::Vector3d foot(low_.x() + (column + 0.5) * step_,
                                   low_.y() + (row + 0.5) * step_, all.min().z() - 0.5);
        const double far = all.sizes().z() + 1.0;
        double below = -1.0;  // the surface before; nobody stands where there is no floor
        for (int i = 0; i < kMostSurfaces; ++i) {
            const RayHit hit =
                rays_.cast(foot, Eigen::Vector3d::UnitZ(), far, std::max(below, 0.0) + 1e-4);
            if (hit.object_id == 0) return;
            if (below >= 0.0 && hit.distance - below >= kStandingRoom) {
                const Eigen::Vector3d at =
                    foot + (hit.distance - kUnderCeiling) * Eigen::Vector3d::UnitZ();
                const bool inside = std::ranges::any_of(
                    rooms, [&](const Eigen::AlignedBox3d& room) { return room.contains(at); });
                if (inside && rays_.isClear(at, std::min(kFree, 0.8 * kUnderCeiling)) &&
                    standsFree(at)) {
                    places_.push_back({at, hit.distance - below, column, row, -1});
                }
            }
            below = hit.distance;
        }
    }

    /// Nothing is near it, on its own height.
    [[nodiscard]] bool standsFree(const Eigen::Vector3d& at) const {
        for (const double x : {-kFree, kFree}) {
            for (const double y : {-kFree, kFree}) {
                if (!rays_.sees(at, at + Eigen::Vector3d(x, y, 0.0))) return false;
            }
        }
        return true;
    }

    /// Joins places beside each other that see each other below their ceilings.
    void findRegions() {
        std::map<std::pair<int, int>, std::vector<std::size_t>> of_column;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            of_column[{places_[i].column, places_[i].row}].push_back(i);
        }
        std::vector<std::size_t> next;
        for (std::size_t start = 0; start < places_.size(); ++start) {
            if (places_[start].region >= 0) continue;
            places_[start].region = regions_;
            next.assign(1, start);
            while (!next.empty()) {
                const Place from = places_[next.back()];
                next.pop_back();
                for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    const auto column = of_column.find({from.column + x, from.row + y});
                    if (column == of_column.end()) continue;
                    for (const std::size_t i : column->second) {
                        Place& to = places_[i];
                        if (to.region >= 0) continue;
                        if (std::abs(to.at.z() - from.at.z()) > kSteepest * step_) continue;
                        if (!rays_.sees(from.at, to.at)) continue;
                        to.region = regions_;
                        next.push_back(i);
                    }
                }
            }
            ++regions_;
        }
    }

    const RayCaster& rays_;
    Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
    double step_ = kStep;
    std::vector<Place> places_;
    int regions_ = 0;
};

/// The place nearest to the middle of these.
const Place& middleOf(const std::vector<const Place*>& places) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Place* place : places) sum += place->at;
    const Eigen::Vector3d middle = sum / static_cast<double>(places.size());
    return **std::ranges::min_element(
        places, {}, [&](const Place* place) { return (place->at - middle).squaredNorm(); });
}

/// Of a lamp that lights so many places alone: as much light on all surfaces around as an intensity
/// of 1 sends in an ordinary room of the lamps' spacing, so that store rooms are no brighter.
double intensityFor(std::size_t places, double step_m, double height_m) {
    const auto surfaces = [](double side, double height) {
        return 2.0 * side * side + 4.0 * side * height;
    };
    const double side = std::sqrt(static_cast<double>(places)) * step_m + 2.0 * kFree;
    return std::clamp(surfaces(side, height_m) / surfaces(3.6, 2.6), 0.25, 2.0);
}

}  // namespace

std::vector<Lamp> lampsForUnlitPlaces(const Scene& scene, const RayCaster& rays,
                                      std::span<const Eigen::AlignedBox3d> rooms,
                                      std::span<const Lamp> lamps) {
    const Ceilings ceilings(scene, rays, rooms);
    std::vector<bool> has_lamp(static_cast<std::size_t>(ceilings.regions()), false);
    for (const Lamp& lamp : lamps) {
        const int region = ceilings.regionOf(lamp);
        if (region >= 0) has_lamp[static_cast<std::size_t>(region)] = true;
    }
    std::vector<Lamp> added;
    for (int region = 0; region < ceilings.regions(); ++region) {
        const bool lit = has_lamp[static_cast<std::size_t>(region)];
        const std::size_t fewest = lit ? kFewestFar : kFewest;
        std::vector<const Place*> dark;
        for (const Place& place : ceilings.places()) {
            if (place.region == region) dark.push_back(&place);
        }
        const auto light = [&](const Lamp& lamp, double reach) {
            std::erase_if(dark, [&](const Place* place) {
                return (place->at - lamp.position).norm() < reach &&
                       rays.sees(place->at, lamp.position);
            });
        };
        for (const Lamp& lamp : lamps) {
            if (lit) light(lamp, kLitAtMost);
        }
        while (dark.size() >= fewest && added.size() < kMostLamps) {
            const Place& place = middleOf(dark);
            Lamp lamp;
            lamp.position = place.at;
            lamp.radius_m = 0.2;
            const std::size_t before = dark.size();
            std::erase(dark, &place);
            light(lamp, lit ? kLitAtMost : kLitAround);
            lamp.intensity = intensityFor(before - dark.size(), ceilings.step_m(), place.height_m);
            added.push_back(lamp);
        }
    }
    return added;
}

}  // namespace dollytrack::render
