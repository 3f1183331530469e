#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::test {

SceneBuilder& SceneBuilder::object(const std::string& name, const Look& look) {
    Part part;
    part.name = name;
    part.look = look;
    parts_.push_back(std::move(part));
    return *this;
}

SceneBuilder& SceneBuilder::quad(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                                 const Eigen::Vector3d& edge_v) {
    Part& part = parts_.back();
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    const Eigen::Vector3f normal = edge_u.cross(edge_v).normalized().cast<float>();
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        part.positions.emplace_back((corner + u * edge_u + v * edge_v).cast<float>());
        part.normals.push_back(normal);
        part.uvs.emplace_back(u, v);
    }
    part.triangles.push_back({first, first + 1, first + 2});
    part.triangles.push_back({first, first + 2, first + 3});
    return *this;
}

SceneBuilder& SceneBuilder::box(const Eigen::Vector3d& center, const Eigen::Vector3d& size,
                                double yaw) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d x = turn.col(0) * size.x();
    const Eigen::Vector3d y = turn.col(1) * size.y();
    const Eigen::Vector3d z = turn.col(2) * size.z();
    const Eigen::Vector3d low = center - 0.5 * (x + y + z);
    const Eigen::Vector3d high = center + 0.5 * (x + y + z);
    quad(low, y, x).quad(low, x, z).quad(low, z, y);
    quad(high, -x, -y).quad(high, -z, -x).quad(high, -y, -z);
    parts_.back().yaw = yaw;
    return *this;
}

SceneBuilder& SceneBuilder::room(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                                 bool with_ceiling) {
    const Eigen::Vector3d x(high.x() - low.x(), 0, 0);
    const Eigen::Vector3d y(0, high.y() - low.y(), 0);
    const Eigen::Vector3d z(0, 0, high.z() - low.z());
    const auto look = [](int nyu40, float grey) {
        return Look{nyu40, Role::Structure, {grey, grey, grey}};
    };
    object("floor", look(kNyuFloor, 0.5F)).quad(low, x, y);
    if (with_ceiling) object("ceiling", look(kNyuCeiling, 0.9F)).quad(low + z, y, x);
    object("wall_south", look(kNyuWall, 0.8F)).quad(low, z, x);
    object("wall_north", look(kNyuWall, 0.8F)).quad(low + y, x, z);
    object("wall_west", look(kNyuWall, 0.8F)).quad(low, y, z);
    object("wall_east", look(kNyuWall, 0.8F)).quad(low + x, z, y);
    return *this;
}

Scene SceneBuilder::build() const {
    Scene scene;
    scene.name = "test scene";
    for (const Part& part : parts_) {
        Object object;
        object.id = static_cast<int>(scene.objects.size()) + 1;
        object.name = part.name;
        object.nyu40 = part.look.nyu40;
        object.role = part.look.role;
        object.structure = part.look.role == Role::Structure;
        object.first_vertex = static_cast<std::uint32_t>(scene.positions.size());
        object.vertex_count = static_cast<std::uint32_t>(part.positions.size());
        object.first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
        object.triangle_count = static_cast<std::uint32_t>(part.triangles.size());

        const Eigen::Matrix3d unturn =
            Eigen::AngleAxisd(-part.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        Eigen::AlignedBox3d turned;
        for (const Eigen::Vector3f& p : part.positions) turned.extend(unturn * p.cast<double>());
        object.box.yaw = part.yaw;
        object.box.center = unturn.transpose() * turned.center();
        object.box.half_size = 0.5 * turned.sizes();
        object.centroid = object.box.center;
        object.large = object.box.volume() >= 0.1;

        const auto material = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.push_back({part.name, part.look.color});
        for (Triangle triangle : part.triangles) {
            for (std::uint32_t& index : triangle) index += object.first_vertex;
            scene.triangles.push_back(triangle);
            scene.triangle_material.push_back(material);
        }
        scene.positions.insert(scene.positions.end(), part.positions.begin(), part.positions.end());
        scene.normals.insert(scene.normals.end(), part.normals.begin(), part.normals.end());
        scene.uvs.insert(scene.uvs.end(), part.uvs.begin(), part.uvs.end());
        scene.objects.push_back(object);
    }
    for (const Eigen::Vector3f& p : scene.positions) scene.room_bounds.extend(p.cast<double>());
    return scene;
}

Scene furnishedRoom() {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("table", {7, Role::Target, {0.5F, 0.3F, 0.2F}})
        .box({3.3, 1.5, 0.72}, {0.8, 1.4, 0.04});
    for (const auto& [x, y] : {std::pair{3.0, 0.9}, {3.6, 0.9}, {3.0, 2.1}, {3.6, 2.1}}) {
        builder.box({x, y, 0.35}, {0.05, 0.05, 0.70});
    }
    builder.object("mug", {40, Role::Target, {0.8F, 0.1F, 0.1F}})
        .box({3.2, 1.3, 0.79}, {0.08, 0.08, 0.10});
    builder.object("book", {23, Role::Target, {0.1F, 0.2F, 0.8F}})
        .box({3.3, 1.7, 0.76}, {0.22, 0.16, 0.04});
    builder.object("sofa", {6, Role::Target, {0.3F, 0.5F, 0.3F}})
        .box({0.5, 1.5, 0.35}, {0.8, 1.8, 0.70});
    builder.object("picture", {11, Role::Target, {0.9F, 0.8F, 0.2F}})
        .box({1.8, 2.985, 1.5}, {0.6, 0.02, 0.4});
    return builder.build();
}

Scene twoRoomsWithDoor(double door_width_m) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {6.1, 3, 2.5});
    const double side = 0.5 * (3.0 - door_width_m);
    builder.object("wall_between", {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}})
        .box({3.05, 0.5 * side, 1.25}, {0.1, side, 2.5})
        .box({3.05, 3.0 - 0.5 * side, 1.25}, {0.1, side, 2.5})
        .box({3.05, 1.5, 2.25}, {0.1, door_width_m, 0.5});
    builder.object("west_box", {29, Role::Target, {0.7F, 0.2F, 0.2F}})
        .box({1.0, 0.6, 0.25}, {0.5, 0.5, 0.5});
    builder.object("east_box", {29, Role::Target, {0.2F, 0.2F, 0.7F}})
        .box({5.2, 2.4, 0.25}, {0.5, 0.5, 0.5});
    return builder.build();
}

}  // namespace dollytrack::test
