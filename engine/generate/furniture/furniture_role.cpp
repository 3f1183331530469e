#include "engine/generate/furniture/furniture_role.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace dollytrack {
extern const char* const kFurnitureRoles;
}

namespace dollytrack::generate {
namespace {

constexpr std::array<std::string_view, kRoleCount> kNames = {
    "door",          "window",        "bed",
    "night_stand",   "wardrobe",      "dresser",
    "sofa",          "armchair",      "coffee_table",
    "tv_stand",      "television",    "bookcase",
    "cabinet",       "desk",          "office_chair",
    "dining_table",  "dining_chair",  "kitchen_base",
    "kitchen_tall",  "kitchen_upper", "floor_lamp",
    "ceiling_lamp",  "table_lamp",    "floor_plant",
    "wall_thing",    "floor_thing",   "work_floor_thing",
    "desk_thing",    "living_thing",  "kitchen_thing",
    "bedroom_thing", "shelf_thing"};

constexpr double kHigh = 60.0;    // cm: lowest elevation of hanging pieces, except sockets
constexpr double kStands = 20.0;  // cm: highest elevation of standing pieces; some are not at 0

std::vector<std::string_view> split(std::string_view text, char separator, std::size_t most) {
    std::vector<std::string_view> parts;
    while (parts.size() + 1 < most) {
        const auto at = text.find(separator);
        if (at == std::string_view::npos) break;
        parts.push_back(text.substr(0, at));
        text.remove_prefix(at + 1);
    }
    parts.push_back(text);
    return parts;
}

std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<RoleRule::Range> range(std::string_view text) {
    const auto ends = split(text, '-', 2);
    if (ends.size() != 2) return std::nullopt;
    const auto low = number(ends[0]);
    const auto high = number(ends[1]);
    if (!low || !high || *low > *high) return std::nullopt;
    return RoleRule::Range{*low, *high};
}

std::optional<RoleRule::Place> placeNamed(std::string_view name) {
    using enum RoleRule::Place;
    if (name == "floor") return Floor;
    if (name == "high") return High;
    if (name == "wall") return Wall;
    if (name == "any") return Any;
    return std::nullopt;
}

bool contains(const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

std::optional<RoleRule> parseRule(std::string_view line) {
    const auto fields = split(line, ',', 7);
    if (fields.size() != 7) return std::nullopt;
    const auto* name = std::find(kNames.begin(), kNames.end(), fields[0]);
    const auto place = placeNamed(fields[1]);
    const auto width = range(fields[3]);
    const auto depth = range(fields[4]);
    const auto height = range(fields[5]);
    if (name == kNames.end() || !place || !width || !depth || !height) return std::nullopt;
    RoleRule rule{static_cast<FurnitureRole>(name - kNames.begin()),
                  *place,
                  std::string(fields[2]),
                  *width,
                  *depth,
                  *height,
                  {},
                  {}};
    for (const std::string_view word : split(fields[6], ';', fields[6].size() + 1)) {
        if (word.starts_with('!')) {
            rule.without.emplace_back(word.substr(1));
        } else if (!word.empty()) {
            rule.names.emplace_back(word);
        }
    }
    return rule;
}

}  // namespace

std::string_view roleName(FurnitureRole role) {
    return kNames[static_cast<std::size_t>(role)];
}

bool RoleRule::admits(const CatalogPiece& piece) const {
    if (!contains(names, piece.name) || contains(without, piece.id)) return false;
    if (category.starts_with('-') ? piece.category == category.substr(1)
                                  : !category.empty() && piece.category != category) {
        return false;
    }
    if (!width.holds(piece.width) || !depth.holds(piece.depth) || !height.holds(piece.height)) {
        return false;
    }
    if ((place == Place::Wall) != piece.opening) return false;
    if (place == Place::High) return piece.elevation >= kHigh;
    return place != Place::Floor || piece.elevation <= kStands;
}

Result<std::vector<RoleRule>> parseRoles(std::string_view csv, const std::string& where) {
    std::vector<RoleRule> rules;
    int line_number = 0;
    for (std::string_view line : split(csv, '\n', csv.size() + 1)) {
        ++line_number;
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.empty() || line.front() == '#') continue;
        auto rule = parseRule(line);
        if (!rule) {
            return fail(ErrorCode::BadInput,
                        "a line must be role,place,category,width,depth,height,names with sizes "
                        "like 40-180, and a known role and place",
                        where + ":" + std::to_string(line_number));
        }
        rules.push_back(std::move(*rule));
    }
    return rules;
}

const std::vector<RoleRule>& builtInRoles() {
    static const std::vector<RoleRule> rules =
        parseRoles(kFurnitureRoles, "assets/furniture/roles.csv").value();
    return rules;
}

}  // namespace dollytrack::generate
