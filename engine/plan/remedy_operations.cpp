#include "engine/plan/remedy_operations.h"

#include "engine/io/files/bounded_json.h"
#include "engine/plan/object_key.h"

#include <string>

namespace dollytrack {
namespace {

using nlohmann::json;

/// The operation for an assignment such as "hfov_deg=38"; the value is a number if it can be parsed
/// as one.
json setOperation(const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string value = assignment.substr(equals + 1);
    return {{"op", "set"},
            {"name", assignment.substr(0, equals)},
            {"value", parseBoundedJson(value, "").value_or(json(value))}};
}

}  // namespace

json remedyOperations(const Scene& scene, int object_id, const Remedy& remedy) {
    json operations = json::array();
    if (remedy.move_object != 0) return operations;
    for (const std::string& assignment : remedy.settings) {
        operations.push_back(setOperation(assignment));
    }
    if (!remedy.remove_no_go.empty()) {
        operations.push_back({{"op", "remove_no_go"}, {"name", remedy.remove_no_go}});
    }
    if (!remedy.unpin.empty()) operations.push_back({{"op", "unpin"}, {"point", remedy.unpin}});
    for (const std::vector<int>& ids : remedy.restore_points) {
        operations.push_back({{"op", "restore_point"}, {"objects", objectKeys(scene, ids)}});
    }
    if (remedy.pin) {
        const Eigen::Vector3d& p = remedy.pin->position;
        const Eigen::Quaterniond& q = remedy.pin->rotation;
        operations.push_back({{"op", "pin"},
                              {"objects", objectKeys(scene, {object_id})},
                              {"position", {p.x(), p.y(), p.z()}},
                              {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}});
    }
    return operations;
}

}  // namespace dollytrack
