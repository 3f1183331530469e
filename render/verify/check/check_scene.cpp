#include "engine/scene/scene_report.h"
#include "render/scene/scene_hash.h"
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::verify {
namespace {

/// Difference between a stored object and the scene's; empty if they agree.
std::string difference(const StoredObject& stored, const Object& object) {
    if (stored.name != object.name) return "its name is " + stored.name;
    if (stored.nyu40 != object.nyu40) return fmt::format("its class is {}", stored.nyu40);
    if (stored.role != roleName(object.role)) return "its role is " + stored.role;
    const double apart = (stored.box.center - object.box.center).norm() +
                         (stored.box.half_size - object.box.half_size).norm() +
                         std::abs(stored.box.yaw - object.box.yaw);
    if (apart > 1e-6) return fmt::format("its box is off by {:.3g}", apart);
    return {};
}

}  // namespace

CheckWork beginScene(const Subject& subject, Findings& findings) {
    const Scene& scene = *subject.scene;
    const StoredDataset& dataset = subject.dataset;
    const auto add = [&](std::string found, std::string expected) {
        findings.add({"dataset.json", {}, {}, std::move(found), std::move(expected)});
    };
    const std::string said = dataset.card.at("scene").value("geometry_sha256", "");
    const std::string is = render::geometryHash(scene);
    if (said != is) add("scene.geometry_sha256 is " + said, is);
    const auto rows = dataset.card.at("scene").at("source_from_world");
    const Eigen::Matrix4d frame = scene.source_from_world.matrix();
    const double tolerance = 1e-6 * frame.cwiseAbs().maxCoeff();
    for (int i = 0; i < 16; ++i) {
        const double stored = rows.at(i / 4).at(i % 4).get<double>();
        if (std::abs(stored - frame(i / 4, i % 4)) <= tolerance) continue;
        add(fmt::format("scene.source_from_world[{}][{}] is {:.9g}", i / 4, i % 4, stored),
            fmt::format("{:.9g}", frame(i / 4, i % 4)));
    }
    if (dataset.objects.size() != scene.objects.size()) {
        add(fmt::format("{} objects", dataset.objects.size()),
            fmt::format("{}", scene.objects.size()));
        return {};
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const std::string found = difference(dataset.objects[i], scene.objects[i]);
        if (found.empty()) continue;
        add(fmt::format("objects[{}]: {}", i, found),
            fmt::format("the scene's object {} ({})", i + 1, scene.objects[i].name));
    }
    return {};
}

}  // namespace dollytrack::verify
