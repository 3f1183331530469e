#include "engine/io/gazebo/sdf_material.h"

#include "engine/io/gazebo/link_xml.h"
#include "engine/scene/srgb.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace dollytrack::gazebo {
namespace {

/// The linear colour of one of Gazebo's materials; nullopt for an unknown name. The table is sRGB.
std::optional<Eigen::Vector4f> namedColor(std::string_view name) {
    struct Row {
        std::string_view name;
        std::array<float, 3> color;
    };
    static constexpr std::array<Row, 17> kRows = {{{"Gazebo/Grey", {0.7F, 0.7F, 0.7F}},
                                                   {"Gazebo/Gray", {0.7F, 0.7F, 0.7F}},
                                                   {"Gazebo/DarkGrey", {0.175F, 0.175F, 0.175F}},
                                                   {"Gazebo/DarkGray", {0.175F, 0.175F, 0.175F}},
                                                   {"Gazebo/White", {1, 1, 1}},
                                                   {"Gazebo/FlatBlack", {0.1F, 0.1F, 0.1F}},
                                                   {"Gazebo/Black", {0, 0, 0}},
                                                   {"Gazebo/Red", {1, 0, 0}},
                                                   {"Gazebo/Green", {0, 1, 0}},
                                                   {"Gazebo/Blue", {0, 0, 1}},
                                                   {"Gazebo/Yellow", {1, 1, 0}},
                                                   {"Gazebo/Orange", {1, 0.5088F, 0.0468F}},
                                                   {"Gazebo/Purple", {1, 0, 1}},
                                                   {"Gazebo/Turquoise", {0, 1, 1}},
                                                   {"Gazebo/Wood", {0.6F, 0.45F, 0.3F}},
                                                   {"Gazebo/Bricks", {0.55F, 0.3F, 0.25F}},
                                                   {"Gazebo/Residential", {0.8F, 0.8F, 0.78F}}}};
    for (const Row& row : kRows) {
        if (name != row.name) continue;
        return Eigen::Vector4f(linearFromSrgb(row.color[0]), linearFromSrgb(row.color[1]),
                               linearFromSrgb(row.color[2]), 1.0F);
    }
    return std::nullopt;
}

}  // namespace

std::optional<Eigen::Vector4f> visualColor(const pugi::xml_node& visual) {
    const pugi::xml_node material = visual.child("material");
    std::optional<Eigen::Vector4f> color = colorOf(material.child_value("diffuse"));
    if (!color) color = namedColor(textOf(material.child("script").child("name")));
    if (!color) color = colorOf(material.child_value("ambient"));
    return color;
}

std::string scriptName(const pugi::xml_node& visual) {
    std::string name = textOf(visual.child("material").child("script").child("name"));
    return namedColor(name) ? std::string() : name;
}

float visualOpacity(const pugi::xml_node& visual) {
    const auto hidden = numbersOf(visual.child_value("transparency"));
    if (!hidden || hidden->size() != 1) return 1.0F;
    return static_cast<float>(1.0 - std::clamp(hidden->front(), 0.0, 1.0));
}

}  // namespace dollytrack::gazebo
