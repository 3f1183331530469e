#include "engine/document/remedy_operations.h"

#include <algorithm>
#include <string>

namespace dollytrack {
namespace {

using nlohmann::json;

/// Its name; its number where that would not do.
json keyOf(const Scene& scene, int id) {
    const std::string& name = scene.object(id).name;
    if (name.empty() || std::ranges::count(scene.objects, name, &Object::name) != 1) return id;
    return name;
}

/// "hfov_deg=38": a number where it is one.
json setOperation(const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string value = assignment.substr(equals + 1);
    json read = json::parse(value, nullptr, false);
    if (read.is_discarded()) read = value;
    return {{"op", "set"}, {"name", assignment.substr(0, equals)}, {"value", std::move(read)}};
}

}  // namespace

json remedyOperations(const Scene& scene, int object_id, const Remedy& remedy) {
    json operations = json::array();
    if (remedy.move_object != 0) return operations;
    const json key = keyOf(scene, object_id);
    for (const std::string& assignment : remedy.settings) {
        operations.push_back(setOperation(assignment));
    }
    if (!remedy.remove_no_go.empty()) {
        operations.push_back({{"op", "remove_no_go"}, {"name", remedy.remove_no_go}});
    }
    if (!remedy.unpin.empty()) operations.push_back({{"op", "unpin"}, {"point", remedy.unpin}});
    for (const std::vector<int>& ids : remedy.restore_points) {
        json keys = json::array();
        for (const int id : ids) keys.push_back(keyOf(scene, id));
        operations.push_back({{"op", "restore_point"}, {"objects", std::move(keys)}});
    }
    if (remedy.pin) {
        const Eigen::Vector3d& p = remedy.pin->position;
        const Eigen::Quaterniond& q = remedy.pin->rotation;
        operations.push_back({{"op", "pin"},
                              {"objects", json::array({key})},
                              {"position", {p.x(), p.y(), p.z()}},
                              {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}});
    }
    return operations;
}

}  // namespace dollytrack
