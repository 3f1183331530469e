#include "engine/generate/room_truth.h"

#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace dollytrack::generate {
namespace {

/// Rounds to a hundredth of a millimetre, so that the text does not depend on rounding errors.
double rounded(double value) {
    const double result = std::round(value * 1e5) / 1e5;
    return result == 0.0 ? 0.0 : result;
}

int classOf(const PlacedPiece& placed) {
    if (placed.role == FurnitureRole::Door) return kNyuDoor;
    if (placed.role == FurnitureRole::Window) return kNyuWindow;
    const LabelTable& labels = LabelTable::builtIn();
    const Label by_name = labels.find(placed.piece->name);
    if (by_name.kind != LabelKind::None) return by_name.nyu40;
    return labels.find(placed.piece->id.substr(placed.piece->id.rfind('#') + 1)).nyu40;
}

std::string heldBy(const PlacedPiece& placed, const std::vector<std::string>& names) {
    switch (placed.support) {
        case PlacedPiece::Support::Piece:
            return names[placed.supporter];
        case PlacedPiece::Support::Wall:
        case PlacedPiece::Support::Opening:
            return "wall";
        case PlacedPiece::Support::Ceiling:
            return "ceiling";
        case PlacedPiece::Support::Floor:
            break;
    }
    return "floor";
}

}  // namespace

std::vector<std::string> namesOf(const RoomLayout& layout) {
    std::map<std::string, int> used;
    std::vector<std::string> names;
    for (const PlacedPiece& placed : layout.pieces()) {
        names.push_back(placed.piece->name + " " + std::to_string(++used[placed.piece->name]));
    }
    return names;
}

nlohmann::ordered_json truthOf(const RoomLayout& layout, const std::vector<std::string>& names) {
    nlohmann::ordered_json objects = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const PlacedPiece& placed = layout.pieces()[i];
        const CatalogPiece& piece = *placed.piece;
        const int nyu40 = classOf(placed);
        const Eigen::Vector2d front = forwardAt(placed.angle);
        const double middle = placed.elevation + 0.5 * piece.height;
        // The plan's y points down the page, so y and the sign of angles change.
        objects.push_back(
            {{"name", names[i]},
             {"class", nyu40 == 0 ? "unknown" : std::string(nyu40Name(nyu40))},
             {"structure", placed.support == PlacedPiece::Support::Opening},
             {"center_m",
              {rounded(0.01 * placed.at.x()), rounded(-0.01 * placed.at.y()),
               rounded(0.01 * middle)}},
             {"size_m",
              {rounded(0.01 * piece.width), rounded(0.01 * piece.depth),
               rounded(0.01 * piece.height)}},
             {"yaw_deg", rounded(-std::remainder(placed.angle, 2.0 * std::numbers::pi) * 180.0 /
                                 std::numbers::pi)},
             {"front", {rounded(front.x()), rounded(-front.y()), 0.0}},
             {"supporter", heldBy(placed, names)},
             {"role", roleName(placed.role)},
             {"model", piece.id}});
    }
    return objects;
}

std::string licensesOf(const RoomLayout& layout, const FurnitureCatalog& catalog) {
    std::set<std::string> lines;
    std::set<std::string> libraries;
    for (const PlacedPiece& placed : layout.pieces()) {
        const CatalogPiece& piece = *placed.piece;
        const std::string author = piece.creator.empty() ? "an unnamed author" : piece.creator;
        lines.insert(piece.id + ": \"" + piece.name + "\" by " + author + "; " + piece.license +
                     " (" + piece.library + ")");
        libraries.insert(piece.library);
    }
    std::string text = "The models in this room, with their authors and licences:\n\n";
    for (const std::string& line : lines) text += line + "\n";
    for (const LibraryNotice& notice : catalog.notices()) {
        if (!libraries.contains(notice.library)) continue;
        text += "\n" + notice.library + " says:\n\n" + notice.text + "\n";
    }
    return text;
}

}  // namespace dollytrack::generate
