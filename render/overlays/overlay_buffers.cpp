#include "render/overlays/overlay_buffers.h"

#include "render/overlays/box_faces.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace dollytrack::render {
namespace {

using Rgba8 = std::array<std::uint8_t, 4>;

Rgba8 toBytes(const Eigen::Vector4f& rgba) {
    Rgba8 bytes;
    for (unsigned i = 0; i < 4; ++i) {
        bytes[i] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(rgba[i], 0.0F, 1.0F)));
    }
    return bytes;
}

struct SurfaceVertex {
    Eigen::Vector3f position;
    Rgba8 rgba;
    std::array<float, 2> cell;  // integers on the edges of a face's cells
};

struct LineVertex {
    Eigen::Vector3f from;
    Eigen::Vector3f to;
    Rgba8 rgba;
    std::array<float, 4> style;
};

struct MarkVertex {
    Eigen::Vector3f at;
    Eigen::Vector3f direction;
    Rgba8 rgba;
    std::array<float, 2> style;
};

/// Six indices for every four vertices.
std::vector<std::uint32_t> quadIndices(std::size_t quads) {
    std::vector<std::uint32_t> indices;
    indices.reserve(6 * quads);
    for (std::size_t i = 0; i < quads; ++i) {
        for (const std::uint32_t corner : {0U, 1U, 3U, 0U, 3U, 2U}) {
            indices.push_back(static_cast<std::uint32_t>(4 * i) + corner);
        }
    }
    return indices;
}

/// Whether a line continues the previous one nearly straight.
bool continues(const OverlayLine& before, const OverlayLine& line) {
    if ((before.b - line.a).squaredNorm() > 1e-12 || before.width_px != line.width_px) return false;
    const Eigen::Vector3d p = before.b - before.a;
    const Eigen::Vector3d q = line.b - line.a;
    return p.dot(q) > 0.98 * p.norm() * q.norm();  // 11 degrees
}

template <class Vertex>
void fill(gl::Buffer& buffer, const std::vector<Vertex>& data) {
    glNamedBufferData(buffer.get(), static_cast<GLsizeiptr>(data.size() * sizeof(Vertex)),
                      data.data(), GL_STATIC_DRAW);
}

void setAttribute(unsigned layout, unsigned index, int count, unsigned type, bool normalized,
                  std::size_t offset) {
    glEnableVertexArrayAttrib(layout, index);
    glVertexArrayAttribFormat(layout, index, count, type, normalized ? GL_TRUE : GL_FALSE,
                              static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(layout, index, 0);
}

}  // namespace

OverlayBuffers::OverlayBuffers() {
    const std::array<std::pair<Part*, std::size_t>, 3> parts = {{
        {&surfaces_, sizeof(SurfaceVertex)},
        {&strokes_, sizeof(LineVertex)},
        {&marks_, sizeof(MarkVertex)},
    }};
    for (const auto& [part, stride] : parts) {
        part->vertices = gl::createBuffer();
        part->indices = gl::createBuffer();
        part->layout = gl::createVertexArray();
        glVertexArrayVertexBuffer(part->layout.get(), 0, part->vertices.get(), 0,
                                  static_cast<GLsizei>(stride));
        glVertexArrayElementBuffer(part->layout.get(), part->indices.get());
    }
    const unsigned surfaces = surfaces_.layout.get();
    setAttribute(surfaces, 0, 3, GL_FLOAT, false, offsetof(SurfaceVertex, position));
    setAttribute(surfaces, 1, 4, GL_UNSIGNED_BYTE, true, offsetof(SurfaceVertex, rgba));
    setAttribute(surfaces, 2, 2, GL_FLOAT, false, offsetof(SurfaceVertex, cell));
    const unsigned lines = strokes_.layout.get();
    setAttribute(lines, 0, 3, GL_FLOAT, false, offsetof(LineVertex, from));
    setAttribute(lines, 1, 3, GL_FLOAT, false, offsetof(LineVertex, to));
    setAttribute(lines, 2, 4, GL_UNSIGNED_BYTE, true, offsetof(LineVertex, rgba));
    setAttribute(lines, 3, 4, GL_FLOAT, false, offsetof(LineVertex, style));
    const unsigned marks = marks_.layout.get();
    setAttribute(marks, 0, 3, GL_FLOAT, false, offsetof(MarkVertex, at));
    setAttribute(marks, 1, 3, GL_FLOAT, false, offsetof(MarkVertex, direction));
    setAttribute(marks, 2, 4, GL_UNSIGNED_BYTE, true, offsetof(MarkVertex, rgba));
    setAttribute(marks, 3, 2, GL_FLOAT, false, offsetof(MarkVertex, style));
}

void OverlayBuffers::upload(const Overlay& overlay) {
    std::vector<SurfaceVertex> surfaces;
    for (const BoxFace& face : visibleFaces(overlay.boxes)) {
        for (unsigned corner = 0; corner < 4; ++corner) {
            surfaces.push_back({face.corners[corner],
                                face.rgba,
                                {(corner & 1U) != 0 ? static_cast<float>(face.cells[0]) : 0.0F,
                                 (corner & 2U) != 0 ? static_cast<float>(face.cells[1]) : 0.0F}});
        }
    }
    std::vector<std::uint32_t> indices = quadIndices(surfaces.size() / 4);
    box_indices_ = static_cast<int>(indices.size());
    for (const OverlayTriangle& triangle : overlay.triangles) {
        for (const Eigen::Vector3d& corner : {triangle.a, triangle.b, triangle.c}) {
            indices.push_back(static_cast<std::uint32_t>(surfaces.size()));
            surfaces.push_back({corner.cast<float>(), toBytes(triangle.rgba), {0.5F, 0.5F}});
        }
    }
    triangle_indices_ = static_cast<int>(indices.size()) - box_indices_;
    one_sided_triangles_ = overlay.one_sided_triangles;
    fill(surfaces_.vertices, surfaces);
    fill(surfaces_.indices, indices);

    std::vector<LineVertex> lines;
    lines.reserve(4 * overlay.lines.size());
    for (std::size_t i = 0; i < overlay.lines.size(); ++i) {
        const OverlayLine& line = overlay.lines[i];
        const bool from_before = i > 0 && continues(overlay.lines[i - 1], line);
        const bool on_after = i + 1 < overlay.lines.size() && continues(line, overlay.lines[i + 1]);
        const LineVertex vertex{
            line.a.cast<float>(),
            line.b.cast<float>(),
            toBytes(line.rgba),
            {static_cast<float>(line.width_px), static_cast<float>(line.dash_px),
             from_before ? 1.0F : 0.0F, on_after ? 1.0F : 0.0F}};
        lines.insert(lines.end(), 4, vertex);
    }
    fill(strokes_.vertices, lines);
    fill(strokes_.indices, quadIndices(overlay.lines.size()));
    line_count_ = static_cast<int>(overlay.lines.size());

    std::vector<MarkVertex> marks;
    marks.reserve(4 * overlay.marks.size());
    for (const OverlayMark& mark : overlay.marks) {
        const MarkVertex vertex{
            mark.at.cast<float>(),
            mark.direction.cast<float>(),
            toBytes(mark.rgba),
            {static_cast<float>(mark.size_px), static_cast<float>(static_cast<int>(mark.shape))}};
        marks.insert(marks.end(), 4, vertex);
    }
    fill(marks_.vertices, marks);
    fill(marks_.indices, quadIndices(overlay.marks.size()));
    mark_count_ = static_cast<int>(overlay.marks.size());
}

}  // namespace dollytrack::render
