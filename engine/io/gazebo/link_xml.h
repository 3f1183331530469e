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

/// Largest number of visuals in a scene.
inline constexpr std::size_t kMostVisuals = 100'000;

/// Largest amount of XML in all files of a scene together, in bytes.
constexpr std::uint64_t kMostXmlBytes = std::uint64_t{64} << 20U;

/// An XML file, its size in bytes, and its line ends, which tell the line of an element.
struct XmlFile {
    pugi::xml_document document;
    std::uint64_t bytes = 0;
    std::optional<std::vector<std::size_t>>
        line_ends;  // offsets of line feeds; of UTF-8 files only

    /// The position of an element as file and line ("room.world:12"); `path` is the file.
    [[nodiscard]] std::string placeOf(const std::filesystem::path& path,
                                      const pugi::xml_node& element) const;
};

/// Reads an XML file of at most `most` bytes. Error: BadInput, for a file that is damaged, too
/// large, or contains xacro macros.
[[nodiscard]] Result<XmlFile> readXml(const std::filesystem::path& path, std::uint64_t most);

/// Parses XML from memory. Errors name `path`.
[[nodiscard]] Result<XmlFile> parseXml(std::string_view text, const std::filesystem::path& path);

/// The text of an element without surrounding blanks.
[[nodiscard]] std::string textOf(const pugi::xml_node& node);

/// The finite numbers in a text, separated by blanks or commas; nullopt if it contains anything
/// else. Numbers too small for a double become 0.
[[nodiscard]] std::optional<std::vector<double>> numbersOf(std::string_view text);

/// A vector of three numbers; nullopt for any other text.
[[nodiscard]] std::optional<Eigen::Vector3d> vectorOf(std::string_view text);

/// Rotation about the fixed axes x, y and z, in this order. Radians.
[[nodiscard]] Eigen::Quaterniond rotationFromRollPitchYaw(const Eigen::Vector3d& roll_pitch_yaw);

/// The name that an <include> gives its model, otherwise the last part of the model's address;
/// clean text.
[[nodiscard]] std::string nameOfInclude(const pugi::xml_node& include);

/// Whether a link's name is generic: "link", "link_3", "base_link", "body".
[[nodiscard]] bool isPlainLinkName(std::string_view name);

/// To be called for a <geometry> without a supported shape: counts its first element, such as
/// <heightmap> or <capsule>, in `shapes`; <empty> does not count.
void noteUnknownShape(const pugi::xml_node& geometry, UnknownShapes& shapes);

/// A linear colour from three or four sRGB values in 0..1, of which the fourth is the opacity
/// (default 1); nullopt for any other text.
[[nodiscard]] std::optional<Eigen::Vector4f> colorOf(std::string_view text);

}  // namespace dollytrack::gazebo
