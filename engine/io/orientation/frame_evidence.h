#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/orientation/support_evidence.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace dollytrack {

/// One object's measures, in the source's axes and unit: evidence for the upward axis and the unit.
struct MeasuredThing {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // of its surface
    std::array<double, 3> facing{};                      // area that faces along x, y, z
    double area = 0.0;
    int nyu40 = 0;
    bool building = false;  // part of it, by name or shape
    bool by_shape = false;  // perhaps judged so by its shape, which presumes what is up
    SideSupport support{};
};

/// How the surfaces that lie across an axis are spread along it: area by height, in equal steps of
/// the core from its low end to its high end.
struct LevelAreas {
    static constexpr std::size_t kSteps = 50;
    std::array<double, kSteps> all{};        // facing either way
    std::array<double, kSteps> furniture{};  // without what is named as part of the building
    std::array<double, kSteps> floors{};     // of what is named a floor or a ceiling
};

struct FrameEvidence {
    std::vector<MeasuredThing> things;
    /// The part of the scene that holds nearly all things: 5 % of them at each end may be strays.
    Eigen::AlignedBox3d core;
    std::array<LevelAreas, 3> levels;  // across x, y, z
};

/// In the source's axes and unit.
FrameEvidence collectEvidence(const RawScene& raw, const std::vector<ObjectDraft>& drafts);

/// In the world's axes, metres. `classes_by_shape`: what is part of the building may have been
/// judged so by its shape.
FrameEvidence collectEvidence(const Scene& scene, bool classes_by_shape = false);

}  // namespace dollytrack
