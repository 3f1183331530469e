#include "render/verify/read/image_files.h"

#include "engine/io/files/text_file.h"
#include "engine/io/pictures/codecs.h"
#include "render/verify/read/exr_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace dollytrack::verify {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestImageSide = 1 << 14;  // px, limit for a valid dataset
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26U;

tl::unexpected<Error> unreadableImage(std::string message) {
    return fail(ErrorCode::BadInput, std::move(message));
}

Result<std::string> bytesOf(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) return unreadableImage("it is missing");
    Result<std::string> bytes = readText(path);
    if (!bytes) return unreadableImage("it cannot be read: " + bytes.error().message);
    return bytes;
}

/// Width and height that the header of a PNG file declares, px; small numbers where it is cut off.
std::array<std::uint64_t, 2> pngSides(std::string_view png) {
    constexpr std::size_t kWidth = 16;  // where it begins, the highest byte first; then the height
    std::array<std::uint64_t, 2> sides = {};
    for (std::size_t i = 0; i < 8 && kWidth + i < png.size(); ++i) {
        std::uint64_t& side = sides[i / 4];
        side = 256 * side + static_cast<std::uint8_t>(png[kWidth + i]);
    }
    return sides;
}

/// The decoder stops after the last row, so the end marker is checked here, and the declared size.
Status endsAsPng(const std::string& bytes) {
    constexpr std::string_view kBegin = "\x89PNG\r\n\x1a\n";
    constexpr std::string_view kEnd = "IEND\xae\x42\x60\x82";
    if (!bytes.starts_with(kBegin)) return unreadableImage("it is not a PNG file");
    std::uint64_t pixels = 1;
    for (const std::uint64_t side : pngSides(bytes)) {
        if (side > kLargestImageSide)
            return unreadableImage(fmt::format("its header declares {} px", side));
        pixels *= side;
    }
    if (pixels > kMostPixels)
        return unreadableImage(fmt::format("its header declares {} px", pixels));
    if (!bytes.ends_with(kEnd))
        return unreadableImage("it is truncated, or followed by extra data");
    return {};
}

Result<DecodedPicture> decode(const std::string& bytes, int bits, int channels) {
    std::optional<DecodedPicture> picture =
        unpackPicture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    if (!picture) return unreadableImage("it cannot be decoded");
    if (picture->bits != bits || picture->channels != channels) {
        return unreadableImage(fmt::format("it is {} bit x {}, expected {} bit x {}", picture->bits,
                                           picture->channels, bits, channels));
    }
    return std::move(*picture);
}

/// The decoder fills truncated JPEG files with grey.
Status endsAsJpeg(const std::string& bytes) {
    if (!bytes.starts_with("\xff\xd8")) return unreadableImage("it is not a JPEG file");
    if (!bytes.ends_with("\xff\xd9")) {
        return unreadableImage("it is truncated, or followed by extra data");
    }
    return {};
}

template <class T>
Result<Image<T>> readPicture(const fs::path& path, int channels) {
    const Result<std::string> bytes = bytesOf(path);
    if (!bytes) return tl::unexpected(bytes.error());
    const Status whole = path.extension() == ".jpg" ? endsAsJpeg(*bytes) : endsAsPng(*bytes);
    if (!whole) return tl::unexpected(whole.error());
    const Result<DecodedPicture> picture = decode(*bytes, 8 * sizeof(T), channels);
    if (!picture) return tl::unexpected(picture.error());
    Image<T> image{picture->width, picture->height, channels, {}};
    image.values.resize(picture->data.size() / sizeof(T));
    std::memcpy(image.values.data(), picture->data.data(), picture->data.size());
    return image;
}

template <class T>
T numberAt(const std::string& bytes, std::size_t place) {
    static_assert(std::endian::native == std::endian::little);
    T value;
    std::memcpy(&value, bytes.data() + place, sizeof(T));
    return value;
}

}  // namespace

Result<Image8> readImage8(const fs::path& path, int channels) {
    return readPicture<std::uint8_t>(path, channels);
}

Result<Image16> readImage16(const fs::path& path, int channels) {
    return readPicture<std::uint16_t>(path, channels);
}

Result<Image16> widened(const Result<Image8>& image) {
    if (!image) return tl::unexpected(image.error());
    return Image16{
        image->width, image->height, image->channels, {image->values.begin(), image->values.end()}};
}

Result<Image16> readClasses(const fs::path& path, bool wide) {
    return wide ? readImage16(path, 1) : widened(readImage8(path, 1));
}

Result<ImageF> readImageF(const fs::path& path, int channels) {
    const Result<std::string> bytes = bytesOf(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return decodeExr(*bytes, channels);
}

Result<ImageF> readFlow(const fs::path& path) {
    const Result<std::string> bytes = bytesOf(path);
    if (!bytes) return tl::unexpected(bytes.error());
    constexpr std::size_t kHead = 12;
    if (bytes->size() < kHead || !bytes->starts_with("PIEH")) {
        return unreadableImage("it is not a .flo file");
    }
    const int width = numberAt<std::int32_t>(*bytes, 4);
    const int height = numberAt<std::int32_t>(*bytes, 8);
    if (width < 1 || height < 1 || width > kLargestImageSide || height > kLargestImageSide) {
        return unreadableImage(fmt::format("it claims {} x {} px", width, height));
    }
    ImageF image{width, height, 2, {}};
    const std::size_t count =
        2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (bytes->size() != kHead + 4 * count) {
        return unreadableImage(fmt::format("it has {} bytes, but {} x {} px need {}", bytes->size(),
                                           width, height, kHead + 4 * count));
    }
    image.values.resize(count);
    std::memcpy(image.values.data(), bytes->data() + kHead, 4 * count);
    return image;
}

}  // namespace dollytrack::verify
