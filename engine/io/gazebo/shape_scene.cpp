#include "engine/io/gazebo/shape_scene.h"

#include "engine/io/raw_scene/mesh_part_builder.h"

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
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> indices;

    void face(std::initializer_list<std::uint32_t> corners) {
        sizes.push_back(static_cast<std::uint32_t>(corners.size()));
        indices.insert(indices.end(), corners);
    }
};

constexpr std::uint32_t kSides = 48;  // of cylinders and spheres

Eigen::Vector3f pointAround(std::uint32_t side, float radius, float z) {
    const double angle = 2.0 * M_PI * side / kSides;
    return {radius * static_cast<float>(std::cos(angle)),
            radius * static_cast<float>(std::sin(angle)), z};
}

ShapeFaces cylinderFaces() {
    ShapeFaces shape;
    std::vector<std::uint32_t> bottom;
    std::vector<std::uint32_t> top;
    for (std::uint32_t i = 0; i < kSides; ++i) {
        shape.points.push_back(pointAround(i, 0.5F, -0.5F));
        shape.points.push_back(pointAround(i, 0.5F, 0.5F));
        const std::uint32_t next = (i + 1) % kSides;
        shape.face({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
        bottom.insert(bottom.begin(), 2 * i);
        top.push_back(2 * i + 1);
    }
    for (const auto& cap : {bottom, top}) {
        shape.sizes.push_back(kSides);
        shape.indices.insert(shape.indices.end(), cap.begin(), cap.end());
    }
    return shape;
}

ShapeFaces sphereFaces() {
    constexpr std::uint32_t kRings = 24;
    ShapeFaces shape;
    shape.points.emplace_back(0, 0, -0.5F);
    for (std::uint32_t ring = 1; ring < kRings; ++ring) {
        const double angle = M_PI * ring / kRings;
        for (std::uint32_t i = 0; i < kSides; ++i) {
            shape.points.push_back(pointAround(i, static_cast<float>(0.5 * std::sin(angle)),
                                               static_cast<float>(-0.5 * std::cos(angle))));
        }
    }
    shape.points.emplace_back(0, 0, 0.5F);
    const auto at = [](std::uint32_t ring, std::uint32_t i) {
        return 1 + (ring - 1) * kSides + i % kSides;
    };
    const auto last = static_cast<std::uint32_t>(shape.points.size() - 1);
    for (std::uint32_t i = 0; i < kSides; ++i) {
        shape.face({0, at(1, i + 1), at(1, i)});
        shape.face({last, at(kRings - 1, i), at(kRings - 1, i + 1)});
        for (std::uint32_t ring = 1; ring + 1 < kRings; ++ring) {
            shape.face({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)});
        }
    }
    return shape;
}

ShapeFaces boxFaces() {
    ShapeFaces shape;
    for (const float z : {-0.5F, 0.5F}) {
        shape.points.emplace_back(-0.5F, -0.5F, z);
        shape.points.emplace_back(0.5F, -0.5F, z);
        shape.points.emplace_back(0.5F, 0.5F, z);
        shape.points.emplace_back(-0.5F, 0.5F, z);
    }
    shape.face({3, 2, 1, 0});
    shape.face({4, 5, 6, 7});
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        shape.face({i, next, next + 4, i + 4});
    }
    return shape;
}

ShapeFaces planeFaces() {
    ShapeFaces shape;
    shape.points = {{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}};
    shape.face({0, 1, 2, 3});
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
    buildMeshPart({shape.points, {}, {}, shape.sizes, shape.indices}, Eigen::Affine3d::Identity(),
                  part);
    scene.parts.push_back(std::move(part));
    return scene;
}

}  // namespace dollytrack::gazebo
