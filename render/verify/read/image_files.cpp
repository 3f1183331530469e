#include "render/verify/read/image_files.h"

#include "engine/io/files/text_file.h"
#include "render/pictures/picture_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
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

/// OpenCV decodes truncated PNG files without error, so the end marker and the size are checked
/// here.
Status endsAsPng(const std::string& bytes) {
    constexpr std::string_view kBegin = "\x89PNG\r\n\x1a\n";
    constexpr std::string_view kEnd = "IEND\xae\x42\x60\x82";
    if (!bytes.starts_with(kBegin)) return unreadableImage("it is not a PNG file");
    std::uint64_t pixels = 1;
    for (const std::uint64_t side : render::pngSides(bytes)) {
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

Result<cv::Mat> decode(const std::string& bytes, int depth, int channels) {
    cv::Mat picture;
    if (bytes.empty()) return unreadableImage("it is empty");
    try {
        const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                          const_cast<char*>(bytes.data()));
        picture = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception& error) {
        return unreadableImage(fmt::format("it cannot be decoded ({})", error.err));
    }
    if (picture.empty()) return unreadableImage("it cannot be decoded");
    if (picture.depth() != depth || picture.channels() != channels) {
        const auto kind = [](int one, int count) {
            return fmt::format("{} bit x {}", 8 * CV_ELEM_SIZE1(one), count);
        };
        return unreadableImage(fmt::format("it is {}, expected {}",
                                           kind(picture.depth(), picture.channels()),
                                           kind(depth, channels)));
    }
    return picture;
}

template <class T>
Image<T> imageFrom(const cv::Mat& picture) {
    const int channels = picture.channels();
    Image<T> image{picture.cols, picture.rows, channels, {}};
    image.values.resize(picture.total() * static_cast<std::size_t>(channels));
    auto to = image.values.begin();
    for (int y = 0; y < picture.rows; ++y) {
        const T* from = picture.ptr<T>(y);
        for (int x = 0; x < picture.cols; ++x, from += channels, to += channels) {
            std::reverse_copy(from, from + channels, to);  // OpenCV stores blue first
        }
    }
    return image;
}

/// OpenCV decodes truncated JPEG files too, filling with grey.
Status endsAsJpeg(const std::string& bytes) {
    if (!bytes.starts_with("\xff\xd8")) return unreadableImage("it is not a JPEG file");
    if (!bytes.ends_with("\xff\xd9")) {
        return unreadableImage("it is truncated, or followed by extra data");
    }
    return {};
}

template <class T>
Result<Image<T>> readPicture(const fs::path& path, int depth, int channels) {
    const Result<std::string> bytes = bytesOf(path);
    if (!bytes) return tl::unexpected(bytes.error());
    const Status whole = path.extension() == ".jpg" ? endsAsJpeg(*bytes) : endsAsPng(*bytes);
    if (!whole) return tl::unexpected(whole.error());
    const Result<cv::Mat> picture = decode(*bytes, depth, channels);
    if (!picture) return tl::unexpected(picture.error());
    return imageFrom<T>(*picture);
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
    return readPicture<std::uint8_t>(path, CV_8U, channels);
}

Result<Image16> readImage16(const fs::path& path, int channels) {
    return readPicture<std::uint16_t>(path, CV_16U, channels);
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
    // Debian's OpenCV reads OpenEXR only if this variable is set before the first use.
    static const int told = ::setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
    (void)told;
    const Result<std::string> bytes = bytesOf(path);
    if (!bytes) return tl::unexpected(bytes.error());
    const Result<cv::Mat> picture = decode(*bytes, CV_32F, channels);
    if (!picture) return tl::unexpected(picture.error());
    return imageFrom<float>(*picture);
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
