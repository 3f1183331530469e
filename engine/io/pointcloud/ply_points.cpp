#include "engine/io/pointcloud/ply_points.h"

#include "engine/io/sandbox/input_file.h"

#include "engine/io/trajectories/number_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

namespace dollytrack::io {
namespace {

namespace fs = std::filesystem;

enum class Kind { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

struct Property {
    std::string name;
    Kind kind = Kind::Float;
    std::optional<Kind> count;  // of a list: the type of its length
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    std::string format;
    std::vector<Element> elements;
    std::size_t size = 0;  // bytes
};

std::optional<Kind> kindNamed(std::string_view name) {
    struct Row {
        std::string_view name, other;
        Kind kind;
    };
    static constexpr std::array<Row, 8> kRows = {{{"char", "int8", Kind::Int8},
                                                  {"uchar", "uint8", Kind::UInt8},
                                                  {"short", "int16", Kind::Int16},
                                                  {"ushort", "uint16", Kind::UInt16},
                                                  {"int", "int32", Kind::Int32},
                                                  {"uint", "uint32", Kind::UInt32},
                                                  {"float", "float32", Kind::Float},
                                                  {"double", "float64", Kind::Double}}};
    for (const Row& row : kRows) {
        if (name == row.name || name == row.other) return row.kind;
    }
    return std::nullopt;
}

std::size_t bytesOf(Kind kind) {
    switch (kind) {
        case Kind::Int8:
        case Kind::UInt8:
            return 1;
        case Kind::Int16:
        case Kind::UInt16:
            return 2;
        case Kind::Double:
            return 8;
        default:
            return 4;
    }
}

tl::unexpected<Error> wrong(std::string message, const std::string& where) {
    return fail(ErrorCode::BadInput, std::move(message), where);
}

Status takeLine(const std::vector<std::string_view>& words, const std::string& where,
                Header& header) {
    const auto is = [&](std::size_t i, std::string_view word) {
        return i < words.size() && words[i] == word;
    };
    if (words.empty() || is(0, "ply") || is(0, "comment") || is(0, "obj_info")) return {};
    if (is(0, "format") && words.size() >= 2) {
        header.format = words[1];
        return {};
    }
    if (is(0, "element") && words.size() == 3) {
        Element element{std::string(words[1]), 0, {}};
        const auto [end, error] =
            std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        if (error != std::errc()) return wrong("The number of elements is none.", where);
        header.elements.push_back(std::move(element));
        return {};
    }
    if (is(0, "property") && !header.elements.empty() && words.size() >= 3) {
        Property property{std::string(words.back()), Kind::Float, std::nullopt};
        const bool list = is(1, "list") && words.size() == 5;
        const std::optional<Kind> kind = kindNamed(list ? words[3] : words[1]);
        if (list) property.count = kindNamed(words[2]);
        if (!kind || (list && !property.count)) {
            return wrong("The property has no known type.", where);
        }
        property.kind = *kind;
        header.elements.back().properties.push_back(std::move(property));
        return {};
    }
    return wrong("It is no line of a PLY header.", where);
}

Result<Header> readHeader(const fs::path& path, const std::string& bytes) {
    if (!bytes.starts_with("ply")) return wrong("It is no PLY file.", path.string());
    Header header;
    int line = 0;
    while (true) {
        const std::size_t end = bytes.find('\n', header.size);
        if (end == std::string::npos) return wrong("Its header has no end.", path.string());
        const auto words =
            splitWords(std::string_view(bytes).substr(header.size, end - header.size));
        header.size = end + 1;
        ++line;
        if (!words.empty() && words[0] == "end_header") return header;
        if (Status status = takeLine(words, placeOf(path, line), header); !status) {
            return tl::unexpected<Error>(status.error());
        }
    }
}

/// Numbers one after the other, from text or from bytes.
class Numbers {
  public:
    Numbers(std::string_view data, const std::string& format)
        : data_(data),
          text_(format == "ascii"),
          swapped_((format == "binary_big_endian") ==
                   (std::endian::native == std::endian::little)) {}

    /// Nothing at the end of the file and where there is no number.
    std::optional<double> next(Kind kind) { return text_ ? word() : binary(kind); }

  private:
    std::optional<double> word() {
        const std::size_t begin = data_.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) return std::nullopt;
        const std::size_t end = std::min(data_.find_first_of(" \t\r\n", begin), data_.size());
        const std::string_view text = data_.substr(begin, end - begin);
        data_.remove_prefix(end);
        double value = 0.0;
        const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || last != text.data() + text.size()) return std::nullopt;
        return value;
    }

    template <class T>
    T as(std::array<char, 8> bytes) const {
        if (swapped_) std::reverse(bytes.begin(), bytes.begin() + sizeof(T));
        T value;
        std::memcpy(&value, bytes.data(), sizeof(T));
        return value;
    }

    std::optional<double> binary(Kind kind) {
        const std::size_t size = bytesOf(kind);
        if (data_.size() < size) return std::nullopt;
        std::array<char, 8> bytes{};
        std::memcpy(bytes.data(), data_.data(), size);
        data_.remove_prefix(size);
        switch (kind) {
            case Kind::Int8:
                return as<std::int8_t>(bytes);
            case Kind::UInt8:
                return as<std::uint8_t>(bytes);
            case Kind::Int16:
                return as<std::int16_t>(bytes);
            case Kind::UInt16:
                return as<std::uint16_t>(bytes);
            case Kind::Int32:
                return as<std::int32_t>(bytes);
            case Kind::UInt32:
                return as<std::uint32_t>(bytes);
            case Kind::Float:
                return as<float>(bytes);
            case Kind::Double:
                return as<double>(bytes);
        }
        return std::nullopt;
    }

    std::string_view data_;
    bool text_;
    bool swapped_;
};

/// The place of a property among x y z, red green blue, nx ny nz; -1: of no interest.
int slotOf(std::string_view name) {
    static constexpr std::array<std::string_view, 9> kNames = {"x",    "y",  "z",  "red", "green",
                                                               "blue", "nx", "ny", "nz"};
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return found == kNames.end() ? -1 : static_cast<int>(found - kNames.begin());
}

using Slots = std::array<double, 9>;

/// One element's properties; those of a point are kept. False at the end of the file.
bool readElement(const Element& element, const std::vector<int>& slots, Numbers& numbers,
                 Slots& values) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
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
        if (slots[p] >= 0) values[static_cast<std::size_t>(slots[p])] = *value;
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

/// What a colour is multiplied with to go up to 255; 0: there is none.
double colorScale(const Element& element, const std::vector<int>& slots) {
    for (std::size_t p = 0; p < slots.size(); ++p) {
        if (slots[p] != 3) continue;
        const Kind kind = element.properties[p].kind;
        if (kind == Kind::Float || kind == Kind::Double) return 255.0;
        return kind == Kind::UInt16 ? 255.0 / 65535.0 : 1.0;
    }
    return 0.0;
}

Status readVertices(const Element& element, Numbers& numbers, const fs::path& path,
                    PointCloud& cloud) {
    std::vector<int> slots;
    unsigned found = 0;
    for (const Property& property : element.properties) {
        slots.push_back(property.count ? -1 : slotOf(property.name));
        if (slots.back() >= 0) found |= 1U << static_cast<unsigned>(slots.back());
    }
    const bool wanted = element.name == "vertex" && (found & 7U) == 7U;
    const double color_scale = (found & 56U) == 56U ? colorScale(element, slots) : 0.0;
    const bool normals = (found & 448U) == 448U;
    for (std::size_t i = 0; i < element.count; ++i) {
        Slots values{};
        if (!readElement(element, slots, numbers, values)) {
            return wrong(fmt::format("It ends within {} {} of {}, or a number of that is none.",
                                     element.name, i, element.count),
                         path.string());
        }
        if (wanted) addPoint(values, color_scale, normals, cloud);
    }
    return {};
}

}  // namespace

Result<PointCloud> readPlyCloud(const fs::path& path) {
    constexpr std::uint64_t kLargest = std::uint64_t{8} << 30U;  // bytes
    const Result<std::string> text = readNamedFile(path, kLargest);
    if (!text) return tl::unexpected<Error>(text.error());
    const std::string& bytes = *text;
    const Result<Header> header = readHeader(path, bytes);
    if (!header) return tl::unexpected<Error>(header.error());
    if (header->format != "ascii" && !header->format.starts_with("binary_")) {
        return wrong("It is of no known PLY format.", path.string());
    }
    Numbers numbers(std::string_view(bytes).substr(header->size), header->format);
    PointCloud cloud;
    for (const Element& element : header->elements) {
        if (element.properties.empty() || element.count > bytes.size()) {
            if (element.count == 0) continue;
            return wrong(fmt::format("It says that it holds {} of '{}', and is too short for that.",
                                     element.count, element.name),
                         path.string());
        }
        if (Status read = readVertices(element, numbers, path, cloud); !read) {
            return tl::unexpected<Error>(read.error());
        }
        if (element.name == "vertex") break;  // faces are of no interest
    }
    if (cloud.points.empty()) return wrong("There is no point in it.", path.string());
    return cloud;
}

Result<std::vector<Eigen::Vector3d>> readPlyPoints(const fs::path& path) {
    Result<PointCloud> cloud = readPlyCloud(path);
    if (!cloud) return tl::unexpected<Error>(std::move(cloud.error()));
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

}  // namespace dollytrack::io
