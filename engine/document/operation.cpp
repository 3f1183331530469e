#include "engine/document/operation.h"

#include "engine/core/field_list.h"
#include "engine/document/operation_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack {
namespace {

using nlohmann::json;

// Fields that several operations share.
const OperationField kObject = {"object", "object", true, "its name or number"};
const OperationField kOneOrMore = {"object", "objects", true,
                                   "its name or number, a class, a name with * and ?, or a list"};
const OperationField kSelected = {"object", "objects", false,
                                  "its name or number, a class, a name with * and ?, or a list"};
const OperationField kOfClass = {"class", "class", false,
                                 "instead of object: all objects of this NYU40 class"};
const OperationField kObjects = {"objects", "objects", true,
                                 "objects that the observation point is for"};
const OperationField kName = {"name", "text", false, "a unique name; default: generated"};
const OperationField kPosition = {"position", "point", true, "position of the camera, m"};
const OperationField kTarget = {"target", "point", false, "point the camera looks at, m"};
const OperationField kYaw = {"yaw_deg", "number", false,
                             "instead of target: heading; 0: along x, 90: along y"};
const OperationField kPitch = {"pitch_deg", "number", false, "upward pitch, with yaw_deg"};
const OperationField kTurn = {"quaternion_xyzw", "list", false,
                              "instead of target: orientation, world from camera, without roll"};
const OperationField kPoint = {"point", "text", true, "the name of a pinned point"};
const OperationField kKey = {"key", "number", true, "number of the key, from 1"};
const OperationField kBoxName = {"name", "text", true, "the name of the box"};

const OperationField kWeight = {"weight", "number", false,
                                "weight of the objects inside, 0.01 to 1000; outside it is 1"};
const OperationField kMustSee = {"must_see", "flag", false,
                                 "true: frames must show all of its visible surface"};

/// The fields of the operation `split`, generated from the list of its limits.
std::vector<OperationField> splitFields() {
    std::vector<OperationField> fields = {kSelected, kOfClass};
    const SplitLimits limits;
    visitSplitLimits(limits, [&](std::string_view name, auto, const FieldInfo& info) {
        fields.push_back({name, "number", false, info.text});
    });
    return fields;
}

OperationField optional(OperationField field) {
    field.required = false;
    return field;
}

/// Operations on parameters and objects.
std::vector<OperationInfo> objectOperations() {
    return {
        {"set",
         setParameter,
         "Sets a parameter; 'dollytrack params' lists them.",
         {{"name", "text", true, "name of the parameter"},
          {"value", "value", true, "number or word"}}},
        {"exclude",
         excludeObject,
         "Excludes objects from the targets; they stay obstacles and labels.",
         {kSelected, kOfClass}},
        {"include",
         includeObject,
         "Makes objects targets, also parts of the building.",
         {kSelected, kOfClass}},
        {"set_class",
         setClass,
         "Sets the class of objects.",
         {kOneOrMore, {"class", "class", true, "NYU40, as a name or a number"}}},
        {"set_front",
         setFront,
         "Sets the front of an object, the side that it should be viewed from.",
         {kObject,
          {"front", "direction", true,
           "direction in degrees (0: along x, 90: along y) or as [x, y]"}}},
        {"set_size",
         setSize,
         "Makes objects large or small for the planner; auto measures them.",
         {kSelected, kOfClass, {"size", "text", true, "large, small or auto"}}},
        {"move_object",
         moveObjectBy,
         "Moves and turns an object relative to the scene file; values not given do not change.",
         {kObject,
          {"offset", "point", false, "m; [0, 0, 0]: original position"},
          {"turn_deg", "number", false,
           "about the vertical through its centre, counter-clockwise"}}},
        {"move_objects",
         moveObjects,
         "Moves and turns several objects in one step.",
         {{"moves", "list", true, "{object, offset, turn_deg}, each as for move_object"}}},
        {"object_track",
         setTrack,
         "Sets the track of an object: poses over time, which at_time or plan --time applies.",
         {kObject,
          {"keys", "list", true,
           "{time_s, offset, turn_deg} relative to the scene file, interpolated linearly; []: no "
           "track"}}},
        {"at_time",
         goToTime,
         "Moves all objects with tracks to their poses at a time.",
         {{"time_s", "number", true, "s; objects rest before the first and after the last key"}}},
        {"reset_object", resetObject, "Removes all edits of objects.", {kSelected, kOfClass}},
        {"ignore",
         ignoreObjects,
         "Excludes classes, or objects by name, from the targets; replaces the previous list.",
         {{"what", "texts", true, "classes and names with * and ?; []: none"}}},
        {"only",
         onlyObjects,
         "Makes these the only targets; replaces the previous list.",
         {{"what", "texts", true, "classes and names with * and ?; []: none"}}},
        {"merge",
         merge,
         "Merges several objects into one.",
         {{"objects", "objects", true, "two or more; also classes and names with * and ?"},
          {"name", "text", true, "name of the new object"},
          {"class", "class", false, "NYU40; default: that of the largest part"}}},
        {"group",
         group,
         "Merges each group of touching objects into one, such as the legs and seats of chairs.",
         {kSelected,
          kOfClass,
          {"gap_m", "number", false, "largest gap between parts; default: 0.005 m"},
          {"name", "text", false,
           "name of the new objects, numbered; default: that of the largest part"}}},
        {"split", split, "Splits objects into their connected pieces.", splitFields()}};
}

/// Operations on points of the planned trajectory, its ends and the given motion.
std::vector<OperationInfo> trajectoryOperations() {
    return {
        {"pin",
         pin,
         "Fixes the position point of an observation point; moves it if it is already pinned.",
         {kObjects, kPosition, kTarget, kYaw, kPitch, kTurn, kName}},
        {"add_point",
         addPoint,
         "Adds a position point for the objects that it captures.",
         {kPosition, kTarget, kYaw, kPitch, kTurn, kName}},
        {"move_point",
         movePoint,
         "Moves or turns a pinned point.",
         {kPoint, optional(kPosition), kTarget, kYaw, kPitch, kTurn}},
        {"unpin",
         unpin,
         "Lets the planner choose a pinned point again; removes an added one.",
         {kPoint}},
        {"remove_point",
         removePoint,
         "Removes the position point of an observation point.",
         {kObjects}},
        {"restore_point", restorePoint, "Restores a removed position point.", {kObjects}},
        {"set_start",
         setStart,
         "Starts the trajectory at a pinned point or a pose; without fields, anywhere.",
         {optional(kPoint), optional(kPosition), kTarget, kYaw, kPitch, kTurn}},
        {"set_end",
         setEnd,
         "Ends the trajectory at a pinned point or a pose; without fields, anywhere.",
         {optional(kPoint), optional(kPosition), kTarget, kYaw, kPitch, kTurn}},
        {"set_motion",
         setMotion,
         "Makes a given camera motion the trajectory, instead of a planned one; it has frames or "
         "keys.",
         {{"frames", "list", false,
           "[time_s, x, y, z, qx, qy, qz, qw] of each frame, world from camera (x right, y down), "
           "as "
           "in TUM files; after a jump of the camera, a ninth number differs: the path"},
          {"keys", "list", false,
           "instead of frames: [time_s, x, y, z, qx, qy, qz, qw] of each key frame"},
          {"frame_interval_s", "number", false, "s; default: the median step"},
          {"name", "text", false, "name shown in lists"}}},
        {"trim_motion",
         trimMotion,
         "Keeps the part of the given camera motion between two times.",
         {{"from_s", "number", false, "s; default: its begin"},
          {"to_s", "number", false, "s; default: its end"}}},
        {"clear_motion",
         clearMotion,
         "Removes the given camera motion; the trajectory is planned again.",
         {}},
        {"add_camera_key",
         addCameraKey,
         "Adds a key frame to the camera path, or replaces the one at that time.",
         {{"time_s", "number", true, "s; the camera passes the keys in the order of their times"},
          kPosition,
          kTarget,
          kYaw,
          kPitch,
          kTurn}},
        {"change_camera_key",
         changeCameraKey,
         "Retimes, moves or turns a key frame of the camera path.",
         {kKey,
          {"time_s", "number", false, "s; between the times of its neighbours"},
          optional(kPosition),
          kTarget,
          kYaw,
          kPitch,
          kTurn}},
        {"remove_camera_key",
         removeCameraKey,
         "Removes a key frame; without keys, the trajectory is planned again.",
         {kKey}}};
}

/// Operations on boxes, regions and heights of a room.
std::vector<OperationInfo> regionOperations() {
    return {{"add_no_go",
             addNoGo,
             "Adds an upright box that no part of the camera's sphere may enter.",
             {{"center", "point", true, "m"},
              {"size", "point", true, "along its own axes, m"},
              {"yaw_deg", "number", false, "rotation about the vertical"},
              kName}},
            {"move_no_go",
             moveNoGo,
             "Moves, turns or resizes a no-go box.",
             {kBoxName,
              {"center", "point", false, "m"},
              {"size", "point", false, "along its own axes, m"},
              {"yaw_deg", "number", false, "rotation about the vertical"}}},
            {"rename_no_go",
             renameNoGo,
             "Renames a no-go box.",
             {kBoxName, {"to", "text", true, "its new, unique name"}}},
            {"remove_no_go", removeNoGo, "Removes a no-go box.", {kBoxName}},
            {"add_region",
             addRegion,
             "Adds an upright box with a weight, or one whose surface must be seen.",
             {{"center", "point", true, "m"},
              {"size", "point", true, "along its own axes, m"},
              {"yaw_deg", "number", false, "rotation about the vertical"},
              kWeight,
              kMustSee,
              kName}},
            {"change_region",
             changeRegion,
             "Moves, renames or weights a region.",
             {{"name", "text", true, "the name of the region"},
              {"to", "text", false, "its new, unique name"},
              {"center", "point", false, "m"},
              {"size", "point", false, "along its own axes, m"},
              {"yaw_deg", "number", false, "rotation about the vertical"},
              kWeight,
              kMustSee}},
            {"remove_region",
             removeRegion,
             "Removes a region.",
             {{"name", "text", true, "the name of the region"}}},
            {"height_band",
             setHeightBand,
             "Limits the camera's height above the floor; without fields, removes the limits.",
             {{"min_m", "number", false, "m; default: 0"},
              {"max_m", "number", false, "m; default: 100"}}}};
}

const std::vector<OperationInfo>& infos() {
    static const std::vector<OperationInfo> list = [] {
        std::vector<OperationInfo> all = objectOperations();
        for (const auto& more : {trajectoryOperations(), regionOperations()}) {
            all.insert(all.end(), more.begin(), more.end());
        }
        return all;
    }();
    return list;
}

std::string misspelt(std::string_view what, const std::string& name,
                     const std::vector<std::string>& names) {
    const std::string close = closestName(name, names);
    return close.empty()
               ? fmt::format("There is no {} '{}'; one of: {}.", what, name, fmt::join(names, ", "))
               : fmt::format("There is no {} '{}'; did you mean '{}'?", what, name, close);
}

/// The description of an operation; null if it is unknown. Unknown and missing fields are reported
/// to the reader.
const OperationInfo* checkFields(const json& operation, const JsonReader& reader) {
    if (!operation.is_object() || !operation.contains("op")) {
        reader.refuse(
            "An operation is an object such as {\"op\":\"exclude\",\"object\":\"lamp\"}.");
        return nullptr;
    }
    const std::string op = reader.at("op").text();
    if (!reader.good()) return nullptr;
    const auto& list = infos();
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const OperationInfo& info) { return info.op == op; });
    if (found == list.end()) {
        std::vector<std::string> names;
        for (const OperationInfo& info : list) names.emplace_back(info.op);
        reader.at("op").refuse(misspelt("operation", op, names));
        return nullptr;
    }
    std::vector<std::string> names;
    for (const OperationField& field : found->fields) names.emplace_back(field.name);
    for (const auto& [key, value] : operation.items()) {
        if (key == "op" || std::find(names.begin(), names.end(), key) != names.end()) continue;
        reader.refuse(misspelt("field", key, names));
    }
    for (const OperationField& field : found->fields) {
        if (!field.required || !reader.at(std::string(field.name)).absent()) continue;
        reader.refuse(fmt::format("'{}' needs the field '{}': {}.", op, field.name, field.text));
    }
    return &*found;
}

}  // namespace

std::span<const OperationInfo> listOperations() {
    return infos();
}

Result<std::string> applyOperation(ProjectState& state, const OperationContext& context,
                                   const json& operation) {
    Status status;
    const OperationReader fields(operation, context.scene, status);
    const OperationInfo* info = checkFields(operation, JsonReader(operation, {}, status));
    std::string name;
    ProjectState next = state;
    if (info && status) name = info->apply(next, context, fields);
    if (!status) {
        return fail(ErrorCode::Usage, std::move(status.error().message),
                    std::move(status.error().where));
    }
    state = std::move(next);
    return name;
}

Result<std::vector<std::string>> applyOperations(ProjectState& state, const Scene& imported,
                                                 const SetParameter& set_parameter,
                                                 const json& operations, const SizeRules& rules,
                                                 const JobContext& job) {
    if (!operations.is_array()) {
        return fail(ErrorCode::Usage, "The operations must be a list: [{\"op\": ...}, ...].");
    }
    Scene without_pictures = imported;
    without_pictures.textures.clear();
    Result<Scene> scene = applySceneEdits(without_pictures, state.edits.scene, rules);
    ProjectState next = state;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < operations.size(); ++i) {
        const auto failed = [&](Error error) {
            const std::string number = fmt::format("operation {}", i + 1);
            error.where = error.where.empty() ? number : number + ", " + error.where;
            return tl::unexpected(std::move(error));
        };
        if (!scene) return failed(scene.error());
        if (job.cancelled()) {
            return fail(ErrorCode::Cancelled, "The operations were stopped; nothing was changed.");
        }
        const SceneEdits before = next.edits.scene;
        Result<std::string> name = applyOperation(next, {*scene, set_parameter}, operations[i]);
        if (!name) return failed(std::move(name.error()));
        names.push_back(std::move(*name));
        if (before == next.edits.scene) continue;
        scene = applySceneEdits(without_pictures, next.edits.scene, rules);
        if (!scene) return failed(scene.error());
    }
    if (!scene) return tl::unexpected(std::move(scene.error()));
    state = std::move(next);
    return names;
}

}  // namespace dollytrack
