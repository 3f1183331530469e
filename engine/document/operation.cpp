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
const OperationField kOfClass = {"class", "class", false, "or all of this class, NYU40"};
const OperationField kObjects = {"objects", "objects", true,
                                 "those that the observation point stands for"};
const OperationField kName = {"name", "text", false, "a name of its own; else one is made"};
const OperationField kPosition = {"position", "point", true, "where the camera stands, m"};
const OperationField kTarget = {"target", "point", false, "what it looks at, m"};
const OperationField kYaw = {"yaw_deg", "number", false, "or its heading; 0: along x, 90: along y"};
const OperationField kPitch = {"pitch_deg", "number", false, "and how far it looks up"};
const OperationField kTurn = {"quaternion_xyzw", "list", false,
                              "or its orientation, world from camera, without roll"};
const OperationField kPoint = {"point", "text", true, "the name of a pinned point"};
const OperationField kBoxName = {"name", "text", true, "the name of the box"};

const OperationField kWeight = {"weight", "number", false,
                                "of the objects inside, 0.01 to 1000; outside it is 1"};
const OperationField kMustSee = {"must_see", "flag", false,
                                 "true: all of its surface that can be seen is to be seen"};

/// The fields of the operation `split`, from the one list of its limits.
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

const std::vector<OperationInfo>& infos() {
    static const std::vector<OperationInfo> list = {
        {"set",
         setParameter,
         "Sets a parameter; 'dollytrack params' lists them.",
         {{"name", "text", true, "of the parameter"}, {"value", "value", true, "number or word"}}},
        {"exclude",
         excludeObject,
         "Makes objects no targets: obstacles and labels only.",
         {kSelected, kOfClass}},
        {"include",
         includeObject,
         "Makes objects targets, parts of the building as well.",
         {kSelected, kOfClass}},
        {"set_class",
         setClass,
         "Sets the class of objects.",
         {kOneOrMore, {"class", "class", true, "NYU40, as a name or a number"}}},
        {"set_front",
         setFront,
         "Sets the side from which an object is seen best.",
         {kObject, {"front", "direction", true, "degrees (0: along x, 90: along y) or [x, y]"}}},
        {"set_size",
         setSize,
         "Makes objects large or small for the planner; auto measures them.",
         {kSelected, kOfClass, {"size", "text", true, "large, small or auto"}}},
        {"move_object",
         moveObjectBy,
         "Moves and turns an object from where the scene file has it; what is not given stays.",
         {kObject,
          {"offset", "point", false, "m; [0, 0, 0] puts it back"},
          {"turn_deg", "number", false,
           "about the vertical through its middle, counter-clockwise"}}},
        {"object_track",
         setTrack,
         "Gives an object a track: where it is when. It moves nothing until at_time or plan "
         "--time.",
         {kObject,
          {"keys", "list", true,
           "of {time_s, offset, turn_deg}, from where the file has it; straight on between; []: "
           "none"}}},
        {"at_time",
         goToTime,
         "Moves all objects with tracks to where these have them at a time.",
         {{"time_s", "number", true, "s; before the first key and after the last they rest"}}},
        {"reset_object",
         resetObject,
         "Takes back everything said of objects.",
         {kSelected, kOfClass}},
        {"ignore",
         ignoreObjects,
         "Makes no targets of whole classes, or of objects by name; replaces what was ignored.",
         {{"what", "texts", true, "classes and names with * and ?; [] ends it"}}},
        {"only",
         onlyObjects,
         "Makes targets of these only; replaces what was said before.",
         {{"what", "texts", true, "classes and names with * and ?; [] ends it"}}},
        {"merge",
         merge,
         "Makes one new object of several.",
         {{"objects", "objects", true, "two or more; classes and names with * and ? as well"},
          {"name", "text", true, "of the new object"},
          {"class", "class", false, "NYU40; else that of the largest part"}}},
        {"group",
         group,
         "Makes a new object of each group of touching objects: of all legs and seats, chairs.",
         {kSelected,
          kOfClass,
          {"gap_m", "number", false, "how far apart parts may be; else 0.005 m"},
          {"name", "text", false, "of the new objects, numbered; else that of the largest part"}}},
        {"split", split, "Takes objects apart into their connected pieces.", splitFields()},
        {"pin",
         pin,
         "Fixes the position point of an observation point; one pinned already is moved.",
         {kObjects, kPosition, kTarget, kYaw, kPitch, kTurn, kName}},
        {"add_point",
         addPoint,
         "Adds a position point; it stands for what it captures.",
         {kPosition, kTarget, kYaw, kPitch, kTurn, kName}},
        {"move_point",
         movePoint,
         "Moves or turns a pinned point.",
         {kPoint, optional(kPosition), kTarget, kYaw, kPitch, kTurn}},
        {"unpin",
         unpin,
         "Leaves a pinned point to the planner again; an added one goes.",
         {kPoint}},
        {"remove_point",
         removePoint,
         "Gives an observation point no position point of its own.",
         {kObjects}},
        {"restore_point", restorePoint, "Takes that back.", {kObjects}},
        {"set_start",
         setStart,
         "Lets the trajectory begin at a pinned point, or at a pose; without fields anywhere.",
         {optional(kPoint), optional(kPosition), kTarget, kYaw, kPitch, kTurn}},
        {"set_end",
         setEnd,
         "Lets it end there, likewise.",
         {optional(kPoint), optional(kPosition), kTarget, kYaw, kPitch, kTurn}},
        {"add_no_go",
         addNoGo,
         "Adds an upright box that no part of the camera's sphere may enter.",
         {{"center", "point", true, "m"},
          {"size", "point", true, "along its own axes, m"},
          {"yaw_deg", "number", false, "turns it about the vertical"},
          kName}},
        {"move_no_go",
         moveNoGo,
         "Moves, turns or resizes a no-go box.",
         {kBoxName,
          {"center", "point", false, "m"},
          {"size", "point", false, "along its own axes, m"},
          {"yaw_deg", "number", false, "turns it about the vertical"}}},
        {"rename_no_go",
         renameNoGo,
         "Gives a no-go box another name.",
         {kBoxName, {"to", "text", true, "its new name, which nothing else has"}}},
        {"remove_no_go", removeNoGo, "Removes a no-go box.", {kBoxName}},
        {"add_region",
         addRegion,
         "Adds an upright box of more or less interest, or one whose surface must be seen.",
         {{"center", "point", true, "m"},
          {"size", "point", true, "along its own axes, m"},
          {"yaw_deg", "number", false, "turns it about the vertical"},
          kWeight,
          kMustSee,
          kName}},
        {"change_region",
         changeRegion,
         "Moves, renames or weighs a region.",
         {{"name", "text", true, "the name of the region"},
          {"to", "text", false, "its new name, which nothing else has"},
          {"center", "point", false, "m"},
          {"size", "point", false, "along its own axes, m"},
          {"yaw_deg", "number", false, "turns it about the vertical"},
          kWeight,
          kMustSee}},
        {"remove_region",
         removeRegion,
         "Removes a region.",
         {{"name", "text", true, "the name of the region"}}},
        {"height_band",
         setHeightBand,
         "Keeps the camera's height above the floor in a band; without limits, in none.",
         {{"min_m", "number", false, "m; else 0"}, {"max_m", "number", false, "m; else 100"}}},
    };
    return list;
}

std::string misspelt(std::string_view what, const std::string& name,
                     const std::vector<std::string>& names) {
    const std::string close = closestName(name, names);
    return close.empty()
               ? fmt::format("There is no {} '{}'; one of: {}.", what, name, fmt::join(names, ", "))
               : fmt::format("There is no {} '{}'; did you mean '{}'?", what, name, close);
}

/// Whether the operation is one, and has the fields it needs and no others.
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
                                                 const json& operations, const SizeRules& rules) {
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
            return tl::unexpected<Error>(std::move(error));
        };
        if (!scene) return failed(scene.error());
        const SceneEdits before = next.edits.scene;
        Result<std::string> name = applyOperation(next, {*scene, set_parameter}, operations[i]);
        if (!name) return failed(std::move(name.error()));
        names.push_back(std::move(*name));
        if (before == next.edits.scene) continue;
        scene = applySceneEdits(without_pictures, next.edits.scene, rules);
        if (!scene) return failed(scene.error());
    }
    if (!scene) return tl::unexpected<Error>(std::move(scene.error()));
    state = std::move(next);
    return names;
}

}  // namespace dollytrack
