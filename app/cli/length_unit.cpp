#include "app/cli/length_unit.h"

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>

namespace dollytrack::cli {
namespace {

// The international foot is 0.3048 m exactly.
constexpr std::array<std::pair<std::string_view, const char*>, 12> kUnits = {{{"m", "1"},
                                                                              {"dm", "0.1"},
                                                                              {"cm", "0.01"},
                                                                              {"mm", "0.001"},
                                                                              {"km", "1000"},
                                                                              {"in", "0.0254"},
                                                                              {"inch", "0.0254"},
                                                                              {"inches", "0.0254"},
                                                                              {"ft", "0.3048"},
                                                                              {"foot", "0.3048"},
                                                                              {"feet", "0.3048"},
                                                                              {"yd", "0.9144"}}};

/// Replaces a unit's name by its number; returns an error message, or an empty text.
std::string asMetres(std::string& text) {
    for (const auto& [name, metres] : kUnits) {
        if (text != name) continue;
        text = metres;
        return {};
    }
    double number = 0.0;
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    if (error == std::errc() && end == last && number >= 1e-6 && number <= 1e6) return {};
    return "'" + text +
           "' is not a unit: give metres per unit from 1e-6 to 1e6, like 0.001, or m, cm, mm, inch "
           "or ft";
}

}  // namespace

CLI::Validator lengthUnit() {
    return CLI::Validator(asMetres, "", "length unit");
}

}  // namespace dollytrack::cli
