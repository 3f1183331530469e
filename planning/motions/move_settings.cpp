#include "planning/motions/move_settings.h"

#include "engine/core/name_hint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace dollytrack::planning {
namespace {

using Eigen::Vector3d;
using Kind = MoveSetting::Kind;

constexpr double kFarthest_m = 1e4;  // largest absolute coordinate of a point

const MoveSetting kTarget = {
    "target",
    Kind::Object,
    {0, 0, "NAME", "Object to look at, by name or class; otherwise the middle of a room"}};
const MoveSetting kCenter = {
    "center",
    Kind::Point,
    {0, 0, "X;Y;Z", "Point to look at instead of an object; otherwise in the largest room"}};
const MoveSetting kRadius = {"radius",
                             Kind::Number,
                             {0.1, 1000, "m",
                              "Distance from what it looks at, smaller where obstacles block it; "
                              "otherwise the object fills half of the image"},
                             1.5};
const MoveSetting kHeight = {"height",
                             Kind::Number,
                             {0.01, 1000, "m",
                              "Height above the floor, changed where obstacles block it; "
                              "otherwise a little above the object's middle"},
                             1.5};
const MoveSetting kTime = {
    "time", Kind::Number, {0.1, 1e5, "s", "Duration; otherwise as fast as the limits allow"}, 10.0};
const MoveSetting kFrom = {
    "from", Kind::Point, {0, 0, "X;Y;Z", "Where it begins; otherwise chosen in free space"}};
const MoveSetting kTo = {
    "to", Kind::Point, {0, 0, "X;Y;Z", "Where it ends; otherwise chosen in free space"}};

MoveSetting arcOf(double usual_deg) {
    return {"arc",
            Kind::Number,
            {1, 360, "\u00b0", "Angle around what it looks at, less where obstacles block it"},
            usual_deg};
}

const std::array<MoveKind, 5>& kinds() {
    static const std::array<MoveKind, 5> kKinds = {{
        {"orbit",
         "around an object or the middle of a room, as far as there is room",
         {kTarget, kCenter, kRadius, kHeight, arcOf(360.0), kTime}},
        {"arc", "a quarter of an orbit", {kTarget, kCenter, kRadius, kHeight, arcOf(90.0), kTime}},
        {"dolly",
         "straight towards an object, or between two points",
         {kTarget,
          kCenter,
          {"distance",
           Kind::Number,
           {0.05, 1000, "m", "Length; otherwise until the object fills half of the image"},
           1.0},
          kFrom,
          kTo,
          kTime}},
        {"crane",
         "straight up or down beside an object",
         {kTarget,
          kCenter,
          kRadius,
          {"from_height",
           Kind::Number,
           {0.01, 1000, "m", "Height above the floor where it begins"},
           0.5},
          {"to_height",
           Kind::Number,
           {0.01, 1000, "m", "Height above the floor where it ends"},
           2.0},
          kTime}},
        {"walk",
         "looking ahead, through the doorways of all rooms, across the only room, or between two "
         "points",
         {kFrom,
          kTo,
          {"height", Kind::Number, {0.01, 1000, "m", "Height above the floor"}, 1.5},
          kTime}},
    }};
    return kKinds;
}

}  // namespace

std::span<const MoveKind> moveKinds() {
    return kinds();
}

const MoveKind* findMoveKind(std::string_view name) {
    const auto found = std::ranges::find(kinds(), name, &MoveKind::name);
    return found == kinds().end() ? nullptr : &*found;
}

Result<MoveRequest> parseMove(const std::string& text) {
    MoveRequest request;
    const std::size_t colon = text.find(':');
    request.kind = text.substr(0, colon);
    const MoveKind* kind = findMoveKind(request.kind);
    if (!kind) {
        std::vector<std::string> names;
        for (const MoveKind& one : kinds()) names.emplace_back(one.name);
        return fail(ErrorCode::Usage, fmt::format("The kind of move '{}' is unknown{}",
                                                  request.kind, nameHint(request.kind, names)));
    }
    std::vector<std::string> names;
    for (const MoveSetting& one : kind->settings) names.emplace_back(one.name);
    std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string option = rest.substr(0, comma);
        rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
        const std::size_t equals = option.find('=');
        const std::string name = option.substr(0, equals);
        if (std::ranges::find(names, name) == names.end()) {
            return fail(ErrorCode::Usage, fmt::format("The option '{}' of {} is unknown{}", name,
                                                      kind->name, nameHint(name, names)));
        }
        if (equals == std::string::npos || equals + 1 == option.size()) {
            return fail(ErrorCode::Usage,
                        fmt::format("The option '{}' has no value; write {}=VALUE.", name, name));
        }
        request.options[name] = option.substr(equals + 1);
    }
    return request;
}

std::string moveText(const MoveRequest& request) {
    std::string text = request.kind;
    for (const auto& [name, value] : request.options) {
        text += (text.size() == request.kind.size() ? ":" : ",") + name + "=" + value;
    }
    return text;
}

double MoveValues::number(std::string_view name, double otherwise) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
}

std::optional<Vector3d> MoveValues::point(std::string_view name) const {
    const auto found = points.find(name);
    return found == points.end() ? std::nullopt : std::optional(found->second);
}

Result<MoveValues> readMove(const MoveRequest& request) {
    MoveValues values;
    const MoveKind* kind = findMoveKind(request.kind);
    if (!kind) return fail(ErrorCode::Usage, "The kind of move is unknown.", request.kind);
    for (const MoveSetting& setting : kind->settings) {
        const std::string name(setting.name);
        const auto given = request.options.find(name);
        if (given == request.options.end()) continue;
        const std::string& text = given->second;
        if (setting.kind == Kind::Point) {
            const auto point = readPoint(text);
            if (!point) {
                return fail(ErrorCode::Usage,
                            fmt::format("'{}' is not a point; write x;y;z in m.", text), name);
            }
            values.points[name] = *point;
        } else if (setting.kind == Kind::Number) {
            const auto value = readNumber(text);
            if (!value || *value < setting.info.min || *value > setting.info.max) {
                return fail(ErrorCode::Usage,
                            fmt::format("'{}' is not a number from {} to {} {}.", text,
                                        setting.info.min, setting.info.max, setting.info.unit),
                            name);
            }
            values.numbers[name] = *value;
        }
    }
    return values;
}

std::optional<double> readNumber(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

std::optional<Vector3d> readPoint(std::string_view text) {
    Vector3d point;
    for (int i = 0; i < 3; ++i) {
        const std::size_t cut = text.find(';');
        if ((cut == std::string_view::npos) != (i == 2)) return std::nullopt;
        const auto value = readNumber(text.substr(0, cut));
        if (!value || !(std::abs(*value) < kFarthest_m)) return std::nullopt;
        point[i] = *value;
        text = i < 2 ? text.substr(cut + 1) : std::string_view();
    }
    return point;
}

std::string optionText(double value) {
    return fmt::format("{}", std::round(1000.0 * value) / 1000.0);
}

std::string optionText(const Vector3d& point) {
    return optionText(point.x()) + ";" + optionText(point.y()) + ";" + optionText(point.z());
}

std::string settingLabel(std::string_view name) {
    if (name == "center") return "Centre";
    std::string label(name);
    std::ranges::replace(label, '_', ' ');
    if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') label[0] += 'A' - 'a';
    return label;
}

std::string moveHelp() {
    std::string help;
    for (const MoveKind& kind : kinds()) {
        help += fmt::format("{}: {}\n", kind.name, kind.text);
        for (const MoveSetting& setting : kind.settings) {
            const bool is_number = setting.kind == Kind::Number;
            const std::string usage = is_number
                                          ? fmt::format("{}={}", setting.name, setting.usual)
                                          : fmt::format("{}={}", setting.name, setting.info.unit);
            const std::string unit = is_number && !setting.info.unit.empty()
                                         ? fmt::format(" ({})", setting.info.unit)
                                         : "";
            help += fmt::format("  {:<18} {}{}\n", usage, setting.info.text, unit);
        }
    }
    return help;
}

}  // namespace dollytrack::planning
