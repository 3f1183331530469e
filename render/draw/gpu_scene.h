#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/gl/handle.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// How a material is drawn.
enum class Surface {
    Opaque,
    CutOut,  // the texture has holes: leaves, lace
    Glass,   // seen through in the picture, opaque in the labels
};

/// Triangles of one object that share one texture.
struct Piece {
    int object_id = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    // Of View::coarse; as above where the scene was uploaded without.
    std::uint32_t coarse_first = 0;
    std::uint32_t coarse_count = 0;
};

/// What a material's maps add to its numbers; OpenGL names, 0: none.
struct BatchMaps {
    unsigned normal = 0;
    unsigned roughness = 0;
    unsigned metallic = 0;
    unsigned emission = 0;
    float normal_scale = 1.0F;
    Eigen::Vector3f emission_factor = Eigen::Vector3f::Zero();
};

/// Pieces that are drawn with the same state.
struct Batch {
    Surface surface = Surface::Opaque;
    unsigned texture = 0;           // OpenGL name, 0: none
    std::optional<BatchMaps> maps;  // of the colour picture, not of labels and surfaces
    std::vector<Piece> pieces;
};

/// Neighbouring triangles of glass in one plane, which are drawn together.
struct GlassSheet {
    std::size_t batch = 0;
    int object_id = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    Eigen::AlignedBox3f bounds;
};

/// A scene's triangles and textures in graphics memory, in one vertex and one index buffer.
/// Untextured materials travel in the vertices, so that all of them are one batch.
struct GpuScene {
    gl::Buffer vertices;
    gl::Buffer indices;
    gl::VertexArray layout;            // all attributes
    gl::VertexArray positions_layout;  // attribute 0 alone
    std::vector<gl::Texture> textures;
    std::vector<Batch> batches;                 // in drawing order
    bool has_maps = false;                      // whether any of them has
    std::vector<Piece> whole_objects;           // by id - 1: every triangle of the object
    std::vector<Eigen::AlignedBox3f> bounds;    // by id - 1, of the triangles themselves
    std::vector<std::uint32_t> first_vertices;  // by id - 1, and one past the last of all
    std::vector<GlassSheet> glass;              // in drawing order
    std::vector<std::uint32_t> glass_corners;   // of all sheets, from the first one's on
    std::vector<bool> windows;        // by id - 1, whose panes take nothing of the sun's light
    std::vector<bool> whole_windows;  // by id - 1, see wholeWindows()
};

/// An object as uploadScene() put it there, to be placed elsewhere from.
struct RestingObject {
    int object_id = 0;
    std::vector<std::uint8_t> vertices;  // as in the buffer
    Eigen::AlignedBox3f bounds;
};
[[nodiscard]] RestingObject copyOf(const GpuScene& scene, int object_id);

/// Draws the object elsewhere from now on: p = motion * p at rest, world.
void place(GpuScene& scene, const RestingObject& object, const Eigen::Isometry3d& motion);

/// How many places along its slant textures are looked up in, 1 to 16; 0: as many as the driver
/// does without much cost.
void setAnisotropy(const GpuScene& scene, int places);

/// Whether a texture cuts its surface out: more than 1 % of it are holes. Compressed pictures often
/// hold a few by accident.
[[nodiscard]] bool hasHoles(const Texture& texture);

/// Whether a scene is uploaded with what View::coarse shows.
enum class Detail { Full, FullAndCoarse };

/// Uploads the scene. BadInput for more than 65535 objects, which 16-bit labels cannot tell apart.
[[nodiscard]] Result<GpuScene> uploadScene(const Scene& scene, Detail detail = Detail::Full);

}  // namespace dollytrack::render
