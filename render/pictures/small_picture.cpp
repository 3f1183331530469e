#include "render/pictures/small_picture.h"

#include "render/pictures/shown_picture.h"

#include <opencv2/imgcodecs.hpp>

namespace dollytrack::render {

const char* smallPictureType(std::string_view modality) {
    return modality == "instance" || modality == "semantic" ? "image/png" : "image/jpeg";
}

std::vector<std::uint8_t> encodeSmallPicture(const GuardedFolder& folder, const std::string& file,
                                             std::string_view modality, const ClassTable& classes,
                                             const SmallPictureSize& size) {
    cv::Mat picture = readShownPicture(folder, file, modality, classes, size.width_px);
    if (picture.empty()) return {};
    // Depth is grey: one channel says it all.
    if (modality.starts_with("depth")) cv::extractChannel(picture, picture, 0);
    std::vector<std::uint8_t> bytes;
    try {
        if (smallPictureType(modality) == std::string_view("image/png")) {
            cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
        } else {
            cv::imencode(
                ".jpg", picture, bytes,
                {cv::IMWRITE_JPEG_QUALITY, size.jpeg_quality, cv::IMWRITE_JPEG_OPTIMIZE, 1});
        }
    } catch (const cv::Exception&) {
        return {};
    }
    return bytes;
}

}  // namespace dollytrack::render
