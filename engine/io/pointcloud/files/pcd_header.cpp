#include "engine/io/pointcloud/files/pcd_header.h"

#include "engine/io/files/number_lines.h"
#include "engine/io/pointcloud/files/point_cloud.h"

#include <fmt/format.h>

#include <charconv>

namespace dollytrack {
namespace {

constexpr std::size_t kMostFields = 256;
constexpr std::size_t kMostCount = 4096;  // numbers per field; feature descriptors have 352

template <class T>
bool parse(std::string_view word, T& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

bool takeFields(const std::vector<std::string_view>& words, PcdHeader& header) {
    if (words.size() > kMostFields) return false;
    for (std::size_t i = 1; i < words.size(); ++i) {
        header.fields.push_back({.name = std::string(words[i])});
    }
    return !header.fields.empty();
}

/// Reads SIZE, TYPE or COUNT, which have one word per field.
bool takeColumn(const std::vector<std::string_view>& words, PcdHeader& header) {
    if (words.size() != header.fields.size() + 1) return false;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        PcdField& field = header.fields[i];
        const std::string_view word = words[i + 1];
        if (words[0] == "TYPE") {
            if (word != "F" && word != "I" && word != "U") return false;
            field.type = word.front();
        } else if (words[0] == "SIZE") {
            if (!parse(word, field.size)) return false;
        } else if (!parse(word, field.count) || field.count > kMostCount) {
            return false;
        }
    }
    return true;
}

bool takeLine(const std::vector<std::string_view>& words, PcdHeader& header) {
    const std::string_view key = words[0];
    const auto number = [&](std::size_t& value) {
        return words.size() == 2 && parse(words[1], value) && value <= kMostCloudPoints;
    };
    if (key == "VERSION") return true;
    if (key == "FIELDS" || key == "COLUMNS")
        return header.fields.empty() && takeFields(words, header);
    if (key == "SIZE" || key == "TYPE" || key == "COUNT") return takeColumn(words, header);
    if (key == "WIDTH") return number(header.width);
    if (key == "HEIGHT") return number(header.height);
    if (key == "POINTS") return number(header.points);
    if (key == "VIEWPOINT") {
        if (words.size() != 8) return false;
        for (int i = 0; i < 3; ++i) {
            if (!parse(words[i + 1], header.viewpoint[i])) return false;
        }
        return header.viewpoint.allFinite();
    }
    if (key == "DATA" && words.size() == 2) {
        header.data = words[1];
        return header.data == "ascii" || header.data == "binary" ||
               header.data == "binary_compressed";
    }
    return false;
}

/// A description of an inconsistency; empty if there is none.
std::string checkHeader(PcdHeader& header) {
    for (PcdField& field : header.fields) {
        const bool real = field.type == 'F' && (field.size == 4 || field.size == 8);
        const bool whole = field.type != 'F' && (field.size == 1 || field.size == 2 ||
                                                 field.size == 4 || field.size == 8);
        if (!real && !whole) return fmt::format("The field '{}' has no known type.", field.name);
        field.offset = header.point_bytes;
        header.point_bytes += field.size * field.count;
    }
    for (const std::string_view name : {"x", "y", "z"}) {
        const PcdField* field = header.find(name);
        if (!field || field->count != 1) return fmt::format("It has no field '{}'.", name);
    }
    if (header.points == 0) header.points = header.width * header.height;
    if (header.width * header.height != header.points && header.width != 0) {
        return fmt::format("WIDTH {} times HEIGHT {} does not equal POINTS {}.", header.width,
                           header.height, header.points);
    }
    if (header.points == 0 || header.points > kMostCloudPoints) {
        return fmt::format("Its header declares {} points; 1 to {} can be read.", header.points,
                           kMostCloudPoints);
    }
    return {};
}

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
    for (const PcdField& field : fields) {
        if (field.name == name) return &field;
    }
    return nullptr;
}

Result<PcdHeader> readPcdHeader(std::string_view bytes, const std::string& name) {
    PcdHeader header;
    while (header.data.empty()) {
        const std::size_t end = bytes.find('\n', header.size);
        if (end == std::string_view::npos || ++header.lines > 64) {
            return fail(ErrorCode::BadInput, "Its PCD header has no DATA line.", name);
        }
        const auto words = splitWords(bytes.substr(header.size, end - header.size));
        header.size = end + 1;
        if (words.empty() || words[0].starts_with('#')) continue;
        if (!takeLine(words, header)) {
            return fail(ErrorCode::BadInput, "This line does not belong in a PCD header.",
                        placeOf(name, header.lines));
        }
    }
    if (std::string wrong = checkHeader(header); !wrong.empty()) {
        return fail(ErrorCode::BadInput, std::move(wrong), name);
    }
    return header;
}

}  // namespace dollytrack
