#include "planning/viewpoints/candidate_source.h"

#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

const double kGoldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));

Eigen::Vector3d onSphere(double z, double angle) {
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

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
    constexpr double kHighest = 0.996;  // sin 85 deg: straight down a roll-free camera has no up
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
    // Cells in the shell of useful distances only: most of a large house is of no use to a mug.
    const double furthest = furthestUseful(views, subject, least_fill);
    std::vector<const Eigen::Vector3f*> nearby;
    for (std::size_t room = 0; room < free_space.rooms().size(); ++room) {
        for (const Eigen::Vector3f& cell : sphere.cells(static_cast<int>(room))) {
            if ((cell.cast<double>() - subject.center).squaredNorm() < furthest * furthest) {
                nearby.push_back(&cell);
            }
        }
    }
    std::vector<Eigen::Vector3d> places;
    if (nearby.empty()) return places;
    const int tries = 6 * count;
    for (int i = 0; i < tries && static_cast<int>(places.size()) < count; ++i) {
        const auto pick = random.below(static_cast<std::uint32_t>(nearby.size()));
        const Eigen::Vector3d place = nearby[pick]->cast<double>();
        const double fill = fillFrom(views, subject, place);
        if (fill >= least_fill && fill <= most_fill) places.push_back(place);
    }
    return places;
}

}  // namespace dollytrack::planning
