#include "engine/plan/ledger_json.h"

#include "engine/plan/remedy_operations.h"
#include "engine/scene/labels.h"

#include <nlohmann/json.hpp>

namespace dollytrack {
namespace {

using nlohmann::json;

json remedyJson(const Scene& scene, int object_id, const Remedy& remedy) {
    json result = {{"text", remedy.text}, {"well", remedy.well}};
    if (!remedy.settings.empty()) result["set"] = remedy.settings;
    if (remedy.pin) {
        const Eigen::Vector3d& p = remedy.pin->position;
        const Eigen::Quaterniond& q = remedy.pin->rotation;
        result["pin"] = {{"position", {p.x(), p.y(), p.z()}},
                         {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
    }
    if (!remedy.remove_no_go.empty()) result["remove_no_go"] = remedy.remove_no_go;
    if (!remedy.unpin.empty()) result["unpin"] = remedy.unpin;
    if (!remedy.restore_points.empty()) result["restore_point"] = true;
    if (remedy.move_object != 0) result["move"] = scene.object(remedy.move_object).name;
    json operations = remedyOperations(scene, object_id, remedy);
    if (!operations.empty()) result["operations"] = std::move(operations);
    return result;
}

}  // namespace

json ledgerJson(const Scene& scene, const std::vector<LedgerRow>& ledger) {
    json rows = json::array();
    for (const LedgerRow& row : ledger) {
        const Object& object = scene.object(row.object_id);
        json one = {{"object", object.name},
                    {"id", row.object_id},
                    {"class", nyu40Name(object.nyu40)},
                    {"captured", row.captured},
                    {"well_captured", row.well_captured}};
        if (object.dataset_class) one["dataset_class"] = object.dataset_class->name;
        if (row.frame >= 0) {
            one.update({{"frame", row.frame},
                        {"time_s", row.time_s},
                        {"key_frame", row.key_frame},
                        {"visible_fraction", row.visible_fraction},
                        {"box_share", row.box_share},
                        {"mask_share", row.mask_share},
                        {"distance_m", row.distance_m}});
        }
        if (row.loss) {
            one["loss"] = name(*row.loss);
            one["reason"] = row.reason;
        }
        if (row.occluder != 0) one["occluder"] = scene.object(row.occluder).name;
        if (row.remedy) one["remedy"] = remedyJson(scene, row.object_id, *row.remedy);
        rows.push_back(std::move(one));
    }
    return rows;
}

json uncapturedJson(const Scene& scene, const std::vector<LedgerRow>& ledger) {
    json rows = json::array();
    for (const LedgerRow& row : ledger) {
        if (row.captured) continue;
        rows.push_back({{"object", scene.object(row.object_id).name},
                        {"id", row.object_id},
                        {"reason", row.reason}});
    }
    return rows;
}

}  // namespace dollytrack
