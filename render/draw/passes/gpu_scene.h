#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/gl/handle.h"
#include "render/materials/surface_kind.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// Triangles of one object that share one texture, as a range of the index buffer.
struct Piece {
    int object_id = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    // Range used by View::coarse; equals the range above if no coarse mesh was uploaded.
    std::uint32_t coarse_first = 0;
    std::uint32_t coarse_count = 0;
};

/// Texture maps of a material, as OpenGL names (0: no map), and their factors.
struct BatchMaps {
    unsigned normal = 0;
    unsigned roughness = 0;
    unsigned metallic = 0;
    unsigned emission = 0;
    float normal_scale = 1.0F;
    Eigen::Vector3f emission_factor = Eigen::Vector3f::Zero();
};

/// Pieces drawn with the same render state.
struct Batch {
    Surface surface = Surface::Opaque;
    unsigned texture = 0;           // OpenGL name, 0: none
    std::optional<BatchMaps> maps;  // used for the colour image only, not for labels and materials
    std::vector<Piece> pieces;
};

/// A group of consecutive coplanar glass triangles, drawn together.
struct GlassSheet {
    std::size_t batch = 0;
    int object_id = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    Eigen::AlignedBox3f bounds;
};

/// A scene's triangles and textures in graphics memory, in one vertex and one index buffer.
/// Vertices carry untextured materials, so that all of these form one batch.
struct GpuScene {
    gl::Buffer vertices;
    gl::Buffer indices;
    gl::VertexArray layout;            // all attributes
    gl::VertexArray positions_layout;  // attribute 0 alone
    std::vector<gl::Texture> textures;
    std::vector<Batch> batches;                 // in drawing order
    bool has_maps = false;                      // whether any batch has maps
    std::vector<Piece> whole_objects;           // by id - 1: all triangles of the object
    std::vector<Eigen::AlignedBox3f> bounds;    // by id - 1: box of the triangles, world
    std::vector<std::uint32_t> first_vertices;  // by id - 1; one more entry marks the end
    std::vector<GlassSheet> glass;              // in drawing order
    std::vector<std::uint32_t> glass_corners;   // vertex indices of all sheets, in their order
    std::vector<bool> windows;        // by id - 1: the sun shines through its panes undimmed
    std::vector<bool> whole_windows;  // by id - 1, see wholeWindows()
};

/// An object's vertices and box as uploaded, from which moved positions are computed.
struct RestingObject {
    int object_id = 0;
    std::vector<std::uint8_t> vertices;  // layout of the vertex buffer
    Eigen::AlignedBox3f bounds;
};
[[nodiscard]] RestingObject copyOf(const GpuScene& scene, int object_id);

/// Moves the object: p = motion * p_uploaded, world frame.
void place(GpuScene& scene, const RestingObject& object, const Eigen::Isometry3d& motion);

/// Sets the textures' anisotropic filtering to `samples`, 1 to 16, at most the driver's
/// maximum. 0: 8 on a graphics card, 1 on the CPU.
void setAnisotropy(const GpuScene& scene, int samples);

/// What to upload: the geometry with one colour per material, for a first image soon after loading;
/// with all textures; or also with the simplified meshes for View::coarse.
enum class Detail { Plain, Full, FullAndCoarse };

/// Uploads the scene. Returns BadInput for more than 65535 objects, the limit of 16-bit labels, and
/// Failed if the graphics memory does not suffice.
[[nodiscard]] Result<GpuScene> uploadScene(const Scene& scene, Detail detail = Detail::Full);

}  // namespace dollytrack::render
