#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/orientation/support_evidence.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace dollytrack {

/// Measurements of one object, as evidence for the up axis and the unit.
struct MeasuredObject {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // of its surface
    std::array<double, 3> facing{};                      // area facing along x, y, z
    double area = 0.0;
    int nyu40 = 0;
    bool building = false;  // part of the building, by name or shape
    bool shines = false;    // all its materials emit light; false for all if most objects do
    bool by_shape = false;  // `building` may be due to the shape, which assumes an up axis
    SideSupport support{};
};

/// Histogram of the area of surfaces perpendicular to an axis, by position along the axis, in equal
/// steps from the low to the high end of the core.
struct LevelAreas {
    static constexpr std::size_t kSteps = 50;
    std::array<double, kSteps> all{};        // facing in either direction
    std::array<double, kSteps> furniture{};  // without objects named as parts of the building
    std::array<double, kSteps> floors{};     // of objects named floor or ceiling
};

struct FrameEvidence {
    std::vector<MeasuredObject> objects;
    /// The box of nearly all objects, without up to 5 % of outliers at each end of each axis.
    Eigen::AlignedBox3d core;
    std::array<LevelAreas, 3> levels;  // for x, y, z
};

/// Whether an object is as wide as the core along two axes and thinner along this one, as floors,
/// ceilings and walls are.
[[nodiscard]] bool isRoomSide(const MeasuredObject& object, const Eigen::AlignedBox3d& core,
                              int axis);

/// Measures the drafts, in the source's axes and unit.
FrameEvidence collectEvidence(const RawScene& raw, const std::vector<ObjectDraft>& drafts);

/// Measures a scene, in the world's axes and metres. `classes_by_shape`: objects may have been
/// classified as parts of the building by their shape.
FrameEvidence collectEvidence(const Scene& scene, bool classes_by_shape = false);

}  // namespace dollytrack
