#pragma once

#include "planning/free_space/free_space.h"
#include "render/view/view.h"
#include "ui/overlays/legend.h"
#include "ui/overlays/slice.h"

#include <optional>

namespace dollytrack::ui {

/// The value that colours free cells. Component: the connected component of the space that the
/// camera fits into (a room, if doors are shut). Level: the octree level, thus the cell size.
enum class CellColor { State, Clearance, Component, Level };

struct FreeSpaceOverlayOptions {
    bool free = true;
    bool occupied = true;
    bool unknown = true;  // drawn only in a slice, because there is too much of it
    int min_level = 0;  // lowest drawn octree level; 0: the smallest cells, each level doubles them
    int max_level = 16;
    std::optional<Slice> slice;  // unset: the whole map
    CellColor color = CellColor::State;
    float opacity = 0.5F;
    bool operator==(const FreeSpaceOverlayOptions&) const = default;
};

/// The octree's leaves as boxes, clipped to the slice if one is set. When coloured by clearance,
/// free leaves in a slice are subdivided into boxes of at most four cells per side, because
/// clearance varies inside a leaf. Unknown space is not stored in the octree; it is drawn as the
/// largest unknown cubes within the slice.
[[nodiscard]] PlanLayer freeSpaceLayer(const planning::FreeSpace& free_space,
                                       const FreeSpaceOverlayOptions& options);

/// One cell of the map.
struct Voxel {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // centre of the smallest cell, m, world
    double leaf_size_m = 0.0;                          // edge of the octree leaf that contains it
    planning::CellState state = planning::CellState::Unknown;
    double clearance_m = 0.0;  // lower bound; free cells only
    int component = -1;        // connected component (room); -1: too narrow for the camera
};

/// The first cell along the ray through an image position (px) that these options display; nullopt
/// if the ray meets none.
[[nodiscard]] std::optional<Voxel> voxelAt(const planning::FreeSpace& free_space,
                                           const render::View& view, const Eigen::Vector2d& pixel,
                                           const FreeSpaceOverlayOptions& options);

}  // namespace dollytrack::ui
