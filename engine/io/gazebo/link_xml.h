#pragma once

#include "engine/core/result.h"
#include "engine/io/gazebo/visuals.h"

#include <Eigen/Geometry>
#include <pugixml.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gazebo {

/// Visuals that one file may have.
inline constexpr std::size_t kMostVisuals = 100'000;

/// XML of all files of one scene together, in bytes.
constexpr std::uint64_t kMostXmlBytes = std::uint64_t{64} << 20U;

/// An XML file and its size.
struct XmlFile {
    pugi::xml_document document;
    std::uint64_t bytes = 0;
    std::vector<std::size_t> line_ends;  // places of the line feeds in the file

    /// "room.world:12": where an element stands, of the file at `path`.
    [[nodiscard]] std::string placeOf(const std::filesystem::path& path,
                                      const pugi::xml_node& element) const;
};

/// Reads an XML file of at most `most` bytes. Errors: BadInput, with the place: damaged, too large,
/// or not expanded by xacro.
[[nodiscard]] Result<XmlFile> readXml(const std::filesystem::path& path, std::uint64_t most);

/// The text of an element without the blanks around it.
[[nodiscard]] std::string textOf(const pugi::xml_node& node);

/// The finite numbers of a text, separated by blanks; nothing where it holds anything else. Numbers
/// too small for a double are 0.
[[nodiscard]] std::optional<std::vector<double>> numbersOf(std::string_view text);

/// Three numbers; nothing where the text holds others.
[[nodiscard]] std::optional<Eigen::Vector3d> vectorOf(std::string_view text);

/// Rotation about the fixed axes x, y and z, in this order; radians.
[[nodiscard]] Eigen::Quaterniond rotationFromRollPitchYaw(const Eigen::Vector3d& roll_pitch_yaw);

/// Whether a link's name says nothing of what it is: "link", "link_3", "base_link", "body".
[[nodiscard]] bool isPlainLinkName(std::string_view name);

/// Counts the shape of a <geometry> that is not read, as <heightmap> or <capsule>, by its element.
void noteUnknownShape(const pugi::xml_node& geometry, UnknownShapes& shapes);

/// A linear colour from three or four sRGB numbers of 0 to 1, the fourth of which is the opacity;
/// nothing where the text is no colour.
[[nodiscard]] std::optional<Eigen::Vector4f> colorOf(std::string_view text);

}  // namespace dollytrack::gazebo
