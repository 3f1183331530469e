#include "planning/viewpoints/candidate_source.h"

#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

namespace dollytrack::planning {
namespace {

const double kGoldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));

Eigen::Vector3d onSphere(double z, double angle) {
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The rooms' cells near a position, by number. Hundreds of thousands of cells exist and few are
/// drawn, so they are counted in blocks instead of listed.
class CellsNear {
  public:
    CellsNear(const FreeSpace& free_space, const SweptSphere& sphere, Eigen::Vector3d center,
              double distance_m)
        : center_(std::move(center)), squared_(distance_m * distance_m) {
        for (std::size_t room = 0; room < free_space.rooms().size(); ++room) {
            const auto& cells = sphere.cells(static_cast<int>(room));
            for (std::size_t first = 0; first < cells.size(); first += kBlock) {
                const std::span<const Eigen::Vector3f> block(
                    cells.data() + first, std::min(kBlock, cells.size() - first));
                std::uint32_t near = 0;
                for (const Eigen::Vector3f& cell : block) near += isNear(cell) ? 1 : 0;
                if (near == 0) continue;
                blocks_.push_back({block, count_});
                count_ += near;
            }
        }
    }

    [[nodiscard]] std::uint32_t count() const { return count_; }

    [[nodiscard]] Eigen::Vector3d cell(std::uint32_t number) const {
        const auto block = std::prev(std::ranges::upper_bound(blocks_, number, {}, &Block::before));
        std::uint32_t passed = block->before;
        for (const Eigen::Vector3f& cell : block->cells) {
            if (isNear(cell) && passed++ == number) return cell.cast<double>();
        }
        return center_;  // unreachable: the block holds the cell
    }

  private:
    static constexpr std::size_t kBlock = 256;
    struct Block {
        std::span<const Eigen::Vector3f> cells;
        std::uint32_t before = 0;  // cells near in earlier blocks
    };

    [[nodiscard]] bool isNear(const Eigen::Vector3f& cell) const {
        return (cell.cast<double>() - center_).squaredNorm() < squared_;
    }

    Eigen::Vector3d center_;
    double squared_;
    std::vector<Block> blocks_;
    std::uint32_t count_ = 0;
};

}  // namespace

std::vector<Eigen::Vector3d> directionsInCone(const Eigen::Vector3d& axis, double half_angle,
                                              int count) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis);
    std::vector<Eigen::Vector3d> directions = {axis.normalized()};
    for (int i = 0; i < count - 1; ++i) {
        const double share = (i + 0.5) / (count - 1);
        const double z = 1.0 - share * (1.0 - std::cos(half_angle));
        directions.emplace_back(turn * onSphere(z, i * kGoldenAngle));
    }
    return directions;
}

std::vector<Eigen::Vector3d> directionsAllAround(const Eigen::Vector3d& axis, int count) {
    constexpr double kHighest = 0.996;  // sin 85 deg: a roll-free camera looking straight down has
                                        // no defined heading
    constexpr double kLowest = -0.866;  // sin -60 deg
    std::vector<Eigen::Vector3d> directions;
    for (int i = 0; i < count; ++i) {
        const double z = kHighest - (kHighest - kLowest) * (i + 0.5) / count;
        directions.push_back(onSphere(z, i * kGoldenAngle));
    }
    std::stable_sort(directions.begin(), directions.end(),
                     [&](const auto& a, const auto& b) { return a.dot(axis) > b.dot(axis); });
    return directions;
}

double furthestUseful(const ViewEstimator& views, const Subject& subject, double least_fill) {
    double radius = 0.0;
    for (const auto& point : subject.points) {
        radius = std::max(radius, (point - subject.center).norm());
    }
    const Intrinsics& k = views.intrinsics();
    return radius * (1.0 + 2.0 * k.fx / (least_fill * std::min(k.width, k.height)));
}

std::vector<Eigen::Vector3d> randomPlaces(const FreeSpace& free_space, const SweptSphere& sphere,
                                          const ViewEstimator& views, const Subject& subject,
                                          double least_fill, double most_fill, int count,
                                          Random& random) {
    // Draw only from cells in the useful distance, since most of a large house is too far from a
    // small object.
    const CellsNear nearby(free_space, sphere, subject.center,
                           furthestUseful(views, subject, least_fill));
    std::vector<Eigen::Vector3d> places;
    if (nearby.count() == 0) return places;
    const int tries = 6 * count;
    for (int i = 0; i < tries && static_cast<int>(places.size()) < count; ++i) {
        const Eigen::Vector3d place = nearby.cell(random.below(nearby.count()));
        const double fill = fillFrom(views, subject, place);
        if (fill >= least_fill && fill <= most_fill) places.push_back(place);
    }
    return places;
}

}  // namespace dollytrack::planning
