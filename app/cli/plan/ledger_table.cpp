#include "app/cli/plan/ledger_table.h"

#include "app/cli/terminal/terminal_text.h"
#include "engine/scene/scene_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::cli {
namespace {

constexpr std::size_t kNumbers = 58;  // columns of everything except the object's name
constexpr std::size_t kLeastName = 12;
constexpr std::size_t kMostName = 34;
constexpr std::size_t kLeastWidth = 40;  // below this, wrapping is left to the terminal
constexpr std::size_t kIndent = 8;

/// Sort key: 0: not captured, 1: captured but not well, 2: well captured.
int standing(const LedgerRow& row) {
    return row.well_captured ? 2 : row.captured ? 1 : 0;
}

std::string numbers(const LedgerRow& row) {
    if (row.frame < 0) return "never seen";
    return fmt::format("{:>5}{} {:>5.0f} % {:>5.1f} % {:>5.2f} m", row.frame,
                       row.key_frame ? '*' : ' ', 100.0 * row.visible_fraction,
                       100.0 * row.box_share, row.distance_m);
}

}  // namespace

std::string ledgerTable(const Scene& scene, std::vector<LedgerRow> ledger, std::size_t width) {
    std::stable_sort(ledger.begin(), ledger.end(), [](const LedgerRow& a, const LedgerRow& b) {
        return standing(a) < standing(b);
    });
    if (width > 0) width = std::max(width, kLeastWidth);
    std::size_t name_width = kLeastName;
    for (const LedgerRow& row : ledger) {
        name_width = std::max(name_width, scene.object(row.object_id).name.size());
    }
    if (width > 0) {
        const std::size_t room = width - std::min(width, kNumbers);
        name_width = std::clamp(std::min(name_width, room), kLeastName, kMostName);
    }
    constexpr const char* kStandings[] = {"not captured", "not well", "well"};
    std::string text =
        fmt::format("  {} {} {} {:>6} {:>7} {:>7} {:>7}\n", inColumn("object", name_width),
                    inColumn("class", 12), inColumn("", 12), "frame", "visible", "box", "away");
    for (const LedgerRow& row : ledger) {
        const Object& object = scene.object(row.object_id);
        text += fmt::format("  {} {} {} {}\n", inColumn(object.name, name_width),
                            inColumn(className(object), 12),
                            inColumn(kStandings[standing(row)], 12), numbers(row));
        if (!row.loss) continue;
        text += wrapped(row.reason, width, kIndent, "    why");
        if (row.remedy) text += wrapped(row.remedy->text, width, kIndent, "    fix");
    }
    text += "  *: a key frame\n";
    const bool pins = std::ranges::any_of(
        ledger, [](const LedgerRow& row) { return row.remedy && row.remedy->pin.has_value(); });
    if (pins) {
        text +=
            "  to pin a point: dollytrack edit PROJECT --plan --op '{\"op\":\"pin\","
            "\"objects\":[\"NAME\"],\"position\":[x,y,z],\"yaw_deg\":A,\"pitch_deg\":B}'; "
            "--json lists each fix as such operations\n";
    }
    return text;
}

}  // namespace dollytrack::cli
