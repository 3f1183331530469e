#include "planning/free_space/scanned_space.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

namespace dollytrack::planning {
namespace {

constexpr double kBlock_m = 0.2;  // edge of the blocks that are classified as a whole
constexpr int kScanDirections = 96;
constexpr double kBestPlaces = 0.1;  // share of the blocks that count as best
constexpr double kGoodPart = 0.5;    // share required, relative to the best blocks

/// Blocks of cells over a grid.
struct Blocks {
    explicit Blocks(const VoxelGrid& grid)
        : edge(std::max(1, static_cast<int>(std::lround(kBlock_m / grid.resolution_m)))) {
        for (unsigned k = 0; k < 3; ++k) count[k] = (grid.count[k] + edge - 1) / edge;
    }

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
               static_cast<std::size_t>(count[2]);
    }
    [[nodiscard]] std::size_t of(int x, int y, int z) const {
        return (static_cast<std::size_t>(z / edge) * static_cast<std::size_t>(count[1]) +
                static_cast<std::size_t>(y / edge)) *
                   static_cast<std::size_t>(count[0]) +
               static_cast<std::size_t>(x / edge);
    }

    int edge;
    std::array<int, 3> count = {0, 0, 0};
};

/// Share of the directions from a position that hit the front of scanned surface, minus the share
/// that hit a back.
double scannedAround(const Eigen::Vector3d& place, const std::vector<Eigen::Vector3d>& directions,
                     const ScannedSurfaces& scan, const RayCaster& rays) {
    int sum = 0;
    for (const Eigen::Vector3d& direction : directions) {
        const auto side = scan.hitSide(rays.cast(place, direction), direction);
        if (side == ScannedSurfaces::HitSide::Front) ++sum;
        if (side == ScannedSurfaces::HitSide::Back) --sum;
    }
    return static_cast<double>(sum) / static_cast<double>(directions.size());
}

}  // namespace

std::vector<std::uint8_t> findScannedSpace(const VoxelGrid& grid,
                                           const std::vector<std::uint8_t>& surfaces,
                                           const ScannedSurfaces& scan, const RayCaster& rays,
                                           const JobContext& job) {
    const Blocks blocks(grid);
    // A block is tested at its cell without surface nearest to its centre.
    std::vector<int> nearest(blocks.size(), -1);
    std::vector<Eigen::Vector3d> places(blocks.size());
    const auto visit = [&](auto&& each) {
        for (int z = grid.room_begin[2]; z < grid.room_end[2]; ++z) {
            for (int y = grid.room_begin[1]; y < grid.room_end[1]; ++y) {
                for (int x = grid.room_begin[0]; x < grid.room_end[0]; ++x) {
                    const std::size_t i = grid.indexOf(x, y, z);
                    if (surfaces[i] == 0) each(i, x, y, z, blocks.of(x, y, z));
                }
            }
        }
    };
    visit([&](std::size_t, int x, int y, int z, std::size_t block) {
        int off = 0;
        for (const int at : {x, y, z}) off += std::abs(2 * (at % blocks.edge) - blocks.edge + 1);
        if (nearest[block] >= 0 && nearest[block] <= off) return;
        nearest[block] = off;
        places[block] = grid.centerOf(x, y, z);
    });
    const std::vector<Eigen::Vector3d> directions = directionsOnSphere(kScanDirections);
    std::vector<double> seen(blocks.size(), -1.0);
    parallelRanges(blocks.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end && !job.cancelled(); ++b) {
            if (nearest[b] >= 0) seen[b] = scannedAround(places[b], directions, scan, rays);
        }
    });
    std::vector<double> order;
    std::ranges::copy_if(seen, std::back_inserter(order), [](double share) { return share > 0.0; });
    std::vector<std::uint8_t> known(grid.size(), 0);
    if (order.empty()) return known;
    const auto best = order.begin() +
                      static_cast<std::ptrdiff_t>(kBestPlaces * static_cast<double>(order.size()));
    std::ranges::nth_element(order, best, std::greater<>());
    const double enough = kGoodPart * *best;
    visit([&](std::size_t i, int, int, int, std::size_t block) {
        known[i] = seen[block] >= enough ? 1 : 0;
    });
    return known;
}

}  // namespace dollytrack::planning
