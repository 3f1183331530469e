#include "engine/io/gazebo/shape_scene.h"

#include "engine/io/raw_scene/mesh_part_builder.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace dollytrack::gazebo {
namespace {

/// Points and faces of a shape of the size 1, centred at the origin.
struct ShapeFaces {
    std::vector<Eigen::Vector3f> points;
    std::vector<Eigen::Vector3f> uvs;  // one per point; z unused
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> indices;

    void point(const Eigen::Vector3f& position, float u, float v) {
        points.push_back(position);
        uvs.emplace_back(u, v, 0.0F);
    }

    /// A face that a texture covers once. Corners from the texture's lower left.
    void texturedQuad(const std::array<Eigen::Vector3f, 4>& corners) {
        const auto first = static_cast<std::uint32_t>(points.size());
        point(corners[0], 0, 0);
        point(corners[1], 1, 0);
        point(corners[2], 1, 1);
        point(corners[3], 0, 1);
        face({first, first + 1, first + 2, first + 3});
    }

    void face(std::initializer_list<std::uint32_t> corners) {
        sizes.push_back(static_cast<std::uint32_t>(corners.size()));
        indices.insert(indices.end(), corners);
    }
};

constexpr std::uint32_t kSides = 48;  // of cylinders and spheres

Eigen::Vector3f pointAround(std::uint32_t side, float radius, float z) {
    const double angle = 2.0 * M_PI * (side % kSides) / kSides;
    return {radius * static_cast<float>(std::cos(angle)),
            radius * static_cast<float>(std::sin(angle)), z};
}

float shareOf(std::uint32_t part, std::uint32_t whole) {
    return static_cast<float>(part) / static_cast<float>(whole);
}

/// The texture goes once around, and covers each end.
ShapeFaces cylinderFaces() {
    ShapeFaces shape;
    for (std::uint32_t i = 0; i <= kSides; ++i) {
        for (const float z : {-0.5F, 0.5F}) {
            shape.point(pointAround(i, 0.5F, z), shareOf(i, kSides), z + 0.5F);
        }
    }
    for (std::uint32_t i = 0; i < kSides; ++i) {
        shape.face({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    }
    for (const float z : {-0.5F, 0.5F}) {
        const auto first = static_cast<std::uint32_t>(shape.points.size());
        shape.sizes.push_back(kSides);
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const Eigen::Vector3f p = pointAround(z > 0 ? i : kSides - i, 0.5F, z);
            shape.indices.push_back(first + i);
            shape.point(p, p.x() + 0.5F, p.y() + 0.5F);
        }
    }
    return shape;
}

/// The texture goes once around, from pole to pole.
ShapeFaces sphereFaces() {
    constexpr std::uint32_t kRings = 24;
    ShapeFaces shape;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        const double angle = M_PI * ring / kRings;
        for (std::uint32_t i = 0; i <= kSides; ++i) {
            const double radius = ring % kRings == 0 ? 0.0 : 0.5 * std::sin(angle);
            shape.point(pointAround(i, static_cast<float>(radius),
                                    static_cast<float>(-0.5 * std::cos(angle))),
                        shareOf(i, kSides), shareOf(ring, kRings));
        }
    }
    const auto at = [](std::uint32_t ring, std::uint32_t i) { return ring * (kSides + 1) + i; };
    for (std::uint32_t i = 0; i < kSides; ++i) {
        for (std::uint32_t ring = 0; ring < kRings; ++ring) {
            if (ring > 0) shape.face({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
            if (ring + 1 < kRings) shape.face({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
        }
    }
    return shape;
}

/// The texture covers each face, upright on the sides.
ShapeFaces boxFaces() {
    ShapeFaces shape;
    const auto corner = [](std::uint32_t i, float z) {
        return Eigen::Vector3f(i == 1 || i == 2 ? 0.5F : -0.5F, i >= 2 ? 0.5F : -0.5F, z);
    };
    shape.texturedQuad({corner(3, -0.5F), corner(2, -0.5F), corner(1, -0.5F), corner(0, -0.5F)});
    shape.texturedQuad({corner(0, 0.5F), corner(1, 0.5F), corner(2, 0.5F), corner(3, 0.5F)});
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        shape.texturedQuad(
            {corner(i, -0.5F), corner(next, -0.5F), corner(next, 0.5F), corner(i, 0.5F)});
    }
    return shape;
}

ShapeFaces planeFaces() {
    ShapeFaces shape;
    shape.texturedQuad(
        {Eigen::Vector3f(-0.5F, -0.5F, 0), {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}});
    return shape;
}

}  // namespace

RawScene shapeScene(Visual::Shape kind) {
    const ShapeFaces shape = kind == Visual::Shape::Plane      ? planeFaces()
                             : kind == Visual::Shape::Cylinder ? cylinderFaces()
                             : kind == Visual::Shape::Sphere   ? sphereFaces()
                                                               : boxFaces();
    RawScene scene;
    scene.nodes.push_back({"", -1, 0});
    scene.materials.emplace_back();
    MeshPart part;
    buildMeshPart({shape.points, {}, shape.uvs, shape.sizes, shape.indices},
                  Eigen::Affine3d::Identity(), part);
    scene.parts.push_back(std::move(part));
    return scene;
}

}  // namespace dollytrack::gazebo
