#include "planning/free_space/surface_coverage.h"

#include "engine/io/pointcloud/unseen_floor.h"
#include "planning/visibility/scanned_surfaces.h"

#include <algorithm>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kCoveragePlaces = 256;
constexpr int kCoverageDirections = 128;

}  // namespace

double surfaceCoverage(const Scene& scene, const RayCaster& rays, const FreeSpace& map) {
    std::size_t cells = 0;
    for (std::size_t i = 0; i < map.rooms().size(); ++i) {
        cells += map.cells(static_cast<int>(i)).size();
    }
    const std::size_t stride = std::max<std::size_t>(1, cells / kCoveragePlaces);
    const std::vector<Eigen::Vector3d> directions = directionsOnSphere(kCoverageDirections);
    const double reach = scene.room_bounds.diagonal().norm() + 1.0;
    std::size_t asked = 0;
    std::size_t ended = 0;
    std::size_t next = stride / 2;
    std::size_t passed = 0;
    for (std::size_t i = 0; i < map.rooms().size(); ++i) {
        const auto& room = map.cells(static_cast<int>(i));
        for (; next < passed + room.size(); next += stride) {
            const Eigen::Vector3d from = room[next - passed].cast<double>();
            for (const Eigen::Vector3d& direction : directions) {
                const int id = rays.cast(from, direction, reach).object_id;
                ++asked;
                ended += id != 0 && scene.object(id).name != kUnseenFloor;
            }
        }
        passed += room.size();
    }
    return asked > 0 ? static_cast<double>(ended) / static_cast<double>(asked) : 0.0;
}

}  // namespace dollytrack::planning
