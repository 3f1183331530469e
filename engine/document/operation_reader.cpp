#include "engine/document/operation_reader.h"

#include "engine/core/name_hint.h"
#include "engine/document/edits_json.h"
#include "engine/document/target_filter.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kSteepest_deg =
    89.9;  // a camera without roll that looks straight up has no heading
constexpr double kLargestBox_m = 1e4;

Eigen::Vector3d direction(double yaw_deg, double pitch_deg) {
    const double yaw = yaw_deg * kRadians;
    const double pitch = pitch_deg * kRadians;
    return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

Eigen::Quaterniond readUpright(const JsonReader& from) {
    if (from.size() != 4) {
        from.refuse("This must be a list of four numbers: x, y, z, w.");
        return Eigen::Quaterniond::Identity();
    }
    const auto part = [&](std::size_t i) { return from.at(i).number(-1.01, 1.01); };
    const Eigen::Quaterniond turn(part(3), part(0), part(1), part(2));
    if (std::abs(turn.norm() - 1.0) > 1e-6) {
        from.refuse("A quaternion must have length 1.");
        return Eigen::Quaterniond::Identity();
    }
    const bool upright = std::abs((turn * Eigen::Vector3d::UnitX()).z()) < 1e-6 &&
                         (turn * Eigen::Vector3d::UnitY()).z() <= 1e-6;
    // An upright rotation is returned bit-identical, because a pinned point must not move.
    return upright ? turn : withoutRoll(turn.normalized());
}

}  // namespace

ObjectRef OperationReader::object(const JsonReader& from) const {
    const auto count = static_cast<int>(scene_.objects.size());
    if (from.json().is_number()) {
        const int id = from.integer(1, std::max(1, count));
        return from.good() && id <= count ? ObjectRef{id, scene_.object(id).name} : ObjectRef{};
    }
    if (!from.json().is_string()) {
        from.refuse("This must be the name or the number of an object.");
        return {};
    }
    const std::string name = from.text();
    std::vector<int> found;
    std::vector<std::string> names;
    for (const Object& object : scene_.objects) {
        names.push_back(object.name);
        if (object.name == name) found.push_back(object.id);
    }
    if (found.empty()) {
        from.refuse(fmt::format("There is no object '{}'{}", name, nameHint(name, names)));
        return {};
    }
    if (found.size() > 1) {
        from.refuse(fmt::format("{} objects are called '{}'; give the number of one: {}.",
                                found.size(), name, fmt::join(found, ", ")));
        return {};
    }
    return {found.front(), name};
}

std::vector<ObjectRef> OperationReader::named(std::string_view pattern) const {
    std::vector<ObjectRef> refs;
    for (const Object& object : scene_.objects) {
        if (isNamedBy(object, pattern)) refs.push_back({object.id, object.name});
    }
    return refs;
}

std::vector<ObjectRef> OperationReader::objects(const std::string& name) const {
    const JsonReader field_of = field(name);
    const bool is_list = field_of.json().is_array();
    const std::size_t entries = is_list ? field_of.size() : 1;
    std::vector<ObjectRef> refs;  // objects given by name or number, not by a pattern
    std::vector<ObjectRef> by_pattern;
    for (std::size_t i = 0; i < entries; ++i) {
        const JsonReader entry = is_list ? field_of.at(i) : field_of;
        std::vector<ObjectRef> found;
        if (entry.json().is_string()) {
            const std::string text = entry.text();
            const bool is_name =
                std::ranges::find(scene_.objects, text, &Object::name) != scene_.objects.end();
            if (!is_name) found = named(text);
        }
        if (found.empty()) {
            refs.push_back(object(entry));
        } else {
            by_pattern.insert(by_pattern.end(), found.begin(), found.end());
        }
    }
    if (entries == 0) field_of.refuse("This must name at least one object.");
    const auto byNumber = [](const ObjectRef& a, const ObjectRef& b) { return a.id < b.id; };
    std::sort(refs.begin(), refs.end(), byNumber);
    if (std::adjacent_find(refs.begin(), refs.end()) != refs.end()) {
        field_of.refuse("An object is named twice.");
    }
    // Patterns may overlap.
    refs.insert(refs.end(), by_pattern.begin(), by_pattern.end());
    std::sort(refs.begin(), refs.end(), byNumber);
    refs.erase(std::unique(refs.begin(), refs.end()), refs.end());
    return refs;
}

std::vector<ObjectRef> OperationReader::objectsOrClass(const std::string& name) const {
    if (has(name) == has("class")) {
        fields_.refuse(
            has(name)
                ? fmt::format("Give either '{}' or 'class', not both.", name)
                : fmt::format("It needs the field '{}' or 'class', which selects the objects.",
                              name));
        return {};
    }
    if (has(name)) return objects(name);
    const nlohmann::json& said = field("class").json();
    const bool unknown = said.is_string() && said.get<std::string>() == kWithoutClass;
    const int wanted = unknown ? 0 : nyu40("class");
    std::vector<ObjectRef> refs;
    for (const Object& object : scene_.objects) {
        if (good() && object.nyu40 == wanted) refs.push_back({object.id, object.name});
    }
    if (good() && refs.empty()) {
        field("class").refuse(
            fmt::format("The scene has no object of the class '{}'.", nyu40Name(wanted)));
    }
    return refs;
}

SplitLimits OperationReader::splitLimits() const {
    return readSplitLimits(fields_);
}

GivenMotion OperationReader::motion() const {
    return readMotion(fields_);
}

int OperationReader::nyu40(const std::string& name) const {
    const JsonReader from = field(name);
    if (from.json().is_number()) return from.integer(1, kNyu40Count);
    const std::string text = from.text();
    if (!from.good()) return 0;
    const int found = nyu40FromName(text);
    if (found != 0) return found;
    std::vector<std::string> names;
    for (int i = 1; i <= kNyu40Count; ++i) names.emplace_back(nyu40Name(i));
    from.refuse(fmt::format("There is no NYU40 class '{}'{}", text, nameHint(text, names)));
    return 0;
}

Eigen::Vector3d OperationReader::front(const std::string& name) const {
    const JsonReader from = field(name);
    if (from.json().is_number()) {
        const double angle = from.number(-360.0, 360.0) * kRadians;
        return {std::cos(angle), std::sin(angle), 0.0};
    }
    if (from.size() != 2) {
        from.refuse("This must be degrees (0: along x, 90: along y) or a direction [x, y].");
        return Eigen::Vector3d::UnitX();
    }
    const Eigen::Vector3d front(from.at(0).number(-1e6, 1e6), from.at(1).number(-1e6, 1e6), 0.0);
    if (from.good() && !(front.norm() > 1e-9)) from.refuse("A direction must not be [0, 0].");
    return from.good() ? front.normalized() : Eigen::Vector3d::UnitX();
}

Pose OperationReader::pose(const std::optional<Pose>& before) const {
    Pose pose = before.value_or(Pose{});
    const int ways = has("target") + (has("yaw_deg") || has("pitch_deg")) + has("quaternion_xyzw");
    if (ways > 1) {
        fields_.refuse("Give only one of target, yaw_deg with pitch_deg, and quaternion_xyzw.");
    } else if (ways == 0 && !(before && has("position"))) {
        fields_.refuse(before
                           ? "Give a position, or the direction of the camera: target, or yaw_deg "
                             "and pitch_deg."
                           : "Give the direction of the camera: target, or yaw_deg and pitch_deg.");
    }
    if (!before || has("position")) pose.position = field("position").point();
    if (has("target")) {
        const Eigen::Vector3d target = field("target").point();
        if (!((target - pose.position).norm() > 1e-6)) {
            field("target").refuse("The target must differ from the camera's position.");
        }
        if (good()) pose.rotation = lookAt(pose.position, target).rotation;
    } else if (has("quaternion_xyzw")) {
        pose.rotation = readUpright(field("quaternion_xyzw"));
    } else if (ways == 1) {
        // An angle that is not given is not changed.
        const Eigen::Vector3d now = pose.forward();
        const double yaw = has("yaw_deg") ? field("yaw_deg").number(-360.0, 360.0)
                           : before       ? std::atan2(now.y(), now.x()) / kRadians
                                          : 0.0;
        const double pitch = has("pitch_deg")
                                 ? field("pitch_deg").number(-kSteepest_deg, kSteepest_deg)
                             : before ? std::asin(std::clamp(now.z(), -1.0, 1.0)) / kRadians
                                      : 0.0;
        if (good()) pose.rotation = lookAlong(direction(yaw, pitch));
    }
    return pose;
}

OrientedBox OperationReader::box(const std::optional<OrientedBox>& before) const {
    OrientedBox box = before.value_or(OrientedBox{});
    if (before && !has("center") && !has("size") && !has("yaw_deg")) {
        fields_.refuse("Give a center, a size or yaw_deg.");
    }
    if (!before || has("center")) box.center = field("center").point();
    if (!before || has("size")) {
        box.half_size = 0.5 * field("size").point();
        if (!(box.half_size.minCoeff() > 0.0) || box.half_size.maxCoeff() > kLargestBox_m) {
            field("size").refuse("A box must have a size above 0 m in each direction.");
        }
    }
    if (has("yaw_deg")) box.yaw = field("yaw_deg").number(-360.0, 360.0) * kRadians;
    return box;
}

std::string inWords(const std::vector<ObjectRef>& objects) {
    if (objects.empty()) return {};
    if (objects.size() == 1) return objects[0].name;
    if (objects.size() == 2) return objects[0].name + " and " + objects[1].name;
    return fmt::format("{} and {} more", objects[0].name, objects.size() - 1);
}

}  // namespace dollytrack
