#include "engine/io/datasets/front3d_scene.h"

#include "engine/io/files/bounded_json.h"

namespace dollytrack {
namespace {

using nlohmann::json;

/// Reads `count` finite numbers; returns the default if the key is missing and nullopt if invalid.
std::optional<Eigen::Vector4d> numbersIn(const json& object, const char* key, std::size_t count,
                                         const Eigen::Vector4d& usual) {
    if (!object.contains(key) || object[key].is_null()) return usual;
    const json::array_t& list = listIn(object, key);
    if (list.size() != count) return std::nullopt;
    Eigen::Vector4d values = usual;
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<double> value = numberIn(list[i]);
        if (!value) return std::nullopt;
        values[static_cast<Eigen::Index>(i)] = *value;
    }
    return values;
}

struct Pose {
    Eigen::Vector3d position;
    Eigen::Quaterniond turn;
    Eigen::Vector3d scale;

    [[nodiscard]] bool isIdentity() const {
        return position.isZero() && scale.isOnes() && turn.vec().isZero();
    }
};

/// Reads a placement. "rot" is x, y, z, w. Missing keys mean no movement.
std::optional<Pose> poseOf(const json& object) {
    const auto position = numbersIn(object, "pos", 3, Eigen::Vector4d::Zero());
    const auto turn = numbersIn(object, "rot", 4, Eigen::Vector4d::UnitW());
    const auto scale = numbersIn(object, "scale", 3, Eigen::Vector4d::Ones());
    if (!position || !turn || !scale || !(turn->norm() > 1e-6)) return std::nullopt;
    const Eigen::Vector4d unit = turn->normalized();
    return Pose{position->head<3>(), Eigen::Quaterniond(unit[3], unit[0], unit[1], unit[2]),
                scale->head<3>()};
}

std::optional<bool> flagIn(const json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end()) return std::nullopt;
    if (found->is_boolean()) return found->get<bool>();
    const std::string text = textIn(object, key);
    if (text == "true" || text == "True") return true;
    return numberIn(*found).value_or(0.0) != 0.0;
}

Front3dFurniture furnitureOf(const json& entry) {
    Front3dFurniture piece;
    piece.uid = textIn(entry, "uid");
    piece.jid = textIn(entry, "jid");
    piece.category = textIn(entry, "category");
    piece.title = textIn(entry, "title");
    piece.category_id = textIn(entry, "sourceCategoryId");
    piece.valid = flagIn(entry, "valid");
    piece.has_size = !listIn(entry, "size").empty() || !listIn(entry, "bbox").empty();
    return piece;
}

void readRoom(const json& room, std::size_t number, Front3dScene& scene) {
    std::string name = textIn(room, "instanceid");
    if (name.empty()) name = textIn(room, "type");
    if (name.empty()) name = "room " + std::to_string(number);
    scene.rooms.push_back(name);
    const std::optional<Pose> own = poseOf(room);
    if (!own || !own->isIdentity()) ++scene.moved_rooms;
    for (const json& entry : listIn(room, "children")) {
        const std::optional<Pose> pose = entry.is_object() ? poseOf(entry) : std::nullopt;
        if (!pose) {
            ++scene.bad_children;
            continue;
        }
        Front3dChild child;
        child.ref = textIn(entry, "ref");
        child.replace_jid = textIn(entry, "replace_jid");
        child.turn = pose->turn;
        child.moved = !pose->isIdentity();
        child.scene_from_model =
            Eigen::Translation3d(pose->position) * pose->turn * Eigen::Scaling(pose->scale);
        scene.children.push_back(std::move(child));
    }
}

}  // namespace

Result<Front3dScene> parseFront3d(const json& document, const std::string& where) {
    const auto house = document.is_object() ? document.find("scene") : document.end();
    const bool has_rooms = house != document.end() && house->is_object() &&
                           house->contains("room") && (*house)["room"].is_array();
    if (!has_rooms && listIn(document, "mesh").empty()) {
        return fail(ErrorCode::BadInput,
                    "This JSON file is not a 3D-FRONT scene: it has neither \"mesh\" nor "
                    "\"scene\" with \"room\".",
                    where);
    }
    Front3dScene scene;
    for (const json& entry : listIn(document, "furniture")) {
        if (entry.is_object()) scene.furniture.push_back(furnitureOf(entry));
    }
    if (!has_rooms) return scene;
    std::size_t number = 0;
    for (const json& room : listIn(*house, "room")) {
        if (room.is_object()) readRoom(room, ++number, scene);
    }
    return scene;
}

}  // namespace dollytrack
