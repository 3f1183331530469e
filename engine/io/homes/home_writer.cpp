#include "engine/io/homes/home_writer.h"

#include "engine/scene/srgb.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dollytrack::homes {
namespace {

/// The shortest text that parses to the same number, independent of the locale.
void setNumber(pugi::xml_node node, const char* name, double value) {
    node.append_attribute(name) = fmt::format("{}", value).c_str();
}

void setText(pugi::xml_node node, const char* name, const std::string& value) {
    if (!value.empty()) node.append_attribute(name) = value.c_str();
}

int toSrgb(float linear) {
    return static_cast<int>(std::lround(255.0F * srgbFromLinear(std::clamp(linear, 0.0F, 1.0F))));
}

void setSurface(pugi::xml_node node, const HomeSurface& surface, const char* color,
                const char* texture) {
    if (surface.color) {
        const Eigen::Vector3f& c = *surface.color;
        setText(node, color,
                fmt::format("FF{:02X}{:02X}{:02X}", toSrgb(c.x()), toSrgb(c.y()), toSrgb(c.z())));
    }
    if (!surface.texture) return;
    pugi::xml_node picture = node.append_child("texture");
    picture.append_attribute("attribute") = texture;
    setText(picture, "name", surface.texture->image);
    setNumber(picture, "width", surface.texture->width_cm);
    setNumber(picture, "height", surface.texture->height_cm);
    setText(picture, "image", surface.texture->image);
}

void addWall(pugi::xml_node root, const HomeWall& wall, std::size_t index) {
    pugi::xml_node node = root.append_child("wall");
    setText(node, "id", fmt::format("wall{}", index));
    if (wall.at_start >= 0) setText(node, "wallAtStart", fmt::format("wall{}", wall.at_start));
    if (wall.at_end >= 0) setText(node, "wallAtEnd", fmt::format("wall{}", wall.at_end));
    setNumber(node, "xStart", wall.start.x());
    setNumber(node, "yStart", wall.start.y());
    setNumber(node, "xEnd", wall.end.x());
    setNumber(node, "yEnd", wall.end.y());
    setNumber(node, "height", wall.height);
    if (wall.height_at_end != wall.height) setNumber(node, "heightAtEnd", wall.height_at_end);
    setNumber(node, "thickness", wall.thickness);
    if (wall.arc_extent != 0.0) setNumber(node, "arcExtent", wall.arc_extent);
    setSurface(node, wall.left, "leftSideColor", "leftSideTexture");
    setSurface(node, wall.right, "rightSideColor", "rightSideTexture");
}

void addRoom(pugi::xml_node root, const HomeRoom& room) {
    pugi::xml_node node = root.append_child("room");
    setText(node, "name", room.name);
    if (!room.floor_visible) setText(node, "floorVisible", "false");
    if (!room.ceiling_visible) setText(node, "ceilingVisible", "false");
    setSurface(node, room.floor, "floorColor", "floorTexture");
    setSurface(node, room.ceiling, "ceilingColor", "ceilingTexture");
    for (const Eigen::Vector2d& point : room.points) {
        pugi::xml_node corner = node.append_child("point");
        setNumber(corner, "x", point.x());
        setNumber(corner, "y", point.y());
    }
}

const char* elementOf(PieceKind kind) {
    switch (kind) {
        case PieceKind::Light:
            return "light";
        case PieceKind::Opening:
            return "doorOrWindow";
        case PieceKind::Furniture:
            break;
    }
    return "pieceOfFurniture";
}

void addPiece(pugi::xml_node root, const HomePiece& piece) {
    pugi::xml_node node = root.append_child(elementOf(piece.kind));
    setText(node, "catalogId", piece.catalog_id);
    setText(node, "name", piece.name);
    setText(node, "model", piece.model);
    setNumber(node, "x", piece.position.x());
    setNumber(node, "y", piece.position.y());
    if (piece.elevation != 0.0) setNumber(node, "elevation", piece.elevation);
    if (piece.angle != 0.0) setNumber(node, "angle", piece.angle);
    setNumber(node, "width", piece.width);
    setNumber(node, "depth", piece.depth);
    setNumber(node, "height", piece.height);
    if (piece.mirrored) setText(node, "modelMirrored", "true");
    if (piece.model_rotation) {
        std::string text;
        for (int i = 0; i < 9; ++i) {
            text += fmt::format("{}{}", i == 0 ? "" : " ", (*piece.model_rotation)(i / 3, i % 3));
        }
        setText(node, "modelRotation", text);
    }
    setText(node, "cutOutShape", piece.wall_cut_out);
    setSurface(node, piece.surface, "color", "");
}

}  // namespace

std::string homeXml(const Home& home, const std::string& name) {
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    pugi::xml_node root = document.append_child("home");
    root.append_attribute("version") = "7000";
    setText(root, "name", name);
    setNumber(root, "wallHeight", home.wall_height);
    for (const HomePiece& piece : home.pieces) addPiece(root, piece);
    for (std::size_t i = 0; i < home.walls.size(); ++i) addWall(root, home.walls[i], i);
    for (const HomeRoom& room : home.rooms) addRoom(root, room);
    std::ostringstream text;
    document.save(text, "  ");
    return std::move(text).str();
}

}  // namespace dollytrack::homes
