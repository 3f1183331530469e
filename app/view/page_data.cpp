#include "app/view/page_data.h"

#include "engine/core/clean_text.h"
#include "render/pictures/small_picture.h"
#include "render/verify/read/number_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace dollytrack::view {
namespace {

using Json = nlohmann::ordered_json;

/// A rounded number, to keep the page small.
double rounded(double value, double steps) {
    return std::isfinite(value) ? std::round(value * steps) / steps + 0.0 : 0.0;
}

Json vectorJson(const Eigen::Vector3d& v) {
    return Json::array({rounded(v.x(), 1e4), rounded(v.y(), 1e4), rounded(v.z(), 1e4)});
}

Json rotationJson(const Eigen::Quaterniond& q) {
    return Json::array(
        {rounded(q.x(), 1e5), rounded(q.y(), 1e5), rounded(q.z(), 1e5), rounded(q.w(), 1e5)});
}

/// The rows of a list in dataset.json by object id; empty if the list is missing.
std::map<int, Json> rowsByObject(const Json& card, const char* place, const char* key) {
    std::map<int, Json> rows;
    const Json::json_pointer list(place);
    if (!card.contains(list) || !card.at(list).is_array()) return rows;
    for (const Json& row : card.at(list)) {
        if (row.is_object() && row.contains(key) && row[key].is_number_integer()) {
            rows[row[key].get<int>()] = row;
        }
    }
    return rows;
}

std::map<int, Json> plannedRows(const verify::StoredDataset& dataset) {
    return rowsByObject(dataset.card, "/metrics/planned/ledger", "id");
}

/// The best frame of a row of counted captures; -1 if no frame shows the object.
int bestFrameOf(const Json& counted, std::size_t frames) {
    if (!counted.contains("best_frame") || !counted["best_frame"].is_number_integer()) return -1;
    const auto frame = counted["best_frame"].get<std::int64_t>();
    return frame < 0 || frame >= static_cast<std::int64_t>(frames) ? -1 : static_cast<int>(frame);
}

std::string classNameOf(const verify::StoredDataset& dataset, const verify::StoredObject& object) {
    const DatasetClass* found = dataset.classes().find(object.class_id);
    return found == nullptr ? "none" : cleanText(found->name);
}

void addCounted(Json& row, const Json& counted, std::size_t frames) {
    row["best_frame"] = bestFrameOf(counted, frames);
    for (const char* name : {"captured", "well_captured"}) {
        row[name] =
            counted.contains(name) && counted[name].is_boolean() && counted[name].get<bool>();
    }
    for (const char* name : {"visible_fraction", "box_share", "mask_share"}) {
        if (!counted.contains(name) || !counted[name].is_number()) continue;
        row[name] = rounded(counted[name].get<double>(), 1e6);
    }
}

/// Adds the reason why an object is not (well) captured, and the remedy.
void addPlanned(Json& row, const Json& planned) {
    const auto text = [&](const Json& from, const char* key, const char* name) {
        if (from.is_object() && from.contains(key) && from[key].is_string()) {
            row[name] = cleanText(from[key].get<std::string>());
        }
    };
    text(planned, "reason", "reason");
    if (planned.contains("remedy")) text(planned["remedy"], "text", "remedy");
}

Json objectsJson(const verify::StoredDataset& dataset) {
    const std::map<int, Json> counted = countedRows(dataset);
    const std::map<int, Json> planned = plannedRows(dataset);
    Json list = Json::array();
    for (const verify::StoredObject& object : dataset.objects) {
        Json row = {{"id", object.id},
                    {"name", cleanText(object.name)},
                    {"class", classNameOf(dataset, object)},
                    {"role", cleanText(object.role)},
                    {"color", render::shownIdColor(object.id)},
                    {"center", vectorJson(object.box.center)},
                    {"size", vectorJson(2.0 * object.box.half_size)},
                    {"yaw_rad", rounded(object.box.yaw, 1e5)}};
        if (const auto at = counted.find(object.id); at != counted.end()) {
            addCounted(row, at->second, dataset.frames.size());
        }
        if (const auto at = planned.find(object.id); at != planned.end()) {
            addPlanned(row, at->second);
        }
        list.push_back(std::move(row));
    }
    return list;
}

int componentOf(const verify::StoredDataset& dataset, std::size_t frame) {
    const Json& row = dataset.card.at("frames").at(frame);
    return row.contains("component") && row["component"].is_number_integer()
               ? row["component"].get<int>()
               : 0;
}

/// Path numbers of the frames, from frames.csv; empty if the dataset lacks it.
std::vector<double> pathsOf(const verify::StoredDataset& dataset) {
    std::vector<double> paths;
    if (!dataset.has("frames")) return paths;
    const auto table = verify::NumberTable::read(dataset.folder / "frames.csv");
    if (!table || table->rows() != dataset.frames.size()) return paths;
    for (std::size_t i = 0; i < table->rows(); ++i) {
        paths.push_back(table->number(i, "path").value_or(0.0));
    }
    return paths;
}

/// The frames as [time, position, rotation, whether a path begins here].
Json framesJson(const verify::StoredDataset& dataset) {
    const std::vector<double> paths = pathsOf(dataset);
    Json list = Json::array();
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
        const verify::StoredFrame& frame = dataset.frames[i];
        const bool begins = i == 0 || componentOf(dataset, i) != componentOf(dataset, i - 1) ||
                            (!paths.empty() && paths[i] != paths[i - 1]);
        list.push_back(Json::array({rounded(frame.time_s, 1e4), vectorJson(frame.pose.position),
                                    rotationJson(frame.pose.rotation), begins ? 1 : 0}));
    }
    return list;
}

/// [position, rotation] in each frame, by moving object.
Json motionsJson(const verify::StoredDataset& dataset) {
    std::map<int, std::vector<const Eigen::Isometry3d*>> moving;  // by object; null: at rest
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
        for (const verify::MovedObject& one : dataset.frames[i].moving) {
            auto& motion = moving[one.object_id];
            motion.resize(dataset.frames.size());
            if (motion[i] == nullptr) motion[i] = &one.now_from_rest;
        }
    }
    Json motions = Json::object();
    for (const auto& [id, motion] : moving) {
        Json list = Json::array();
        for (const Eigen::Isometry3d* moved : motion) {
            const Eigen::Isometry3d now = moved ? *moved : Eigen::Isometry3d::Identity();
            list.push_back(Json::array(
                {vectorJson(now.translation()), rotationJson(Eigen::Quaterniond(now.rotation()))}));
        }
        // Operator [] of an ordered object would compare the id with all previous keys.
        motions.get_ref<Json::object_t&>().emplace_back(std::to_string(id), std::move(list));
    }
    return motions;
}

/// The names of the rig's cameras.
Json rigNames(const Json& card) {
    Json names = Json::array();
    if (!card.contains("cameras") || !card["cameras"].is_array()) return names;
    for (const Json& camera : card["cameras"]) {
        if (camera.is_object() && camera.contains("name") && camera["name"].is_string()) {
            names.push_back(cleanText(camera["name"].get<std::string>()));
        }
    }
    return names;
}

std::string sceneName(const Json& card) {
    const Json::json_pointer file("/scene/file");
    return card.contains(file) && card.at(file).is_string()
               ? cleanText(card.at(file).get<std::string>())
               : std::string();
}

}  // namespace

std::map<int, Json> countedRows(const verify::StoredDataset& dataset) {
    return rowsByObject(dataset.card, "/metrics/counted/per_object", "object_id");
}

std::vector<int> bestFrames(const verify::StoredDataset& dataset) {
    std::set<int> frames;
    for (const auto& [id, row] : countedRows(dataset)) {
        const int frame = bestFrameOf(row, dataset.frames.size());
        if (frame >= 0) frames.insert(frame);
    }
    return {frames.begin(), frames.end()};
}

std::size_t leastDataBytes(const verify::StoredDataset& dataset) {
    // Lower bounds of the size of rows; a number takes at least three bytes, as in "0.0".
    constexpr std::size_t kObject = 110;
    constexpr std::size_t kFrame = 38;
    constexpr std::size_t kMotion = 32;
    std::set<int> moving;
    for (const verify::StoredFrame& frame : dataset.frames) {
        for (const verify::MovedObject& one : frame.moving) moving.insert(one.object_id);
    }
    return kObject * dataset.objects.size() +
           dataset.frames.size() * (kFrame + kMotion * moving.size());
}

Json pageData(const verify::StoredDataset& dataset) {
    std::error_code error;
    const auto path = std::filesystem::absolute(dataset.folder / "", error).lexically_normal();
    const Intrinsics& lens = dataset.lens;
    return {{"name", cleanText(path.parent_path().filename().string())},
            {"scene", sceneName(dataset.card)},
            {"lens",
             {{"width", lens.width},
              {"height", lens.height},
              {"fx", lens.fx},
              {"fy", lens.fy},
              {"cx", lens.cx},
              {"cy", lens.cy}}},
            {"cameras", rigNames(dataset.card)},
            {"unusable", dataset.unusable_frames},
            {"objects", objectsJson(dataset)},
            {"frames", framesJson(dataset)},
            {"motions", motionsJson(dataset)}};
}

Json roomData(const Scene& scene, const ViewMesh& mesh, const std::vector<PageStorey>& storeys) {
    Json parts = Json::array();
    for (const ViewMesh::Part& part : mesh.parts) {
        const bool structure = scene.object(part.object_id).structure;
        parts.push_back(
            Json::array({part.object_id, part.first_corner, part.corner_count, structure ? 1 : 0}));
    }
    Json views = Json::array();
    for (const PageStorey& storey : storeys) {
        views.push_back({{"floor", rounded(storey.heights.floor_z, 1e4)},
                         {"ceiling", rounded(storey.heights.ceiling_z, 1e4)},
                         {"hidden_from_z", rounded(storey.heights.hidden_from_z, 1e4)},
                         {"low", vectorJson(storey.box.min())},
                         {"high", vectorJson(storey.box.max())}});
    }
    return {{"origin", vectorJson(mesh.origin)},
            {"step_m", mesh.step_m},
            {"vertices", mesh.positions.size() / 3},
            {"scene_triangles", mesh.scene_triangles},
            {"parts", std::move(parts)},
            {"storeys", std::move(views)}};
}

}  // namespace dollytrack::view
