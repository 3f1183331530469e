#include "engine/io/pointcloud/cloud_floor.h"

#include "engine/io/pointcloud/unseen_floor.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/scene/labels.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <vector>

namespace dollytrack {
namespace {

constexpr double kBelow = 0.02;    // m below the scanned points
constexpr double kBeside = 0.5;    // m around the scanner's position
constexpr double kBefore = 1.5;    // m in front of surfaces: typical position of a depth camera
constexpr double kOneSided = 0.5;  // smallest length of the mean normal if all face one way

/// The lowest height without the lowest 2 %, which may be outliers.
double lowest(std::vector<double> heights) {
    const auto at = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 50);
    std::nth_element(heights.begin(), at, heights.end());
    return *at;
}

/// Height of the floor along the up direction, which may be a negative axis.
double floorHeight(const CloudSamples& samples, const CloudLabels& labels, UpAxis up) {
    std::vector<double> floor;
    std::vector<double> all;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const CloudObject& object = labels.objects[labels.object_of[i]];
        all.push_back(up.direction().dot(samples.points[i]));
        if (object.nyu40 == kNyuFloor) floor.push_back(up.direction().dot(samples.points[i]));
    }
    return lowest(floor.empty() ? std::move(all) : std::move(floor)) - kBelow;
}

Eigen::AlignedBox3d reachOf(const CloudSamples& samples,
                            const std::optional<Eigen::Vector3d>& viewpoint) {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d facing = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        box.extend(samples.points[i]);
        facing += samples.normals[i];
    }
    if (viewpoint) {
        box.extend((viewpoint->array() - kBeside).matrix().eval());
        box.extend((viewpoint->array() + kBeside).matrix().eval());
        return box;
    }
    facing /= static_cast<double>(samples.points.size());
    if (facing.norm() < kOneSided) return box;
    const Eigen::Vector3d before = kBefore * facing.normalized();
    const Eigen::Vector3d beside = Eigen::Vector3d::Constant(kBeside);
    return box.merged(
        Eigen::AlignedBox3d(box.min() + before - beside, box.max() + before + beside));
}

}  // namespace

void addFloor(const CloudSamples& samples, const CloudLabels& labels,
              const std::optional<Eigen::Vector3d>& viewpoint, UpAxis up, RawScene& raw) {
    const double height = floorHeight(samples, labels, up);
    const Eigen::AlignedBox3d reach = reachOf(samples, viewpoint);
    // The floor's front faces up: for a negative up axis the other two axes are swapped.
    const int along = (up.index() + (up.negative ? 2 : 1)) % 3;
    const int across = (up.index() + (up.negative ? 1 : 2)) % 3;
    std::vector<Eigen::Vector3f> positions;
    for (const auto& [far_along, far_across] :
         {std::array{false, false}, {true, false}, {true, true}, {false, true}}) {
        Eigen::Vector3d corner;
        corner[up.index()] = up.sign() * height;
        corner[along] = (far_along ? reach.max() : reach.min())[along];
        corner[across] = (far_across ? reach.max() : reach.min())[across];
        positions.push_back(corner.cast<float>());
    }
    const std::vector<std::uint32_t> sizes = {3, 3};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    SourceObject& object = raw.objects.emplace_back();
    object.name = kUnseenFloor;
    object.nyu40 = kNyuFloor;
    object.structure = true;
    object.parts = {raw.parts.size()};
    raw.nodes.push_back({object.name, 0, 0});
    ++raw.nodes.front().children;
    Material material;
    material.name = object.name;
    MeshPart part;
    part.name = object.name;
    part.node = static_cast<int>(raw.nodes.size()) - 1;
    part.material = static_cast<std::uint32_t>(raw.materials.size());
    raw.materials.push_back(material);
    buildMeshPart({positions, {}, {}, sizes, indices}, Eigen::Affine3d::Identity(), part);
    raw.parts.push_back(std::move(part));
}

}  // namespace dollytrack
