#pragma once

#include "engine/core/result.h"
#include "engine/io/files/number_lines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The type of a number.
enum class PlyKind { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

/// A property of a PLY element, a number or a list.
struct PlyProperty {
    std::string name;
    PlyKind kind = PlyKind::Float;
    std::optional<PlyKind> count;  // for lists: the type of the length
};

/// An element type, such as "vertex" or "face", with its number of records.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

/// The header of a PLY file.
struct PlyHeader {
    std::string format;       // "ascii", "binary_little_endian" or "binary_big_endian"
    std::string texture;      // file name in a "comment TextureFile"; empty: none
    bool by_blender = false;  // a comment says that Blender wrote the file
    std::vector<PlyElement> elements;
    std::size_t size = 0;  // bytes; offset of the data
};

/// Size of a number in a binary file, bytes.
std::size_t bytesOfPly(PlyKind kind);

/// Parses the header of a PLY file. Error: BadInput, with the line.
Result<PlyHeader> readPlyHeader(const std::filesystem::path& path, std::string_view bytes);

/// Reads the numbers of a PLY file's data in order, from text or binary.
class PlyNumbers {
  public:
    PlyNumbers(std::string_view data, const std::string& format)
        : data_(data),
          text_(format == "ascii"),
          swapped_((format == "binary_big_endian") ==
                   (std::endian::native == std::endian::little)) {}

    /// The next number; nullopt at the end of the data and for a word that is not a number.
    std::optional<double> next(PlyKind kind) { return text_ ? word() : binary(kind); }

  private:
    std::optional<double> word() {
        const std::size_t begin = data_.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) return std::nullopt;
        const std::size_t end = std::min(data_.find_first_of(" \t\r\n", begin), data_.size());
        const std::string_view text = data_.substr(begin, end - begin);
        data_.remove_prefix(end);
        return numberFrom(text);
    }

    template <class T>
    T as(std::array<char, 8> bytes) const {
        if (swapped_) std::reverse(bytes.begin(), bytes.begin() + sizeof(T));
        T value;
        std::memcpy(&value, bytes.data(), sizeof(T));
        return value;
    }

    std::optional<double> binary(PlyKind kind) {
        const std::size_t size = bytesOfPly(kind);
        if (data_.size() < size) return std::nullopt;
        std::array<char, 8> bytes{};
        std::memcpy(bytes.data(), data_.data(), size);
        data_.remove_prefix(size);
        switch (kind) {
            case PlyKind::Int8:
                return as<std::int8_t>(bytes);
            case PlyKind::UInt8:
                return as<std::uint8_t>(bytes);
            case PlyKind::Int16:
                return as<std::int16_t>(bytes);
            case PlyKind::UInt16:
                return as<std::uint16_t>(bytes);
            case PlyKind::Int32:
                return as<std::int32_t>(bytes);
            case PlyKind::UInt32:
                return as<std::uint32_t>(bytes);
            case PlyKind::Float:
                return as<float>(bytes);
            case PlyKind::Double:
                return as<double>(bytes);
        }
        return std::nullopt;
    }

    std::string_view data_;
    bool text_;
    bool swapped_;
};

}  // namespace dollytrack
