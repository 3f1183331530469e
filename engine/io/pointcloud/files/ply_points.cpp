#include "engine/io/pointcloud/files/ply_points.h"

#include "engine/io/files/input_file.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/pointcloud/files/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> wrong(std::string message, const std::string& where) {
    return fail(ErrorCode::BadInput, std::move(message), where);
}

constexpr std::size_t kOpacity = 9;

/// Index of a property in x y z, red green blue, nx ny nz, opacity; -1 for all others. For Gaussian
/// splats, f_dc (the constant term of the colour) replaces the colour.
int slotOf(std::string_view name, bool splats) {
    static constexpr std::array<std::string_view, 10> kPoint = {"x",    "y",  "z",  "red", "green",
                                                                "blue", "nx", "ny", "nz",  ""};
    static constexpr std::array<std::string_view, 10> kSplat = {
        "x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "", "", "", "opacity"};
    const auto& names = splats ? kSplat : kPoint;
    const auto* const found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

using Slots = std::array<double, 10>;

bool holdsSplats(const PlyElement& element) {
    int found = 0;
    for (const PlyProperty& property : element.properties) {
        found += property.name == "f_dc_0" || property.name == "scale_0";
    }
    return found == 2;
}

/// Converts a splat's colour to 0..255. Returns false if its opacity is below 10 %.
bool paintSplat(Slots& values) {
    constexpr double kHarmonic = 0.28209479177387814;  // the constant spherical harmonic
    constexpr double kFaint = -2.197224577336219;      // logit of an opacity of 0.1
    for (std::size_t i = 3; i < 6; ++i) values[i] = 255.0 * (0.5 + kHarmonic * values[i]);
    return values[kOpacity] >= kFaint;
}

/// Reads one record and stores the values that have a slot. Returns false at the end of the file.
bool readElement(const PlyElement& element, const std::vector<int>& slots, PlyNumbers& numbers,
                 Slots& values) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.count) {
            const auto count = numbers.next(*property.count);
            if (!count || !(*count >= 0.0 && *count < 4e9)) return false;
            for (std::size_t i = 0; i < static_cast<std::size_t>(*count); ++i) {
                if (!numbers.next(property.kind)) return false;
            }
            continue;
        }
        const auto value = numbers.next(property.kind);
        if (!value) return false;
        if (slots[p] >= 0) values[slots[p]] = *value;
    }
    return true;
}

void addPoint(const Slots& values, double color_scale, bool normals, PointCloud& cloud) {
    const Eigen::Vector3d point(values[0], values[1], values[2]);
    if (!point.allFinite()) {
        ++cloud.left_out;
        return;
    }
    cloud.points.push_back(point);
    if (color_scale > 0.0) {
        std::array<std::uint8_t, 3> color{};
        for (std::size_t i = 0; i < 3; ++i) {
            const double value = values[3 + i] * color_scale;
            color[i] = static_cast<std::uint8_t>(value > 0.0 ? std::min(value, 255.0) : 0.0);
        }
        cloud.colors.push_back(color);
    }
    if (normals) {
        cloud.normals.emplace_back(static_cast<float>(values[6]), static_cast<float>(values[7]),
                                   static_cast<float>(values[8]));
    }
}

/// Factor that scales colour values to 0..255; 0 if there are no colours.
double colorScale(const PlyElement& element, const std::vector<int>& slots) {
    for (std::size_t p = 0; p < slots.size(); ++p) {
        if (slots[p] != 3) continue;
        const PlyKind kind = element.properties[p].kind;
        if (kind == PlyKind::Float || kind == PlyKind::Double) return 255.0;
        return kind == PlyKind::UInt16 ? 255.0 / 65535.0 : 1.0;
    }
    return 0.0;
}

Status readVertices(const PlyElement& element, PlyNumbers& numbers, const fs::path& path,
                    PointCloud& cloud) {
    std::vector<int> slots;
    unsigned found = 0;
    const bool splats = holdsSplats(element);
    for (const PlyProperty& property : element.properties) {
        slots.push_back(property.count ? -1 : slotOf(property.name, splats));
        if (slots.back() >= 0) found |= 1U << static_cast<unsigned>(slots.back());
    }
    const bool wanted = element.name == "vertex" && (found & 7U) == 7U;
    double color_scale = (found & 56U) == 56U ? colorScale(element, slots) : 0.0;
    if (splats && color_scale > 0.0) color_scale = 1.0;
    const bool normals = (found & 448U) == 448U;
    for (std::size_t i = 0; i < element.count; ++i) {
        Slots values{};
        if (!readElement(element, slots, numbers, values)) {
            return wrong(fmt::format("The file ends within {} {} of {}, or a value there is not a "
                                     "number; export or download it again.",
                                     element.name, i, element.count),
                         path.string());
        }
        if (splats && !paintSplat(values)) continue;
        if (wanted) addPoint(values, color_scale, normals, cloud);
    }
    cloud.splats = cloud.splats || (wanted && splats);
    return {};
}

}  // namespace

Result<PointCloud> readPlyCloud(const fs::path& path) {
    constexpr std::uint64_t kLargest = std::uint64_t{8} << 30U;  // bytes
    const Result<std::string> text = readNamedFile(path, kLargest);
    if (!text) return tl::unexpected(text.error());
    const std::string& bytes = *text;
    const Result<PlyHeader> header = readPlyHeader(path, bytes);
    if (!header) return tl::unexpected(header.error());
    const auto isPacked = [](const PlyProperty& one) { return one.name == "packed_position"; };
    for (const PlyElement& element : header->elements) {
        if (std::ranges::none_of(element.properties, isPacked)) continue;
        return wrong(
            "These are Gaussian splats in compressed form; save them as an uncompressed "
            "PLY, for example in SuperSplat.",
            path.string());
    }
    PlyNumbers numbers(std::string_view(bytes).substr(header->size), header->format);
    PointCloud cloud;
    for (const PlyElement& element : header->elements) {
        if (element.properties.empty() || element.count > bytes.size()) {
            if (element.count == 0) continue;
            return wrong(fmt::format("The file is too short for the {} elements of '{}' in its "
                                     "header; export or download it again.",
                                     element.count, element.name),
                         path.string());
        }
        if (Status read = readVertices(element, numbers, path, cloud); !read) {
            return tl::unexpected(read.error());
        }
        if (element.name == "vertex") break;  // later elements are not needed
    }
    if (cloud.points.empty())
        return wrong("The file contains no points with finite x, y and z.", path.string());
    return cloud;
}

Result<std::vector<Eigen::Vector3d>> readPlyPoints(const fs::path& path) {
    Result<PointCloud> cloud = readPlyCloud(path);
    if (!cloud) return tl::unexpected(std::move(cloud.error()));
    return std::move(cloud->points);
}

bool isPlyOfPoints(std::string_view head) {
    if (!head.starts_with("ply")) return false;
    const std::size_t end = head.find("end_header");
    if (end == std::string_view::npos) return false;
    for (const std::string_view line : splitLines(head.substr(0, end))) {
        const auto words = splitWords(line);
        const bool faces = words.size() == 3 && words[0] == "element" &&
                           (words[1] == "face" || words[1] == "tristrips") && words[2] != "0";
        if (faces) return false;
    }
    return true;
}

}  // namespace dollytrack
