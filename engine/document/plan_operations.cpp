#include "engine/document/change_descriptions.h"
#include "engine/document/named_entries.h"
#include "engine/document/operation_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace dollytrack {
namespace {

using nlohmann::json;

/// Removes start and end if their pinned point no longer exists.
void forgetLostEnds(PlanEdits& plan) {
    for (std::string* end : {&plan.start, &plan.end}) {
        if (!isTaken(plan.pinned, *end)) end->clear();
    }
}

/// The name of the pinned point in the fields: an existing one, or a new one from a pose. A new
/// point is called `name`; if the `current` end was made this way, it is moved instead. Empty
/// without fields.
std::string endPoint(std::vector<PinnedPoint>& pinned, const OperationReader& fields,
                     const std::string& name, const std::string& current) {
    const bool by_pose = fields.has("position");
    if (fields.has("point")) {
        if (by_pose) fields.field("point").refuse("Give either a point or a position.");
        const auto found = findNamed(pinned, fields.field("point"), "pinned point");
        return found == pinned.end() ? std::string() : found->name;
    }
    if (!by_pose) {
        for (const char* field : {"target", "yaw_deg", "pitch_deg", "quaternion_xyzw"}) {
            if (fields.has(field)) fields.field(field).refuse("Give a position as well.");
        }
        return {};
    }
    const Pose pose = fields.pose({});
    const bool made_so = current.starts_with(name);
    const auto same = std::find_if(pinned.begin(), pinned.end(), [&](const PinnedPoint& pin) {
        return made_so && pin.name == current && pin.objects.empty();
    });
    if (same != pinned.end()) {
        same->pose = pose;
        return current;
    }
    pinned.push_back({freeName(pinned, fields, name, "pinned points"), pose, {}});
    return pinned.back().name;
}

/// The keys of the camera path, to be changed; none if the trajectory is planned.
std::vector<MotionKey> cameraKeys(const PlanEdits& plan, const OperationReader& fields) {
    if (!plan.motion) return {};
    if (plan.motion->keys.empty()) {
        fields.refuse("The camera path has frames instead of keys; remove it before adding keys.");
    }
    return plan.motion->keys;
}

/// The index of the key with the number in the field `key`; 0 after an error.
std::size_t keyIndex(const std::vector<MotionKey>& keys, const OperationReader& fields) {
    if (keys.empty()) fields.refuse("The camera path has no keys.");
    if (!fields.good()) return 0;
    const int number = fields.field("key").integer(1, static_cast<int>(keys.size()));
    return fields.good() ? static_cast<std::size_t>(number - 1) : 0;
}

double keyTime(const OperationReader& fields) {
    return fields.field("time_s").number(0.0, kLastMotionTime_s);
}

/// Makes these keys the camera path, with its name; without keys, the trajectory is planned again.
void setCameraKeys(PlanEdits& plan, std::vector<MotionKey> keys) {
    GivenMotion motion;
    if (plan.motion) motion.name = plan.motion->name;
    motion.keys = std::move(keys);
    plan.motion = motion.keys.empty() ? SharedMotion() : SharedMotion(std::move(motion));
}

/// Whether an edit refers to exactly these objects of the scene.
bool standsFor(const std::vector<ObjectRef>& objects, const std::vector<ObjectRef>& wanted,
               const Scene& scene) {
    return objects.size() == wanted.size() &&
           std::all_of(objects.begin(), objects.end(), [&](const ObjectRef& ref) {
               const int id = findObject(scene, ref);
               return std::any_of(wanted.begin(), wanted.end(),
                                  [&](const ObjectRef& other) { return other.id == id; });
           });
}

}  // namespace

std::string setParameter(ProjectState& state, const OperationContext& context,
                         const OperationReader& fields) {
    const JsonReader name = fields.field("name");
    const std::string text = name.text();
    if (!fields.good()) return {};
    const json& value = fields.field("value").json();
    if (Status set = context.set_parameter(state.parameters, text, value); !set) {
        fields.field("value").refuse(set.error().message);
        return {};
    }
    return fmt::format("Set {} to {}", text,
                       value.is_string() ? value.get<std::string>() : value.dump());
}

std::string setHeightBand(ProjectState& state, const OperationContext& context,
                          const OperationReader& fields) {
    constexpr double kHighest = 100.0;
    const double low = fields.has("min_m") ? fields.field("min_m").number(0.0, kHighest) : 0.0;
    const double high =
        fields.has("max_m") ? fields.field("max_m").number(0.0, kHighest) : kHighest;
    if (fields.good() && !(low < high)) {
        fields.field("max_m").refuse(
            fmt::format("The upper limit must be above the lower limit of {:g} m.", low));
    }
    if (!fields.good()) return {};
    for (const auto& [name, value] : {std::pair{"min_height_m", low}, {"max_height_m", high}}) {
        if (Status set = context.set_parameter(state.parameters, name, value); !set) {
            fields.field(name == std::string("min_height_m") ? "min_m" : "max_m")
                .refuse(set.error().message);
        }
    }
    if (low == 0.0 && high == kHighest) return "Allow every height";
    return fmt::format("Keep the camera {:g} to {:g} m above the floor", low, high);
}

std::string pin(ProjectState& state, const OperationContext& context,
                const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objects("objects");
    if (!fields.good()) return {};
    std::vector<PinnedPoint>& pinned = state.edits.plan.pinned;
    const auto found = std::find_if(pinned.begin(), pinned.end(), [&](const PinnedPoint& point) {
        return standsFor(point.objects, objects, context.scene);
    });
    // Pinning a removed point restores it.
    std::erase_if(state.edits.plan.removed, [&](const RemovedPoint& removed) {
        return standsFor(removed.objects, objects, context.scene);
    });
    if (found != pinned.end() && !fields.has("name")) {
        const Pose before = std::exchange(found->pose, fields.pose(found->pose));
        return fmt::format("{} {}", changeOf(before, found->pose), describeView(*found));
    } else {
        const std::string name = freeName(pinned, fields, inWords(objects), "pinned points");
        pinned.push_back({name, fields.pose({}), objects});
    }
    return "Pin the view of " + describeObjects(objects);
}

std::string addPoint(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    std::vector<PinnedPoint>& pinned = state.edits.plan.pinned;
    const std::string name = freeName(pinned, fields, "view", "pinned points");
    pinned.push_back({name, fields.pose({}), {}});
    return "Add " + name;
}

std::string movePoint(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    std::vector<PinnedPoint>& pinned = state.edits.plan.pinned;
    const auto found = findNamed(pinned, fields.field("point"), "pinned point");
    if (!fields.good()) return {};
    const Pose before = std::exchange(found->pose, fields.pose(found->pose));
    return fmt::format("{} {}", changeOf(before, found->pose), describeView(*found));
}

std::string unpin(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    std::vector<PinnedPoint>& pinned = state.edits.plan.pinned;
    const auto found = findNamed(pinned, fields.field("point"), "pinned point");
    if (!fields.good()) return {};
    std::string name =
        "Unpin " +
        (found->objects.empty() ? found->name : "the view of " + describeObjects(found->objects));
    pinned.erase(found);
    forgetLostEnds(state.edits.plan);
    return name;
}

std::string removePoint(ProjectState& state, const OperationContext& context,
                        const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objects("objects");
    if (!fields.good()) return {};
    PlanEdits& plan = state.edits.plan;
    std::erase_if(plan.pinned, [&](const PinnedPoint& point) {
        return !point.objects.empty() && standsFor(point.objects, objects, context.scene);
    });
    forgetLostEnds(plan);
    const bool already =
        std::any_of(plan.removed.begin(), plan.removed.end(), [&](const RemovedPoint& removed) {
            return standsFor(removed.objects, objects, context.scene);
        });
    if (!already) plan.removed.push_back({objects});
    return "Remove the view of " + describeObjects(objects);
}

std::string restorePoint(ProjectState& state, const OperationContext& context,
                         const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objects("objects");
    if (!fields.good()) return {};
    const std::size_t erased =
        std::erase_if(state.edits.plan.removed, [&](const RemovedPoint& removed) {
            return standsFor(removed.objects, objects, context.scene);
        });
    if (erased == 0) {
        fields.field("objects").refuse(
            fmt::format("The view of {} was not removed.", inWords(objects)));
    }
    return "Restore the view of " + describeObjects(objects);
}

std::string setStart(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    PlanEdits& plan = state.edits.plan;
    plan.start = endPoint(plan.pinned, fields, "start", plan.start);
    return plan.start.empty() ? "Begin anywhere" : "Begin at " + plan.start;
}

std::string setEnd(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    PlanEdits& plan = state.edits.plan;
    plan.end = endPoint(plan.pinned, fields, "end", plan.end);
    return plan.end.empty() ? "End anywhere" : "End at " + plan.end;
}

std::string setMotion(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    GivenMotion motion = fields.motion();
    if (!fields.good()) return {};
    const std::string done =
        !motion.name.empty() ? fmt::format("Set the camera motion {}", motion.name)
        : motion.keys.empty()
            ? fmt::format("Set a camera motion of {} frames", motion.frames.size())
            : fmt::format("Set a camera motion of {} keys", motion.keys.size());
    state.edits.plan.motion = std::move(motion);
    return done;
}

std::string trimMotion(ProjectState& state, const OperationContext&,
                       const OperationReader& fields) {
    const SharedMotion& given = state.edits.plan.motion;
    if (!given) fields.refuse("There is no given camera motion.");
    double from_s = 0.0;
    double to_s = kLastMotionTime_s;
    if (fields.has("from_s")) from_s = fields.field("from_s").number(0.0, kLastMotionTime_s);
    if (fields.has("to_s")) to_s = fields.field("to_s").number(0.0, kLastMotionTime_s);
    if (!fields.good()) return {};
    const GivenMotion trimmed = given->between(from_s, to_s);
    if (trimmed.frames.empty() && trimmed.keys.empty()) {
        fields.refuse(
            fmt::format("The camera motion has no frame from {:g} to {:g} s.", from_s, to_s));
        return {};
    }
    const std::string done =
        fmt::format("Trim the camera motion to {:.1f} s", trimmed.duration_s());
    state.edits.plan.motion = trimmed;
    return done;
}

std::string clearMotion(ProjectState& state, const OperationContext&,
                        const OperationReader& fields) {
    SharedMotion& motion = state.edits.plan.motion;
    if (!motion) fields.refuse("There is no given camera motion.");
    motion = {};
    return "Remove the camera motion";
}

std::string addCameraKey(ProjectState& state, const OperationContext&,
                         const OperationReader& fields) {
    std::vector<MotionKey> keys = cameraKeys(state.edits.plan, fields);
    const MotionKey key{keyTime(fields), fields.pose({})};
    if (!fields.good()) return {};
    const auto at = std::ranges::lower_bound(keys, key.time_s, {}, &MotionKey::time_s);
    const auto number = at - keys.begin() + 1;
    const bool is_there = at != keys.end() && at->time_s == key.time_s;
    if (is_there) {
        *at = key;
    } else if (keys.size() < kMostMotionKeys) {
        keys.insert(at, key);
    } else {
        fields.refuse(fmt::format("At most {} keys are possible; remove one.", kMostMotionKeys));
    }
    setCameraKeys(state.edits.plan, std::move(keys));
    return fmt::format("{} camera key {}", is_there ? "Replace" : "Add", number);
}

std::string changeCameraKey(ProjectState& state, const OperationContext&,
                            const OperationReader& fields) {
    std::vector<MotionKey> keys = cameraKeys(state.edits.plan, fields);
    const std::size_t at = keyIndex(keys, fields);
    if (!fields.good()) return {};
    const bool retimes = fields.has("time_s");
    if (retimes) {
        const double time_s = keyTime(fields);
        if ((at > 0 && !(time_s > keys[at - 1].time_s)) ||
            (at + 1 < keys.size() && !(time_s < keys[at + 1].time_s))) {
            fields.field("time_s").refuse(
                fmt::format("Key {} must stay between the keys before and after it.", at + 1));
        }
        keys[at].time_s = time_s;
    }
    const bool moves = std::ranges::any_of(
        std::array{"position", "target", "yaw_deg", "pitch_deg", "quaternion_xyzw"},
        [&](const char* name) { return fields.has(name); });
    if (moves || !retimes) keys[at].pose = fields.pose(keys[at].pose);
    setCameraKeys(state.edits.plan, std::move(keys));
    return fmt::format("{} camera key {}", moves ? "Move" : "Retime", at + 1);
}

std::string removeCameraKey(ProjectState& state, const OperationContext&,
                            const OperationReader& fields) {
    std::vector<MotionKey> keys = cameraKeys(state.edits.plan, fields);
    const std::size_t at = keyIndex(keys, fields);
    if (!fields.good()) return {};
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(at));
    setCameraKeys(state.edits.plan, std::move(keys));
    return fmt::format("Remove camera key {}", at + 1);
}

std::string addNoGo(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    std::vector<NoGoBox>& boxes = state.edits.plan.no_go;
    const std::string name = freeName(boxes, fields, "no-go box", "no-go boxes");
    boxes.push_back({name, fields.box({})});
    return "Add " + name;
}

std::string moveNoGo(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    const auto found = findNamed(state.edits.plan.no_go, fields.field("name"), "no-go box");
    if (!fields.good()) return {};
    const OrientedBox before = std::exchange(found->box, fields.box(found->box));
    return fmt::format("{} {}", changeOf(before, found->box), found->name);
}

std::string renameNoGo(ProjectState& state, const OperationContext&,
                       const OperationReader& fields) {
    std::vector<NoGoBox>& boxes = state.edits.plan.no_go;
    const auto found = findNamed(boxes, fields.field("name"), "no-go box");
    const JsonReader to = fields.field("to");
    const std::string name = to.text();
    if (!fields.good()) return {};
    if (name.empty()) to.refuse("A name must not be empty.");
    if (name != found->name && isTaken(boxes, name)) {
        to.refuse(
            fmt::format("Another no-go box is already called '{}'; choose another name.", name));
    }
    std::string done = fmt::format("Rename {} to {}", found->name, name);
    found->name = name;
    return done;
}

std::string removeNoGo(ProjectState& state, const OperationContext&,
                       const OperationReader& fields) {
    std::vector<NoGoBox>& boxes = state.edits.plan.no_go;
    const auto found = findNamed(boxes, fields.field("name"), "no-go box");
    if (!fields.good()) return {};
    std::string name = "Remove " + found->name;
    boxes.erase(found);
    return name;
}

}  // namespace dollytrack
