#include "engine/io/assimp/collada_asset.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace dollytrack {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

void skipSpace(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
}

/// The number in `="0.01"`, the text after an attribute's name; 0 if there is none. Independent of
/// the locale.
double valueAfterName(std::string_view text) {
    skipSpace(text);
    if (!text.starts_with('=')) return 0.0;
    text.remove_prefix(1);
    skipSpace(text);
    if (!text.starts_with('"') && !text.starts_with('\'')) return 0.0;
    text.remove_prefix(1);
    skipSpace(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && std::isfinite(value) && value > 0.0 ? value : 0.0;
}

/// The value of the attribute `meter`; the values `name="meter"` and `name="centimeter"` do not
/// match.
double meterOf(std::string_view tag) {
    constexpr std::string_view kName = "meter";
    for (auto at = tag.find(kName); at != std::string_view::npos; at = tag.find(kName, at + 1)) {
        const bool whole = at > 0 && kSpace.find(tag[at - 1]) != std::string_view::npos;
        if (!whole) continue;
        const double value = valueAfterName(tag.substr(at + kName.size()));
        if (value > 0.0) return value;
    }
    return 0.0;
}

}  // namespace

ColladaAsset parseColladaAsset(std::string_view head) {
    ColladaAsset asset;
    if (const auto up = head.find("<up_axis>"); up != std::string_view::npos) {
        const auto letter = head.substr(up, 24).find_first_of("XYZ");
        if (letter != std::string_view::npos) {
            asset.up_axis = "xyz"[head[up + letter] - 'X'];
        }
    }
    if (const auto tool = head.find("<authoring_tool>"); tool != std::string_view::npos) {
        const std::string_view name = head.substr(tool, head.find('<', tool + 1) - tool);
        asset.by_sketchup = name.find("SketchUp") != std::string_view::npos;
    }
    if (const auto unit = head.find("<unit"); unit != std::string_view::npos) {
        const auto length = head.substr(unit).find('>');
        if (length != std::string_view::npos) {
            const double meter = meterOf(head.substr(unit, length));
            if (meter > 0.0) asset.unit_m = meter;
        }
    }
    return asset;
}

}  // namespace dollytrack
