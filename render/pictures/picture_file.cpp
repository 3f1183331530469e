#include "render/pictures/picture_file.h"

#include "engine/io/files/text_file.h"

#include <opencv2/imgcodecs.hpp>

namespace dollytrack::render {
namespace {

constexpr std::uint64_t kMostPicturePixels = std::uint64_t{1} << 26U;  // exports have 8192 x 8192

bool isTooLargePng(std::string_view bytes) {
    if (!bytes.starts_with("\x89PNG")) return false;
    const auto [width, height] = pngSides(bytes);
    return width * height > kMostPicturePixels;  // of 32 bits each
}

cv::Mat decodePicture(const Result<std::string>& bytes, int flags) {
    if (!bytes || bytes->empty() || isTooLargePng(*bytes)) return {};
    const cv::Mat raw(1, static_cast<int>(bytes->size()), CV_8UC1,
                      const_cast<char*>(bytes->data()));
    try {
        return cv::imdecode(raw, flags);
    } catch (const cv::Exception&) {
        return {};
    }
}

}  // namespace

std::array<std::uint64_t, 2> pngSides(std::string_view png) {
    constexpr std::size_t kWidth = 16;  // where it begins, the highest byte first; then the height
    std::array<std::uint64_t, 2> sides = {};
    for (std::size_t i = 0; i < 8 && kWidth + i < png.size(); ++i) {
        std::uint64_t& side = sides[i / 4];
        side = 256 * side + static_cast<std::uint8_t>(png[kWidth + i]);
    }
    return sides;
}

cv::Mat readPictureFile(const std::filesystem::path& path, int flags) {
    return decodePicture(readText(path), flags);
}

cv::Mat readPictureFile(const GuardedFolder& folder, const std::string& name, int flags) {
    const Result<InputFile> file = folder.openInput(name);
    return file ? decodePicture(file->readAll(kMostTextBytes), flags) : cv::Mat();
}

}  // namespace dollytrack::render
