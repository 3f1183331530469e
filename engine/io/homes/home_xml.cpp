#include "engine/io/homes/home_xml.h"

#include "engine/core/clean_text.h"
#include "engine/io/homes/xml_attributes.h"

#include <cstring>
#include <map>

namespace dollytrack::homes {
namespace {

constexpr std::size_t kMostElements = 200'000;
constexpr int kDeepestGroup = 32;

/// Reads the elements in order and stops at the first error.
class HomeParser {
  public:
    explicit HomeParser(std::string where) : where_(std::move(where)) {}

    Result<Home> parse(const pugi::xml_node& root) {
        XmlAttributes attributes(root, where_);
        home_.wall_height = attributes.size("wallHeight", 250.0);
        keep(attributes);
        for (const pugi::xml_node& node : root.children("level")) readLevel(node);
        std::size_t walls = 0;
        for (const pugi::xml_node& node : root.children("wall")) {
            wall_ids_.try_emplace(node.attribute("id").value(), walls++);
        }
        for (const pugi::xml_node& node : root.children()) {
            if (error_) break;
            const std::string_view name = node.name();
            if (name == "wall") readWall(node);
            if (name == "room") readRoom(node);
            if (name == "observerCamera" || name == "camera") readCamera(node);
            readPiece(node, -1, 0);
        }
        if (error_) return tl::unexpected(*error_);
        dropHidden();
        return std::move(home_);
    }

  private:
    void keep(const XmlAttributes& attributes) {
        if (!error_ && attributes.error()) error_ = attributes.error();
    }

    /// Counts an element, to limit the memory that a malicious file can use.
    void count() {
        if (++elements_ <= kMostElements || error_) return;
        error_ = Error{ErrorCode::BadInput, "the home has more than 200,000 parts", where_};
    }

    void readLevel(const pugi::xml_node& node) {
        XmlAttributes attributes(node, where_);
        HomeLevel level;
        level.elevation = attributes.needed("elevation");
        level.floor_thickness = std::max(0.0, attributes.number("floorThickness", 12.0));
        level.height = attributes.size("height", 250.0);
        level.viewable = attributes.flag("viewable", true);
        level_ids_.try_emplace(node.attribute("id").value(), static_cast<int>(home_.levels.size()));
        home_.levels.push_back(level);
        keep(attributes);
    }

    [[nodiscard]] int levelOf(const pugi::xml_node& node, int otherwise) const {
        const auto found = level_ids_.find(node.attribute("level").value());
        return found == level_ids_.end() ? otherwise : found->second;
    }

    [[nodiscard]] int wallNamed(const pugi::xml_node& node, const char* attribute) const {
        const auto found = wall_ids_.find(node.attribute(attribute).value());
        if (!node.attribute(attribute) || found == wall_ids_.end()) return -1;
        return static_cast<int>(found->second);
    }

    HomeSurface surfaceOf(const pugi::xml_node& node, const char* color, const char* texture) {
        XmlAttributes attributes(node, where_);
        HomeSurface surface;
        surface.color = attributes.color(color);
        keep(attributes);
        for (const pugi::xml_node& child : node.children("texture")) {
            const std::string_view which = child.attribute("attribute").value();
            if (!which.empty() && which != texture) continue;
            XmlAttributes picture(child, where_);
            HomeTexture read;
            read.image = child.attribute("image").value();
            const double scale = picture.size("scale", 1.0);
            read.width_cm = scale * picture.size("width", 100.0);
            read.height_cm = scale * picture.size("height", 100.0);
            keep(picture);
            surface.texture = read;
        }
        return surface;
    }

    void readWall(const pugi::xml_node& node) {
        XmlAttributes attributes(node, where_);
        HomeWall wall;
        wall.start = {attributes.needed("xStart"), attributes.needed("yStart")};
        wall.end = {attributes.needed("xEnd"), attributes.needed("yEnd")};
        wall.thickness = attributes.size("thickness", 7.5);
        wall.height = attributes.size("height", home_.wall_height);
        wall.height_at_end = attributes.size("heightAtEnd", wall.height);
        wall.arc_extent = attributes.number("arcExtent", 0.0);
        wall.at_start = wallNamed(node, "wallAtStart");
        wall.at_end = wallNamed(node, "wallAtEnd");
        wall.level = levelOf(node, -1);
        wall.left = surfaceOf(node, "leftSideColor", "leftSideTexture");
        wall.right = surfaceOf(node, "rightSideColor", "rightSideTexture");
        wall.top.color = attributes.color("topColor");
        for (const pugi::xml_node& child : node.children("baseboard")) {
            XmlAttributes board(child, where_);
            HomeBaseboard baseboard;
            baseboard.thickness = board.size("thickness", 1.0);
            baseboard.height = board.size("height", 7.0);
            baseboard.surface = surfaceOf(child, "color", "");
            keep(board);
            const bool left =
                !std::strcmp(child.attribute("attribute").value(), "leftSideBaseboard");
            (left ? wall.left_baseboard : wall.right_baseboard) = baseboard;
        }
        keep(attributes);
        count();
        home_.walls.push_back(std::move(wall));
    }

    void readRoom(const pugi::xml_node& node) {
        XmlAttributes attributes(node, where_);
        HomeRoom room;
        room.name = attributes.text("name");
        room.floor_visible = attributes.flag("floorVisible", true);
        room.ceiling_visible = attributes.flag("ceilingVisible", true);
        room.level = levelOf(node, -1);
        room.floor = surfaceOf(node, "floorColor", "floorTexture");
        room.ceiling = surfaceOf(node, "ceilingColor", "ceilingTexture");
        keep(attributes);
        for (const pugi::xml_node& child : node.children("point")) {
            XmlAttributes point(child, where_);
            room.points.emplace_back(point.needed("x"), point.needed("y"));
            keep(point);
            count();
            if (error_) return;
        }
        count();
        home_.rooms.push_back(std::move(room));
    }

    void readCamera(const pugi::xml_node& node) {
        const std::string_view which = node.attribute("attribute").value();
        XmlAttributes attributes(node, where_);
        HomeCamera camera;
        if (which == "observerCamera") {
            camera.kind = CameraKind::Visitor;
        } else if (which == "cameraPath") {
            camera.kind = CameraKind::Path;
        } else if (which != "storedCamera") {
            return;  // the view from above is not a camera inside the rooms
        }
        camera.name = attributes.text("name");
        camera.position = {attributes.needed("x"), attributes.needed("y")};
        camera.height = attributes.needed("z");
        camera.yaw = attributes.number("yaw", 0.0);
        camera.pitch = attributes.number("pitch", 0.0);
        camera.field_of_view = attributes.number("fieldOfView", 1.0995575);
        keep(attributes);
        count();
        home_.cameras.push_back(std::move(camera));
    }

    /// Reads groups recursively, to a limited depth.
    void readPiece(const pugi::xml_node& node, int level, int depth) {
        const std::string_view kind = node.name();
        const bool group = kind == "furnitureGroup";
        if (!group && kind != "pieceOfFurniture" && kind != "doorOrWindow" && kind != "light" &&
            kind != "shelfUnit") {
            return;
        }
        if (depth > kDeepestGroup) {
            error_ = Error{ErrorCode::BadInput, "groups of furniture are nested too deep", where_};
        }
        if (error_) return;
        if (std::string_view(node.attribute("visible").value()) == "false") {
            ++home_.hidden;
            return;
        }
        level = levelOf(node, level);
        if (group) {
            for (const pugi::xml_node& child : node.children()) readPiece(child, level, depth + 1);
            return;
        }
        XmlAttributes attributes(node, where_);
        HomePiece piece;
        if (kind == "light") piece.kind = PieceKind::Light;
        if (kind == "doorOrWindow") piece.kind = PieceKind::Opening;
        piece.name = attributes.text("name");
        piece.catalog_id = attributes.text("catalogId");
        piece.model = node.attribute("model").value();
        piece.position = {attributes.needed("x"), attributes.needed("y")};
        piece.elevation = attributes.number("elevation", 0.0);
        piece.angle = attributes.number("angle", 0.0);
        piece.pitch = attributes.number("pitch", 0.0);
        piece.roll = attributes.number("roll", 0.0);
        piece.width = attributes.size("width", 1.0);
        piece.depth = attributes.size("depth", 1.0);
        piece.height = attributes.size("height", 1.0);
        piece.mirrored = attributes.flag("modelMirrored", false);
        piece.centered_at_origin = attributes.flag("modelCenteredAtOrigin", true);
        piece.model_rotation = attributes.matrix("modelRotation");
        piece.level = level;
        piece.surface = surfaceOf(node, "color", "");
        if (piece.kind == PieceKind::Opening) {
            piece.wall_cut_out = node.attribute("cutOutShape").value();
            if (piece.wall_cut_out.empty()) piece.wall_cut_out = "M0,0 v1 h1 v-1 z";
        }
        piece.floor_cut_out = node.attribute("staircaseCutOutShape").value();
        keep(attributes);
        for (const pugi::xml_node& child : node.children("material")) {
            piece.materials[cleanText(child.attribute("name").value())] =
                surfaceOf(child, "color", "");
        }
        count();
        home_.pieces.push_back(std::move(piece));
    }

    /// Removes what is on hidden levels. Walls keep their indices, which other walls refer to, but
    /// lose their size.
    void dropHidden() {
        const auto hidden = [&](int level) { return level >= 0 && !home_.levels[level].viewable; };
        home_.hidden += std::erase_if(home_.pieces, [&](const auto& p) { return hidden(p.level); });
        home_.hidden += std::erase_if(home_.rooms, [&](const auto& r) { return hidden(r.level); });
        for (HomeWall& wall : home_.walls) {
            if (!hidden(wall.level)) continue;
            wall.end = wall.start;
            ++home_.hidden;
        }
    }

    std::string where_;
    std::size_t elements_ = 0;
    Home home_;
    std::map<std::string, std::size_t> wall_ids_;
    std::map<std::string, int> level_ids_;
    std::optional<Error> error_;
};

}  // namespace

Result<Home> parseHomeXml(std::string_view text, const std::string& where) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype);
    if (!parsed) {
        return fail(ErrorCode::BadInput,
                    std::string("it is not complete XML (") + parsed.description() + " at byte " +
                        std::to_string(parsed.offset) + "); save the home again",
                    where);
    }
    for (const pugi::xml_node& node : document.children()) {
        if (node.type() != pugi::node_doctype) continue;
        return fail(
            ErrorCode::BadInput,
            "the XML declares a document type, which is not supported; remove the <!DOCTYPE>",
            where);
    }
    const pugi::xml_node root = document.document_element();
    if (std::strcmp(root.name(), "home") != 0) {
        return fail(ErrorCode::BadInput,
                    "the XML is not a home of Sweet Home 3D: its root element is <" +
                        cleanText(root.name()) + ">, not <home>",
                    where);
    }
    return HomeParser(where).parse(root);
}

}  // namespace dollytrack::homes
