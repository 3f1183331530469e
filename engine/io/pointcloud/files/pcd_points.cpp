#include "engine/io/pointcloud/files/pcd_points.h"

#include "engine/io/files/number_lines.h"
#include "engine/io/pointcloud/files/lzf.h"
#include "engine/io/pointcloud/files/pcd_header.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace dollytrack {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files are little endian");

template <class T>
double as(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

double numberAt(const PcdField& field, const std::uint8_t* bytes) {
    if (field.type == 'F') return field.size == 8 ? as<double>(bytes) : as<float>(bytes);
    const bool is_signed = field.type == 'I';
    switch (field.size) {
        case 1:
            return is_signed ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
        case 2:
            return is_signed ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
        case 4:
            return is_signed ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
        default:
            return is_signed ? as<std::int64_t>(bytes) : as<std::uint64_t>(bytes);
    }
}

std::array<std::uint8_t, 3> unpackColor(std::uint32_t packed) {
    return {static_cast<std::uint8_t>(packed >> 16U), static_cast<std::uint8_t>(packed >> 8U),
            static_cast<std::uint8_t>(packed)};
}

/// The fields with position, colour and normal.
struct Wanted {
    std::array<const PcdField*, 3> place{};
    std::array<const PcdField*, 3> normal{};
    const PcdField* color = nullptr;

    explicit Wanted(const PcdHeader& header)
        : place{header.find("x"), header.find("y"), header.find("z")},
          normal{header.find("normal_x"), header.find("normal_y"), header.find("normal_z")},
          color(header.find("rgb") ? header.find("rgb") : header.find("rgba")) {
        if (color && (color->size != 4 || color->count != 1)) color = nullptr;
        for (const PcdField* field : normal) {
            if (!field || field->count != 1) normal = {};
        }
    }
};

/// Adds a point. The functions return a field's number and the packed colour.
template <class NumberOf, class ColorOf>
void addPoint(const Wanted& wanted, const NumberOf& numberOf, const ColorOf& colorOf,
              PointCloud& cloud) {
    const Eigen::Vector3d point(numberOf(*wanted.place[0]), numberOf(*wanted.place[1]),
                                numberOf(*wanted.place[2]));
    if (!point.allFinite()) {
        ++cloud.left_out;
        return;
    }
    cloud.points.push_back(point);
    if (wanted.color) cloud.colors.push_back(unpackColor(colorOf(*wanted.color)));
    if (wanted.normal[0]) {
        cloud.normals.emplace_back(static_cast<float>(numberOf(*wanted.normal[0])),
                                   static_cast<float>(numberOf(*wanted.normal[1])),
                                   static_cast<float>(numberOf(*wanted.normal[2])));
    }
}

/// Reads binary points. `by_field`: `data` is ordered by field instead of by point, as in
/// compressed files.
Status readBinary(const PcdHeader& header, std::span<const std::uint8_t> data, bool by_field,
                  const std::string& name, PointCloud& cloud) {
    if (header.point_bytes == 0 || data.size() / header.point_bytes < header.points) {
        return fail(ErrorCode::BadInput,
                    fmt::format("It is too short for the {} points of its header.", header.points),
                    name);
    }
    const Wanted wanted(header);
    for (std::size_t i = 0; i < header.points; ++i) {
        const auto bytesOf = [&](const PcdField& field) {
            return by_field
                       ? data.data() + field.offset * header.points + i * field.size * field.count
                       : data.data() + i * header.point_bytes + field.offset;
        };
        addPoint(
            wanted, [&](const PcdField& field) { return numberAt(field, bytesOf(field)); },
            [&](const PcdField& field) {
                std::uint32_t packed = 0;
                std::memcpy(&packed, bytesOf(field), 4);
                return packed;
            },
            cloud);
    }
    return {};
}

Status readCompressed(const PcdHeader& header, std::span<const std::uint8_t> data,
                      const std::string& name, PointCloud& cloud) {
    const auto broken = [&] {
        return fail(ErrorCode::BadInput, "Its compressed points are damaged.", name);
    };
    if (data.size() < 8) return broken();
    std::uint32_t packed = 0;
    std::uint32_t unpacked = 0;
    std::memcpy(&packed, data.data(), 4);
    std::memcpy(&unpacked, data.data() + 4, 4);
    if (packed > data.size() - 8) return broken();
    const auto bytes = unpackLzf(data.subspan(8, packed), unpacked);
    if (!bytes) return broken();
    return readBinary(header, *bytes, true, name, cloud);
}

/// A number in a text file; NaN ("nan" for unmeasured points) is permitted.
double numberOf(std::string_view word) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size()
               ? value
               : std::numeric_limits<double>::quiet_NaN();
}

/// A packed colour in a text file: an integer, or its bits written as a float.
std::uint32_t colorOf(std::string_view word, const PcdField& field) {
    const double value = numberOf(word);
    if (!std::isfinite(value)) return 0;
    if (field.type == 'F') return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    return static_cast<std::uint32_t>(
        static_cast<std::int64_t>(std::abs(value) < 1e15 ? value : 0));
}

Status readText(const PcdHeader& header, std::string_view text, const std::string& name,
                PointCloud& cloud) {
    std::vector<std::size_t> column;
    std::size_t columns = 0;
    for (const PcdField& field : header.fields) {
        column.push_back(columns);
        columns += field.count;
    }
    const Wanted wanted(header);
    std::size_t found = 0;
    int line_number = header.lines;
    for (const std::string_view line : splitLines(text)) {
        ++line_number;
        const auto words = splitWords(line);
        if (words.empty()) continue;
        if (words.size() != columns) {
            return fail(ErrorCode::BadInput,
                        fmt::format("There are {} numbers, but the header declares {} per point.",
                                    words.size(), columns),
                        placeOf(name, line_number));
        }
        const auto wordOf = [&](const PcdField& field) {
            return words[column[&field - header.fields.data()]];
        };
        addPoint(
            wanted, [&](const PcdField& field) { return numberOf(wordOf(field)); },
            [&](const PcdField& field) { return colorOf(wordOf(field), field); }, cloud);
        if (++found == header.points) break;
    }
    if (found < header.points) {
        return fail(ErrorCode::BadInput,
                    fmt::format("The file ends after {} of {} points; download or export it again.",
                                found, header.points),
                    name);
    }
    return {};
}

}  // namespace

Result<PointCloud> readPcd(std::string_view bytes, const std::string& name) {
    const Result<PcdHeader> header = readPcdHeader(bytes, name);
    if (!header) return tl::unexpected(header.error());
    const std::string_view rest = bytes.substr(header->size);
    const std::span<const std::uint8_t> data(reinterpret_cast<const std::uint8_t*>(rest.data()),
                                             rest.size());
    PointCloud cloud;
    const Status read = header->data == "ascii"    ? readText(*header, rest, name, cloud)
                        : header->data == "binary" ? readBinary(*header, data, false, name, cloud)
                                                   : readCompressed(*header, data, name, cloud);
    if (!read) return tl::unexpected(read.error());
    if (header->height > 1) cloud.viewpoint = header->viewpoint;
    return cloud;
}

}  // namespace dollytrack
