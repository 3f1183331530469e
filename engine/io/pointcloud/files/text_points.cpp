#include "engine/io/pointcloud/files/text_points.h"

#include "engine/io/files/number_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace dollytrack {
namespace {

constexpr std::size_t kMostColumns = 64;

/// Column indices of x y z, red green blue, nx ny nz; -1: missing.
using Columns = std::array<int, 9>;
constexpr Columns kNone = {-1, -1, -1, -1, -1, -1, -1, -1, -1};

bool isSeparator(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
}

void splitPoint(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    std::size_t at = 0;
    while (words.size() <= kMostColumns) {
        while (at < line.size() && isSeparator(line[at])) ++at;
        if (at == line.size()) return;
        std::size_t end = at;
        while (end < line.size() && !isSeparator(line[end])) ++end;
        words.push_back(line.substr(at, end - at));
        at = end;
    }
}

std::optional<double> numberIfAny(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

int slotNamed(std::string_view word) {
    std::string name;
    for (const char c : word) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte)) name += static_cast<char>(std::tolower(byte));
    }
    static constexpr std::array<std::array<std::string_view, 3>, 9> kNames = {
        {{"x", "posx", "easting"},
         {"y", "posy", "northing"},
         {"z", "posz", "height"},
         {"r", "red", "colorred"},
         {"g", "green", "colorgreen"},
         {"b", "blue", "colorblue"},
         {"nx", "normalx", "n1"},
         {"ny", "normaly", "n2"},
         {"nz", "normalz", "n3"}}};
    for (std::size_t slot = 0; slot < kNames.size(); ++slot) {
        if (std::find(kNames[slot].begin(), kNames[slot].end(), name) != kNames[slot].end()) {
            return static_cast<int>(slot);
        }
    }
    return -1;
}

std::optional<Columns> columnsNamed(const std::vector<std::string_view>& words) {
    Columns columns = kNone;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const int slot = slotNamed(words[i]);
        if (slot >= 0) columns[slot] = static_cast<int>(i);
    }
    if (columns[0] < 0 || columns[1] < 0 || columns[2] < 0) return std::nullopt;
    return columns;
}

std::optional<Columns> columnsCounted(std::size_t count) {
    switch (count) {
        case 3:
        case 4:  // an intensity
            return Columns{0, 1, 2, -1, -1, -1, -1, -1, -1};
        case 6:
            return Columns{0, 1, 2, 3, 4, 5, -1, -1, -1};
        case 7:
            return Columns{0, 1, 2, 4, 5, 6, -1, -1, -1};
        case 9:
            return Columns{0, 1, 2, 3, 4, 5, 6, 7, 8};
        case 10:
            return Columns{0, 1, 2, 4, 5, 6, 7, 8, 9};
        default:
            return std::nullopt;
    }
}

/// Stores colours, scaled to 0..255. Without column names they may be normals instead: they are if
/// any value is negative.
void settleColors(std::vector<std::array<float, 3>>& colors, PointCloud& cloud) {
    float low = 0.0F;
    float high = 0.0F;
    for (const auto& color : colors) {
        for (const float value : color) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (low < 0.0F) {
        if (!cloud.normals.empty()) return;
        for (const auto& n : colors) cloud.normals.emplace_back(n[0], n[1], n[2]);
        return;
    }
    const float scale = high <= 1.0F ? 255.0F : high > 255.0F ? 255.0F / 65535.0F : 1.0F;
    for (const auto& color : colors) {
        std::array<std::uint8_t, 3> bytes{};
        for (std::size_t i = 0; i < 3; ++i) {
            bytes[i] = static_cast<std::uint8_t>(std::clamp(color[i] * scale, 0.0F, 255.0F));
        }
        cloud.colors.push_back(bytes);
    }
}

std::string_view withoutRemark(std::string_view line) {
    line = line.substr(0, line.find('#'));
    return line.substr(0, line.find("//"));
}

}  // namespace

std::size_t countPointNumbers(std::string_view line) {
    std::vector<std::string_view> words;
    splitPoint(line, words);
    return words.size();
}

Result<PointCloud> readTextPoints(std::string_view text, const std::string& name) {
    PointCloud cloud;
    std::vector<std::array<float, 3>> colors;
    std::optional<Columns> columns;
    std::vector<std::string_view> words;
    std::size_t width = 0;
    int line_number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view whole = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line_number;
        // The column names may be in a comment: "//X Y Z R G B".
        const bool first = cloud.points.empty() && !columns;
        splitPoint(first && whole.starts_with("//") ? whole.substr(2) : withoutRemark(whole),
                   words);
        if (words.empty()) continue;
        const auto refuse = [&](std::string message) {
            return fail(ErrorCode::BadInput, std::move(message), placeOf(name, line_number));
        };
        if (cloud.points.empty() && !numberIfAny(words[0])) {
            if (!columns) columns = columnsNamed(words);
            continue;
        }
        if (words.size() == 1 && cloud.points.empty()) continue;  // the number of points
        if (width == 0) width = words.size();
        if (words.size() != width) {
            return refuse(fmt::format("This line has {} numbers, but the lines before have {}.",
                                      words.size(), width));
        }
        if (!columns) columns = columnsCounted(width);
        if (!columns) {
            return refuse(
                fmt::format("A point has x y z, optionally followed by red green blue and a "
                            "normal; this line has {} numbers.",
                            width));
        }
        std::array<double, 9> values{};
        for (std::size_t slot = 0; slot < values.size(); ++slot) {
            const int column = (*columns)[slot];
            if (column < 0) continue;
            if (static_cast<std::size_t>(column) >= words.size()) {
                return refuse(
                    "The number of values in this line differs from the number of column names in "
                    "the first line.");
            }
            const auto number = numberIfAny(words[column]);
            if (!number) return refuse("This is not a number.");
            values[slot] = *number;
        }
        const Eigen::Vector3d point(values[0], values[1], values[2]);
        if (!point.allFinite()) {
            ++cloud.left_out;
            continue;
        }
        if (cloud.points.size() >= kMostCloudPoints) return refuse("It contains too many points.");
        cloud.points.push_back(point);
        if ((*columns)[5] >= 0) {
            colors.push_back({static_cast<float>(values[3]), static_cast<float>(values[4]),
                              static_cast<float>(values[5])});
        }
        if ((*columns)[8] >= 0) {
            cloud.normals.emplace_back(static_cast<float>(values[6]), static_cast<float>(values[7]),
                                       static_cast<float>(values[8]));
        }
    }
    if (!colors.empty()) settleColors(colors, cloud);
    if (cloud.points.empty()) {
        return fail(ErrorCode::BadInput, "It contains no point: no line starts with x y z.", name);
    }
    return cloud;
}

}  // namespace dollytrack
