#include "planning/free_space/opening_summary.h"

#include <fmt/format.h>

#include <map>

namespace dollytrack::planning {
namespace {

struct AlikeOpenings {
    const Opening* largest = nullptr;
    int count = 0;
    double area_m2 = 0.0;
};

/// describe() without the measures in its last bracket: "Room 1 is open towards its +x side".
std::string whatIsOpen(const Opening& opening) {
    const std::string text = describe(opening);
    return text.substr(0, text.rfind(" ("));
}

std::string describeAlike(const std::string& what, const AlikeOpenings& alike) {
    if (alike.count == 1) return describe(*alike.largest);
    const Eigen::Vector3d& at = alike.largest->center_in_world;
    return fmt::format(
        "{} at {} openings ({:.1f} m2 in total; the largest has {:.1f} m2 around {:.1f}, {:.1f}, "
        "{:.1f})",
        what, alike.count, alike.area_m2, alike.largest->area_m2, at.x(), at.y(), at.z());
}

}  // namespace

std::vector<std::string> describeAll(const OpeningReport& report) {
    std::vector<std::string> order;
    std::map<std::string, AlikeOpenings> by_text;
    for (const Opening& opening : report.openings) {
        const std::string what = whatIsOpen(opening);
        AlikeOpenings& alike = by_text[what];
        if (alike.count++ == 0) order.push_back(what);
        if (alike.largest == nullptr || opening.area_m2 > alike.largest->area_m2) {
            alike.largest = &opening;
        }
        alike.area_m2 += opening.area_m2;
    }
    std::vector<std::string> lines;
    for (const std::string& what : order) lines.push_back(describeAlike(what, by_text[what]));
    return lines;
}

}  // namespace dollytrack::planning
