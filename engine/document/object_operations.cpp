#include "engine/document/change_descriptions.h"
#include "engine/document/object_track.h"
#include "engine/document/operation_table.h"
#include "engine/document/target_filter.h"
#include "engine/scene/labels.h"
#include "engine/scene/move_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace dollytrack {
namespace {

constexpr double kFarthestMove_m = 1e4;
constexpr double kLatest_s = 1e6;
constexpr double kMostTurn_deg = 36'000.0;  // objects on tracks may make many turns

/// Alters the change of an object, which is added if there is none and removed if it becomes empty.
template <class Alter>
void alter(ProjectState& state, const OperationContext& context, const ObjectRef& object,
           Alter&& alter) {
    std::vector<ObjectChange>& changes = state.edits.scene.changes;
    auto found = std::find_if(changes.begin(), changes.end(), [&](const ObjectChange& change) {
        return findObject(context.scene, change.object) == object.id;
    });
    if (found == changes.end()) {
        found = std::find_if(changes.begin(), changes.end(), [&](const ObjectChange& change) {
            return change.object.id > object.id;
        });
        found = changes.insert(found, ObjectChange{});
        found->object = object;
    }
    alter(*found);
    if (found->saysNothing()) changes.erase(found);
}

Eigen::Vector3d readOffset(const JsonReader& from) {
    const Eigen::Vector3d offset = from.point();
    if (offset.cwiseAbs().maxCoeff() > kFarthestMove_m) {
        from.refuse("An object can be moved by at most 10000 m.");
    }
    return offset;
}

/// Refuses an entry of a list that has other fields than these.
void refuseOtherFields(const JsonReader& from, std::initializer_list<std::string_view> known) {
    for (const auto& [name, value] : from.json().items()) {
        if (std::ranges::find(known, name) != known.end()) continue;
        from.refuse(
            fmt::format("Entries have the fields {}, but not '{}'.", fmt::join(known, ", "), name));
    }
}

/// A requested move of an object; what is not given does not change.
struct MoveRequest {
    ObjectRef object;
    std::optional<Eigen::Vector3d> offset_m;
    std::optional<double> turn_rad;
};

/// Reads object, offset and turn_deg with `field`, which returns the reader of a field's name.
template <class Field>
MoveRequest readMove(const OperationReader& fields, const Field& field) {
    MoveRequest request;
    const JsonReader object = field("object");
    request.object = fields.object(object);
    if (const JsonReader offset = field("offset"); !offset.absent()) {
        request.offset_m = readOffset(offset);
    }
    if (const JsonReader turn = field("turn_deg"); !turn.absent()) {
        request.turn_rad = turn.number(-360.0, 360.0) * std::numbers::pi / 180.0;
    }
    if (!request.offset_m && !request.turn_rad) object.refuse("Give an offset or turn_deg.");
    return request;
}

/// The object's move before and after.
std::pair<ObjectMove, ObjectMove> applyMove(ProjectState& state, const OperationContext& context,
                                            const MoveRequest& request) {
    ObjectMove before;
    ObjectMove move;
    alter(state, context, request.object, [&](ObjectChange& change) {
        move = before = change.move.value_or(ObjectMove{});
        if (request.offset_m) move.offset_m = *request.offset_m;
        if (request.turn_rad) move.turn_rad = *request.turn_rad;
        change.move = move.isNone() ? std::nullopt : std::optional(move);
    });
    return {before, move};
}

TrackKey readKey(const JsonReader& from) {
    refuseOtherFields(from, {"time_s", "offset", "turn_deg"});
    TrackKey key;
    key.time_s = from.at("time_s").number(0.0, kLatest_s);
    if (const JsonReader offset = from.at("offset"); !offset.absent()) {
        key.move.offset_m = readOffset(offset);
    }
    if (const JsonReader turn = from.at("turn_deg"); !turn.absent()) {
        key.move.turn_rad = turn.number(-kMostTurn_deg, kMostTurn_deg) * std::numbers::pi / 180.0;
    }
    return key;
}

std::vector<std::string> patterns(const OperationReader& fields) {
    const JsonReader what = fields.field("what");
    std::vector<std::string> list;
    if (what.json().is_string()) {
        list.push_back(what.text());
    } else {
        for (std::size_t i = 0; i < what.size(); ++i) list.push_back(what.at(i).text());
    }
    if (std::find(list.begin(), list.end(), "") != list.end()) {
        what.refuse("A class or name must not be empty.");
    }
    return list;
}

}  // namespace

std::string excludeObject(ProjectState& state, const OperationContext& context,
                          const OperationReader& fields) {
    std::vector<ObjectRef> objects = fields.objectsOrClass("object");
    if (!fields.good()) return {};
    const std::string first = objects.front().name;
    std::erase_if(objects, [&](const ObjectRef& object) {
        return context.scene.object(object.id).role == Role::Structure;
    });
    if (objects.empty()) {
        fields.field(fields.has("object") ? "object" : "class")
            .refuse(fmt::format("'{}' is a part of the building and is never a target.", first));
        return {};
    }
    for (const ObjectRef& object : objects) {
        // Excluding a part of the building only removes its role as a target.
        const bool structure = context.scene.object(object.id).structure;
        alter(state, context, object, [&](ObjectChange& change) {
            change.role = structure ? std::nullopt : std::optional(Role::Excluded);
        });
    }
    return "Exclude " + describeObjects(objects);
}

std::string includeObject(ProjectState& state, const OperationContext& context,
                          const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objectsOrClass("object");
    if (!fields.good()) return {};
    for (const ObjectRef& object : objects) {
        // Import makes all objects except structure targets. The role must be stored only for
        // structure and for objects that lists exclude.
        const Object& included = context.scene.object(object.id);
        const bool say = included.structure || isFilteredOut(included, state.edits.scene);
        alter(state, context, object, [&](ObjectChange& change) {
            change.role = say ? std::optional(Role::Target) : std::nullopt;
        });
    }
    return "Include " + describeObjects(objects);
}

std::string setClass(ProjectState& state, const OperationContext& context,
                     const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objects("object");
    const int nyu40 = fields.nyu40("class");
    if (!fields.good()) return {};
    for (const ObjectRef& object : objects) {
        alter(state, context, object, [&](ObjectChange& change) { change.nyu40 = nyu40; });
    }
    return fmt::format("Make {} a {}", describeObjects(objects), nyu40Name(nyu40));
}

std::string setFront(ProjectState& state, const OperationContext& context,
                     const OperationReader& fields) {
    const ObjectRef object = fields.object("object");
    const Eigen::Vector3d front = fields.front("front");
    if (!fields.good()) return {};
    alter(state, context, object, [&](ObjectChange& change) {
        // Stored relative to the unturned object, so that it keeps turning with it.
        change.front = turnLevel(front, change.move ? -change.move->turn_rad : 0.0);
    });
    return "Turn the front of " + object.name;
}

std::string moveObjectBy(ProjectState& state, const OperationContext& context,
                         const OperationReader& fields) {
    const MoveRequest request =
        readMove(fields, [&](const char* name) { return fields.field(name); });
    if (!fields.good()) return {};
    const auto [before, move] = applyMove(state, context, request);
    const bool moved = move.offset_m != before.offset_m;
    const bool turned = move.turn_rad != before.turn_rad;
    const char* what = move.isNone()     ? "Put back "
                       : moved && turned ? "Move and turn "
                       : turned          ? "Turn "
                                         : "Move ";
    return what + request.object.name;
}

std::string moveObjects(ProjectState& state, const OperationContext& context,
                        const OperationReader& fields) {
    const JsonReader moves = fields.field("moves");
    if (fields.good() && (!moves.json().is_array() || moves.size() == 0)) {
        moves.refuse("This must be a list: [{\"object\": \"chair\", \"offset\": [1, 0, 0]}, ...].");
    }
    std::vector<MoveRequest> requests;
    for (std::size_t i = 0; fields.good() && i < moves.size(); ++i) {
        const JsonReader from = moves.at(i);
        refuseOtherFields(from, {"object", "offset", "turn_deg"});
        requests.push_back(readMove(fields, [&](const char* name) { return from.at(name); }));
    }
    if (!fields.good()) return {};
    std::vector<ObjectRef> objects;
    for (const MoveRequest& request : requests) {
        applyMove(state, context, request);
        objects.push_back(request.object);
    }
    return "Move " + inWords(objects);
}

std::string setTrack(ProjectState& state, const OperationContext& context,
                     const OperationReader& fields) {
    const ObjectRef object = fields.object("object");
    const JsonReader keys = fields.field("keys");
    if (fields.good() && !keys.json().is_array()) {
        keys.refuse("This must be a list: [{\"time_s\": 0, \"offset\": [0, 0, 0]}, ...].");
    }
    std::vector<TrackKey> track;
    for (std::size_t i = 0; fields.good() && i < keys.size(); ++i) {
        track.push_back(readKey(keys.at(i)));
        if (i > 0 && !(track[i].time_s > track[i - 1].time_s)) {
            keys.at(i).refuse("The keys must be listed in order of increasing time_s.");
        }
    }
    if (!fields.good()) return {};
    alter(state, context, object, [&](ObjectChange& change) { change.track = track; });
    return (track.empty() ? "Remove the track of " : "Set the track of ") + object.name;
}

std::string goToTime(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    const double time_s = fields.field("time_s").number(0.0, kLatest_s);
    if (!fields.good()) return {};
    if (putAtTime(state.edits.scene, time_s) == 0) {
        fields.field("time_s").refuse("No object has a track; object_track gives it one.");
    }
    return fmt::format("Go to {:g} s of the tracks", time_s);
}

std::string setSize(ProjectState& state, const OperationContext& context,
                    const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objectsOrClass("object");
    const std::string size = fields.field("size").text();
    if (size != "large" && size != "small" && size != "auto") {
        fields.field("size").refuse("This must be large, small or auto.");
    }
    if (!fields.good()) return {};
    for (const ObjectRef& object : objects) {
        alter(state, context, object, [&](ObjectChange& change) {
            change.large = size == "auto" ? std::nullopt : std::optional(size == "large");
        });
    }
    const std::string names = describeObjects(objects);
    return size == "auto" ? fmt::format("Measure the size of {}", names)
                          : fmt::format("Make {} {}", names, size);
}

std::string ignoreObjects(ProjectState& state, const OperationContext&,
                          const OperationReader& fields) {
    std::vector<std::string>& list = state.edits.scene.ignore;
    list = patterns(fields);
    return list.empty() ? "Ignore nothing" : fmt::format("Ignore {}", fmt::join(list, ", "));
}

std::string onlyObjects(ProjectState& state, const OperationContext&,
                        const OperationReader& fields) {
    std::vector<std::string>& list = state.edits.scene.only;
    list = patterns(fields);
    return list.empty() ? "Want every object" : fmt::format("Want only {}", fmt::join(list, ", "));
}

std::string resetObject(ProjectState& state, const OperationContext& context,
                        const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objectsOrClass("object");
    if (!fields.good()) return {};
    for (const ObjectRef& object : objects) {
        alter(state, context, object, [](ObjectChange& change) {
            const ObjectRef same = change.object;
            change = {};
            change.object = same;
        });
    }
    return "Reset " + describeObjects(objects);
}

}  // namespace dollytrack
