#include "engine/io/pointcloud/files/ply_file.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/number_lines.h"

#include <charconv>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

std::optional<PlyKind> kindNamed(std::string_view name) {
    struct Row {
        std::string_view name, other;
        PlyKind kind;
    };
    static constexpr std::array<Row, 8> kRows = {{{"char", "int8", PlyKind::Int8},
                                                  {"uchar", "uint8", PlyKind::UInt8},
                                                  {"short", "int16", PlyKind::Int16},
                                                  {"ushort", "uint16", PlyKind::UInt16},
                                                  {"int", "int32", PlyKind::Int32},
                                                  {"uint", "uint32", PlyKind::UInt32},
                                                  {"float", "float32", PlyKind::Float},
                                                  {"double", "float64", PlyKind::Double}}};
    for (const Row& row : kRows) {
        if (name == row.name || name == row.other) return row.kind;
    }
    return std::nullopt;
}

tl::unexpected<Error> plyFault(std::string message, const std::string& where) {
    return fail(ErrorCode::BadInput, std::move(message), where);
}

Status takeLine(const std::vector<std::string_view>& words, const std::string& where,
                PlyHeader& header) {
    const auto is = [&](std::size_t i, std::string_view word) {
        return i < words.size() && words[i] == word;
    };
    if (is(0, "comment") && is(1, "TextureFile") && words.size() >= 3) {
        // The rest of the line is the file name, which may contain blanks.
        const char* const end = words.back().data() + words.back().size();
        header.texture.assign(words[2].data(), end);
    }
    // Blender writes PLY files with z up, unless the user chooses otherwise.
    if (is(0, "comment") && is(1, "Created") && is(3, "Blender")) header.by_blender = true;
    if (words.empty() || is(0, "ply") || is(0, "comment") || is(0, "obj_info")) return {};
    if (is(0, "format") && words.size() >= 2) {
        header.format = words[1];
        return {};
    }
    if (is(0, "element") && words.size() == 3) {
        PlyElement element{std::string(words[1]), 0, {}};
        const auto [end, error] =
            std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        if (error != std::errc()) {
            return plyFault("The count of \"" + cleanText(words[1]) +
                                "\" is not a whole number; export the file again.",
                            where);
        }
        header.elements.push_back(std::move(element));
        return {};
    }
    if (is(0, "property") && !header.elements.empty() && words.size() >= 3) {
        PlyProperty property{std::string(words.back()), PlyKind::Float, std::nullopt};
        const bool list = is(1, "list") && words.size() == 5;
        const std::optional<PlyKind> kind = kindNamed(list ? words[3] : words[1]);
        if (list) property.count = kindNamed(words[2]);
        if (!list && words[1] == "string") {
            return plyFault(
                "Text labels cannot be read; write numbers, and their names into NAME.labels.json "
                "beside NAME.ply ({\"3\": \"chair\"}).",
                where);
        }
        if (!kind || (list && !property.count)) {
            return plyFault("The type of this property is not a PLY type; export the file again.",
                            where);
        }
        property.kind = *kind;
        header.elements.back().properties.push_back(std::move(property));
        return {};
    }
    return plyFault("This line does not belong in a PLY header; export the file again.", where);
}

}  // namespace

std::size_t bytesOfPly(PlyKind kind) {
    switch (kind) {
        case PlyKind::Int8:
        case PlyKind::UInt8:
            return 1;
        case PlyKind::Int16:
        case PlyKind::UInt16:
            return 2;
        case PlyKind::Double:
            return 8;
        default:
            return 4;
    }
}

Result<PlyHeader> readPlyHeader(const fs::path& path, std::string_view bytes) {
    if (!bytes.starts_with("ply"))
        return plyFault("The file is not a PLY file: it does not start with \"ply\".",
                        path.string());
    PlyHeader header;
    int line = 0;
    while (true) {
        const std::size_t end = bytes.find('\n', header.size);
        if (end == std::string_view::npos)
            return plyFault(
                "The PLY header has no end_header line; export or download the file again.",
                path.string());
        const auto words = splitWords(bytes.substr(header.size, end - header.size));
        header.size = end + 1;
        ++line;
        if (!words.empty() && words[0] == "end_header") break;
        if (Status status = takeLine(words, placeOf(path, line), header); !status) {
            return tl::unexpected(status.error());
        }
    }
    if (header.format == "ascii" || header.format.starts_with("binary_")) return header;
    return plyFault(
        "The format line names neither ascii nor a binary format; export the file again.",
        path.string());
}

}  // namespace dollytrack
