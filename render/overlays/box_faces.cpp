#include "render/overlays/box_faces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dollytrack::render {
namespace {

constexpr double kUnit = 1e-4;       // m
constexpr int kLongestRun = 60'000;  // merged cells are counted in 16 bits

using Rgba8 = std::array<std::uint8_t, 4>;

/// A face of axis-aligned boxes. `u` and `v` are the axes that follow `axis`.
struct Face {
    int axis = 0;
    int side = 1;
    std::int64_t plane = 0;
    std::int64_t u = 0, v = 0;            // low corner
    std::int64_t size_u = 0, size_v = 0;  // of one cell
    std::int64_t cells_u = 1, cells_v = 1;
    Rgba8 rgba{};

    [[nodiscard]] auto rectangle() const { return std::tie(axis, plane, u, v, size_u, size_v); }
    /// Sort key: first what mergeable faces have in common, then their position.
    [[nodiscard]] auto rowOrder() const {
        return std::tie(axis, side, plane, rgba, size_u, size_v, v, u);
    }
    [[nodiscard]] auto columnOrder() const {
        return std::tie(axis, side, plane, rgba, size_u, size_v, cells_u, u, v);
    }
};

/// Tops are light and bottoms dark, so that the shape is readable without lighting.
Rgba8 shaded(const Eigen::Vector4f& rgba, int axis, int side) {
    const float shade = axis == 2 ? (side > 0 ? 1.0F : 0.62F) : axis == 1 ? 0.84F : 0.74F;
    Rgba8 bytes;
    for (unsigned i = 0; i < 4; ++i) {
        const float value = std::clamp(rgba[i], 0.0F, 1.0F) * (i < 3 ? shade : 1.0F);
        bytes[i] = static_cast<std::uint8_t>(std::lround(255.0F * value));
    }
    return bytes;
}

std::int64_t units(double metres) {
    return std::llround(metres / kUnit);
}

void addFaces(const OverlayBox& box, std::vector<Face>& faces) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const int side : {-1, 1}) {
            Face face;
            face.axis = axis;
            face.side = side;
            face.plane = units(box.center[axis] + side * box.half_size[axis]);
            face.u = units(box.center[u] - box.half_size[u]);
            face.v = units(box.center[v] - box.half_size[v]);
            face.size_u = units(box.center[u] + box.half_size[u]) - face.u;
            face.size_v = units(box.center[v] + box.half_size[v]) - face.v;
            face.rgba = shaded(box.rgba, axis, side);
            faces.push_back(face);
        }
    }
}

void dropShared(std::vector<Face>& faces) {
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
        return std::tuple_cat(a.rectangle(), std::tie(a.side, a.rgba)) <
               std::tuple_cat(b.rectangle(), std::tie(b.side, b.rgba));
    });
    std::vector<Face> single;
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i + 1;
        while (end < faces.size() && faces[end].rectangle() == faces[i].rectangle()) ++end;
        // Duplicates of a box at the same position are not neighbours.
        if (faces[i].side == faces[end - 1].side) single.push_back(faces[i]);
        i = end;
    }
    faces = std::move(single);
}

/// Merges neighbours into rows, then equal rows into rectangles.
void join(std::vector<Face>& faces) {
    std::sort(faces.begin(), faces.end(),
              [](const Face& a, const Face& b) { return a.rowOrder() < b.rowOrder(); });
    std::vector<Face> rows;
    for (const Face& face : faces) {
        if (!rows.empty()) {
            Face& row = rows.back();
            const bool next =
                std::tie(row.axis, row.side, row.plane, row.rgba, row.size_u, row.size_v, row.v) ==
                    std::tie(face.axis, face.side, face.plane, face.rgba, face.size_u, face.size_v,
                             face.v) &&
                row.u + row.cells_u * row.size_u == face.u;
            if (next && row.cells_u < kLongestRun) {
                ++row.cells_u;
                continue;
            }
        }
        rows.push_back(face);
    }
    std::sort(rows.begin(), rows.end(),
              [](const Face& a, const Face& b) { return a.columnOrder() < b.columnOrder(); });
    faces.clear();
    for (const Face& row : rows) {
        if (!faces.empty()) {
            Face& last = faces.back();
            const bool next = std::tie(last.axis, last.side, last.plane, last.rgba, last.size_u,
                                       last.size_v, last.cells_u, last.u) ==
                                  std::tie(row.axis, row.side, row.plane, row.rgba, row.size_u,
                                           row.size_v, row.cells_u, row.u) &&
                              last.v + last.cells_v * last.size_v == row.v;
            if (next && last.cells_v < kLongestRun) {
                ++last.cells_v;
                continue;
            }
        }
        faces.push_back(row);
    }
}

/// Seen from outside, u is reversed on the low side.
BoxFace cornersOf(const Face& face) {
    BoxFace result;
    const std::int64_t u1 = face.u + face.cells_u * face.size_u;
    const std::int64_t v1 = face.v + face.cells_v * face.size_v;
    for (unsigned corner = 0; corner < 4; ++corner) {
        const bool high_u = ((corner & 1U) != 0) == (face.side > 0);
        Eigen::Vector3f& p = result.corners[corner];
        const auto metres = [](std::int64_t at) { return static_cast<float>(kUnit * at); };
        p[face.axis] = metres(face.plane);
        p[(face.axis + 1) % 3] = metres(high_u ? u1 : face.u);
        p[(face.axis + 2) % 3] = metres((corner & 2U) != 0 ? v1 : face.v);
    }
    result.cells = {static_cast<std::uint16_t>(face.cells_u),
                    static_cast<std::uint16_t>(face.cells_v)};
    result.rgba = face.rgba;
    return result;
}

}  // namespace

std::vector<BoxFace> visibleFaces(const std::vector<OverlayBox>& boxes) {
    std::vector<Face> square;
    std::vector<BoxFace> result;
    for (const OverlayBox& box : boxes) {
        if (box.yaw == 0.0) {
            addFaces(box, square);
            continue;
        }
        OverlayBox upright = box;
        upright.center.setZero();
        std::vector<Face> faces;
        addFaces(upright, faces);
        const Eigen::AngleAxisf turn(static_cast<float>(box.yaw), Eigen::Vector3f::UnitZ());
        for (const Face& face : faces) {
            result.push_back(cornersOf(face));
            for (Eigen::Vector3f& corner : result.back().corners) {
                corner = turn * corner + box.center.cast<float>();
            }
        }
    }
    dropShared(square);
    join(square);
    for (const Face& face : square) result.push_back(cornersOf(face));
    return result;
}

}  // namespace dollytrack::render
