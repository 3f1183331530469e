#include "render/verify/read/numpy_array.h"

#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

namespace dollytrack::verify {
namespace {

constexpr int kLargestArraySide = 1 << 16;

tl::unexpected<Error> unreadableArray(std::string message) {
    return fail(ErrorCode::BadInput, std::move(message));
}

/// Value of a key in the header, which is a Python dictionary.
std::optional<std::string_view> valueOf(std::string_view header, std::string_view key) {
    const std::size_t at = header.find(fmt::format("'{}':", key));
    if (at == std::string_view::npos) return std::nullopt;
    std::string_view rest = header.substr(at + key.size() + 3);
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    return rest;
}

/// Parses "(480, 640, 2)", with or without a trailing comma.
std::vector<int> shapeFrom(std::string_view text) {
    std::vector<int> shape;
    if (!text.starts_with('(')) return shape;
    text.remove_prefix(1);
    text = text.substr(0, text.find(')'));
    while (!text.empty()) {
        text.remove_prefix(std::min(text.find_first_not_of(" ,"), text.size()));
        if (text.empty()) break;
        int size = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
        if (error != std::errc() || size < 0 || size > kLargestArraySide) return {};
        shape.push_back(size);
        text.remove_prefix(end - text.data());
    }
    return shape;
}

template <class T>
Result<Image<T>> readArray(const std::filesystem::path& path, std::string_view type, int channels) {
    static_assert(std::endian::native == std::endian::little);
    const Result<std::string> bytes = readText(path);
    if (!bytes) return unreadableArray("it cannot be read");
    constexpr std::size_t kBefore = 10;
    if (bytes->size() < kBefore || !bytes->starts_with(std::string_view("\x93NUMPY\x01\x00", 8))) {
        return unreadableArray("it is not a .npy file of version 1.0");
    }
    const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>((*bytes)[i]); };
    const std::size_t length = byteAt(8) + 256U * byteAt(9);
    if (bytes->size() < kBefore + length) return unreadableArray("its header is truncated");
    const auto header = std::string_view(*bytes).substr(kBefore, length);
    const auto descr = valueOf(header, "descr");
    if (!descr || !descr->starts_with(fmt::format("'{}'", type))) {
        return unreadableArray(fmt::format("its type is not {}", type));
    }
    const auto order = valueOf(header, "fortran_order");
    if (!order || !order->starts_with("False")) return unreadableArray("it is not in C order");
    std::vector<int> shape = shapeFrom(valueOf(header, "shape").value_or(""));
    if (shape.size() == 1) shape.insert(shape.begin(), 1);
    const bool flat = shape.size() == 2 && channels == 1;
    const bool deep = shape.size() == 3 && shape[2] == channels;
    if (!flat && !deep) {
        return unreadableArray(
            fmt::format("its shape is not rows x columns with {} per pixel", channels));
    }
    Image<T> image{shape[1], shape[0], channels, {}};
    const std::size_t count = static_cast<std::size_t>(shape[0]) *
                              static_cast<std::size_t>(shape[1]) *
                              static_cast<std::size_t>(channels);
    if (bytes->size() - kBefore - length != count * sizeof(T)) {
        return unreadableArray(fmt::format("it has {} bytes of values, but its shape needs {}",
                                           bytes->size() - kBefore - length, count * sizeof(T)));
    }
    image.values.resize(count);
    std::memcpy(image.values.data(), bytes->data() + kBefore + length, count * sizeof(T));
    return image;
}

}  // namespace

Result<ImageF> readNumpyF(const std::filesystem::path& path, int channels) {
    return readArray<float>(path, "<f4", channels);
}

Result<Image8> readNumpy8(const std::filesystem::path& path, int channels) {
    return readArray<std::uint8_t>(path, "|u1", channels);
}

Result<Image8> readNumpyBool(const std::filesystem::path& path) {
    return readArray<std::uint8_t>(path, "|b1", 1);
}

Result<Image16> readNumpy16(const std::filesystem::path& path, int channels) {
    return readArray<std::uint16_t>(path, "<u2", channels);
}

}  // namespace dollytrack::verify
