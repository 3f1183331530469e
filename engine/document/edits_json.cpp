#include "engine/document/edits_json.h"

#include "engine/document/json_reader.h"
#include "engine/document/unknown_keys.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <type_traits>

namespace dollytrack {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;
constexpr int kHighestObjectId = 65'535;
// Poses and directions in files may only have rounding errors.
constexpr double kUnitTolerance = 1e-6;
constexpr double kLevelTolerance = 1e-6;
constexpr double kLatest_s = 1e6;
constexpr double kMostTurn_rad = 200.0 * std::numbers::pi;  // objects on tracks may make many turns

json vectorJson(const Eigen::Vector3d& v) {
    return json::array({v.x(), v.y(), v.z()});
}

json refsJson(const std::vector<ObjectRef>& refs) {
    json list = json::array();
    for (const ObjectRef& ref : refs) {
        json& one = list.emplace_back(json{{"name", ref.name}});
        if (ref.id > 0) one["id"] = ref.id;
    }
    return list;
}

json limitsJson(const SplitLimits& limits) {
    json members;
    visitSplitLimits(limits, [&](const char* name, const auto& value, const FieldInfo&) {
        members[name] = value;
    });
    return members;
}

json definitionJson(const ObjectDefinition& definition) {
    const bool merges = definition.kind == ObjectDefinition::Kind::Merge;
    json one = {{"kind", merges ? "merge" : "split"},
                {"objects", refsJson(definition.objects)},
                {"name", definition.name},
                {"nyu40", definition.nyu40}};
    if (definition.limits != SplitLimits{}) one.update(limitsJson(definition.limits));
    return one;
}

json moveJson(const ObjectMove& move) {
    return {{"offset_m", vectorJson(move.offset_m)}, {"turn_rad", move.turn_rad}};
}

json changeJson(const ObjectChange& change) {
    json one = {{"object", refsJson({change.object}).front()}};
    if (change.role) one["role"] = *change.role == Role::Excluded ? "excluded" : "target";
    if (change.nyu40) one["nyu40"] = *change.nyu40;
    if (change.front) one["front"] = vectorJson(*change.front);
    if (change.large) one["large"] = *change.large;
    if (change.move) one["move"] = moveJson(*change.move);
    for (const TrackKey& key : change.track) {
        json at = moveJson(key.move);
        at["time_s"] = key.time_s;
        one["track"].push_back(std::move(at));
    }
    return one;
}

json pinJson(const PinnedPoint& pin) {
    const Eigen::Quaterniond& q = pin.pose.rotation;
    return {{"name", pin.name},
            {"position", vectorJson(pin.pose.position)},
            {"quaternion_xyzw", json::array({q.x(), q.y(), q.z(), q.w()})},
            {"objects", refsJson(pin.objects)}};
}

json boxJson(const NoGoBox& box) {
    return {{"name", box.name},
            {"center", vectorJson(box.box.center)},
            {"half_size_m", vectorJson(box.box.half_size)},
            {"yaw_rad", box.box.yaw}};
}

json regionJson(const Region& region) {
    json one = boxJson({region.name, region.box});
    one["weight"] = region.weight;
    one["must_see"] = region.must_see;
    return one;
}

/// Manually written files have only names; numbers are found with the scene.
ObjectRef readRef(const JsonReader& from) {
    const JsonReader id = from.at("id");
    return {id.absent() ? 0 : id.integer(1, kHighestObjectId), from.at("name").text()};
}

std::vector<ObjectRef> readRefs(const JsonReader& from, std::size_t least) {
    std::vector<ObjectRef> refs;
    for (std::size_t i = 0; i < from.size(); ++i) {
        refs.push_back(readRef(from.at(i)));
        if (i > 0 && refs[i].id > 0 && refs[i].id <= refs[i - 1].id) {
            from.at(i).refuse("Objects must be listed once each, in order of increasing id.");
        }
    }
    if (refs.size() < least) from.refuse(fmt::format("This must name at least {}.", least));
    return refs;
}

ObjectDefinition readDefinition(const JsonReader& from) {
    ObjectDefinition definition;
    const std::string kind = from.at("kind").text();
    if (kind != "merge" && kind != "split") from.at("kind").refuse("This must be merge or split.");
    const bool merges = kind == "merge";
    definition.kind = merges ? ObjectDefinition::Kind::Merge : ObjectDefinition::Kind::Split;
    definition.objects = readRefs(from.at("objects"), merges ? 2 : 1);
    if (!merges && definition.objects.size() > 1) {
        from.at("objects").refuse("Only one object can be split at a time.");
    }
    definition.name = from.at("name").text();
    definition.nyu40 = from.at("nyu40").integer(0, kNyu40Count);
    definition.limits = readSplitLimits(from);
    return definition;
}

Eigen::Vector3d readFront(const JsonReader& from) {
    const Eigen::Vector3d front = from.point();
    if (front.z() != 0.0 || std::abs(front.norm() - 1.0) > kUnitTolerance) {
        from.refuse("A front must be a horizontal direction of length 1.");
    }
    return front;
}

ObjectMove readMove(const JsonReader& from) {
    return {from.at("offset_m").point(), from.at("turn_rad").number(-kMostTurn_rad, kMostTurn_rad)};
}

std::vector<TrackKey> readTrack(const JsonReader& from) {
    std::vector<TrackKey> track;
    for (std::size_t i = 0; i < from.size() && from.good(); ++i) {
        track.push_back({from.at(i).at("time_s").number(0.0, kLatest_s), readMove(from.at(i))});
        if (i > 0 && !(track[i].time_s > track[i - 1].time_s)) {
            from.at(i).refuse("The keys of a track must be listed in order of increasing time.");
        }
    }
    return track;
}

ObjectChange readChange(const JsonReader& from) {
    ObjectChange change;
    change.object = readRef(from.at("object"));
    if (const JsonReader role = from.at("role"); !role.absent()) {
        const std::string name = role.text();
        if (name != "target" && name != "excluded") {
            role.refuse("This must be target or excluded.");
        }
        change.role = name == "excluded" ? Role::Excluded : Role::Target;
    }
    if (const JsonReader nyu40 = from.at("nyu40"); !nyu40.absent()) {
        change.nyu40 = nyu40.integer(0, kNyu40Count);
    }
    if (const JsonReader front = from.at("front"); !front.absent()) change.front = readFront(front);
    if (const JsonReader large = from.at("large"); !large.absent()) {
        if (!large.json().is_boolean()) large.refuse("This must be true or false.");
        if (large.good()) change.large = large.json().get<bool>();
    }
    if (const JsonReader move = from.at("move"); !move.absent()) change.move = readMove(move);
    change.track = readTrack(from.at("track"));
    return change;
}

PinnedPoint readPin(const JsonReader& from) {
    PinnedPoint pin;
    pin.name = from.at("name").text();
    pin.pose.position = from.at("position").point();
    const JsonReader turn = from.at("quaternion_xyzw");
    if (turn.size() != 4) {
        turn.refuse("This must be a list of four numbers.");
        return pin;
    }
    pin.pose.rotation =
        Eigen::Quaterniond(turn.at(3).number(-1.01, 1.01), turn.at(0).number(-1.01, 1.01),
                           turn.at(1).number(-1.01, 1.01), turn.at(2).number(-1.01, 1.01));
    if (std::abs(pin.pose.rotation.norm() - 1.0) > kUnitTolerance) {
        turn.refuse("A quaternion must have length 1.");
    } else if (std::abs((pin.pose.rotation * Eigen::Vector3d::UnitX()).z()) > kLevelTolerance ||
               (pin.pose.rotation * Eigen::Vector3d::UnitY()).z() > kLevelTolerance) {
        turn.refuse("The camera must stand upright, without roll.");
    }
    pin.objects = readRefs(from.at("objects"), 0);
    return pin;
}

NoGoBox readBox(const JsonReader& from) {
    NoGoBox box;
    box.name = from.at("name").text();
    box.box.center = from.at("center").point();
    box.box.half_size = from.at("half_size_m").point();
    if (!(box.box.half_size.minCoeff() > 0.0)) {
        from.at("half_size_m").refuse("A box must have a size above 0 in each direction.");
    }
    box.box.yaw = from.at("yaw_rad").number(-2.0 * std::numbers::pi, 2.0 * std::numbers::pi);
    return box;
}

std::string readPattern(const JsonReader& from) {
    std::string pattern = from.text();
    if (from.good() && pattern.empty()) from.refuse("A pattern must not be empty.");
    return pattern;
}

/// The name of a pinned point; empty if absent.
std::string readPinName(const JsonReader& from, const std::vector<PinnedPoint>& pinned) {
    if (from.absent()) return {};
    std::string name = from.text();
    const bool known = std::any_of(pinned.begin(), pinned.end(),
                                   [&](const PinnedPoint& pin) { return pin.name == name; });
    if (!known) from.refuse(fmt::format("There is no pinned point '{}'.", name));
    return name;
}

Region readRegion(const JsonReader& from) {
    NoGoBox box = readBox(from);
    Region region{std::move(box.name), box.box};
    region.weight = from.at("weight").number(kSmallestWeight, kLargestWeight);
    const JsonReader must_see = from.at("must_see");
    if (!must_see.json().is_boolean()) must_see.refuse("This must be true or false.");
    if (must_see.good()) region.must_see = must_see.json().get<bool>();
    return region;
}

/// Reads a list. Pinned points, no-go boxes and regions have unique names and a largest number.
template <class T, class Read>
std::vector<T> readList(const JsonReader& from, Read&& read) {
    constexpr bool kNamed =
        std::is_same_v<T, PinnedPoint> || std::is_same_v<T, NoGoBox> || std::is_same_v<T, Region>;
    std::vector<T> list;
    std::set<std::string> names;
    if (kNamed && from.size() > kMostPlanEntries) {
        from.refuse(
            fmt::format("The list has {} entries, but at most {} are possible; remove some "
                        "from the file.",
                        from.size(), kMostPlanEntries));
    }
    for (std::size_t i = 0; i < from.size() && from.good(); ++i) {
        list.push_back(read(from.at(i)));
        if constexpr (kNamed) {
            if (!names.insert(list.back().name).second) {
                from.at(i).at("name").refuse("Another entry has the same name.");
            }
        }
    }
    return list;
}

}  // namespace

json editsJson(const Edits& edits) {
    return editsJson(edits, json::object());
}

json editsJson(const Edits& edits, const json& loaded) {
    json section = loaded.is_object() ? loaded : json::object();
    const auto list = [](const auto& entries, auto&& toJson) {
        json result = json::array();
        for (const auto& entry : entries) result.push_back(toJson(entry));
        return result;
    };
    if (edits == Edits{} && section.empty()) return section;
    section["version"] = kVersion;
    section["definitions"] = list(edits.scene.definitions, definitionJson);
    section["changes"] = list(edits.scene.changes, changeJson);
    section["pinned"] = list(edits.plan.pinned, pinJson);
    section["removed"] = list(edits.plan.removed, [](const RemovedPoint& removed) {
        return json{{"objects", refsJson(removed.objects)}};
    });
    section["no_go"] = list(edits.plan.no_go, boxJson);
    section["regions"] = list(edits.plan.regions, regionJson);
    section["ignore"] = edits.scene.ignore;
    section["only"] = edits.scene.only;
    section.erase("motion");
    if (edits.plan.motion) section["motion"] = motionJson(*edits.plan.motion);
    for (const auto& [key, point] :
         {std::pair{"start", edits.plan.start}, {"end", edits.plan.end}}) {
        section.erase(key);
        if (!point.empty()) section[key] = point;
    }
    keepUnknownKeys(loaded, section);
    return section;
}

Result<Edits> editsFromJson(const json& section) {
    Edits edits;
    if (section.is_null() || (section.is_object() && section.empty())) return edits;
    Status status;
    const JsonReader from(section, "edits", status);
    if (!section.is_object()) from.refuse("This must be an object.");
    const JsonReader version = from.at("version");
    if (status && version.integer(1, 1'000'000) > kVersion && status) {
        version.refuse("The edits were made by a newer version of Dollytrack; use that version.");
    }
    edits.scene.definitions = readList<ObjectDefinition>(from.at("definitions"), readDefinition);
    edits.scene.changes = readList<ObjectChange>(from.at("changes"), readChange);
    edits.plan.pinned = readList<PinnedPoint>(from.at("pinned"), readPin);
    edits.plan.removed = readList<RemovedPoint>(
        from.at("removed"),
        [](const JsonReader& one) -> RemovedPoint { return {readRefs(one.at("objects"), 1)}; });
    edits.plan.no_go = readList<NoGoBox>(from.at("no_go"), readBox);
    edits.plan.regions = readList<Region>(from.at("regions"), readRegion);
    edits.scene.ignore = readList<std::string>(from.at("ignore"), readPattern);
    edits.scene.only = readList<std::string>(from.at("only"), readPattern);
    edits.plan.start = readPinName(from.at("start"), edits.plan.pinned);
    edits.plan.end = readPinName(from.at("end"), edits.plan.pinned);
    if (const JsonReader motion = from.at("motion"); !motion.absent()) {
        edits.plan.motion = readMotion(motion);
    }
    if (!status) return tl::unexpected(std::move(status.error()));
    return edits;
}

SplitLimits readSplitLimits(const JsonReader& from) {
    SplitLimits limits;
    visitSplitLimits(limits, [&](const char* name, auto& value, const FieldInfo& info) {
        const JsonReader member = from.at(name);
        if (member.absent()) return;
        if constexpr (std::is_same_v<decltype(value), int&>) {
            value = member.integer(static_cast<int>(info.min), static_cast<int>(info.max));
        } else {
            value = member.number(info.min, info.max);
        }
        if (!info.range().has(value)) {
            member.refuse(fmt::format("This must be {}.", info.range().text()));
        }
    });
    return limits;
}

}  // namespace dollytrack
