#pragma once

#include "planning/free_space/free_space.h"
#include "render/draw/view.h"
#include "ui/overlays/legend.h"
#include "ui/overlays/slice.h"

#include <optional>

namespace dollytrack::ui {

/// What the colour of a free cell says. Component: which connected part of the space that the
/// camera fits into, which is a room where doors are shut. Level: of the octree, by its size.
enum class CellColor { State, Clearance, Component, Level };

struct FreeSpaceOverlayOptions {
    bool free = true;
    bool occupied = true;
    bool unknown = true;  // only in a slice: there is too much of it
    int min_level = 0;    // 0: the smallest cells; one more doubles the edge
    int max_level = 16;
    std::optional<Slice> slice;  // none: all of the map
    CellColor color = CellColor::State;
    float opacity = 0.5F;
    bool operator==(const FreeSpaceOverlayOptions&) const = default;
};

/// The leaves of the octree as blocks, in a slice cut to it. Coloured by clearance, free leaves
/// in a slice are cut into pieces of at most four cells, for the clearance changes within them.
/// What is not in the octree is unknown: shown as the largest such blocks within the slice.
[[nodiscard]] PlanLayer freeSpaceLayer(const planning::FreeSpace& free_space,
                                       const FreeSpaceOverlayOptions& options);

/// What is known of one place of the map.
struct Voxel {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the smallest cell
    double leaf_size_m = 0.0;                          // of the leaf around it
    planning::CellState state = planning::CellState::Unknown;
    double clearance_m = 0.0;  // at the least; free cells only
    int component = -1;        // room; -1: the camera does not fit there
};

/// The first cell along the ray of an image position that these options show.
[[nodiscard]] std::optional<Voxel> voxelAt(const planning::FreeSpace& free_space,
                                           const render::View& view, const Eigen::Vector2d& pixel,
                                           const FreeSpaceOverlayOptions& options);

}  // namespace dollytrack::ui
