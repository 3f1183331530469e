#pragma once

#include "render/dataset/contents/frame_context.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Tracks are made for clips of this many consecutive frames; the last clip may be shorter.
inline constexpr int kClipFrames = 300;

/// Surface points followed through the frames of a clip, as in TAP-Vid (Doersch et al. 2022).
/// Values with an entry per frame are ordered by track, then by frame.
struct PointTracks {
    int frames = 0;  // in the clip

    /// By track: frame of the clip, column and row of the pixel at whose centre the point was
    /// chosen, where it is visible.
    std::vector<Eigen::Vector3i> queries;
    std::vector<std::uint16_t> object_ids;

    std::vector<Eigen::Vector2f> points;     // px, right and down; (-1, -1) if nearer than near_m
    std::vector<Eigen::Vector3f> positions;  // world, m; move with the object
    std::vector<std::uint8_t> occluded;      // 1: hidden by a surface, or outside the image
};

/// Tracks of the clip that begins at a frame of the dataset. The points are chosen at random, the
/// same number in each frame and uniformly in its image: 10,000, or one for every 30 pixels of an
/// image if that is less. Frames that show nothing contribute none.
[[nodiscard]] PointTracks trackPoints(const FrameContext& context, int first_frame);

}  // namespace dollytrack::render
