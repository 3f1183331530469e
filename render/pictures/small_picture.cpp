#include "render/pictures/small_picture.h"

#include "engine/io/files/jpeg_writer.h"
#include "engine/io/files/png_writer.h"
#include "render/pictures/shown_picture.h"

namespace dollytrack::render {

const char* smallPictureType(std::string_view modality) {
    return modality == "instance" || modality == "semantic" ? "image/png" : "image/jpeg";
}

std::vector<std::uint8_t> encodeSmallPicture(const GuardedFolder& folder, const std::string& file,
                                             std::string_view modality, const ClassTable& classes,
                                             const SmallPictureSize& size) {
    cv::Mat picture = readShownPicture(folder, file, modality, classes, size.width_px);
    if (picture.empty()) return {};
    const auto bytesOf = [](const cv::Mat& image) {
        return std::span<const std::uint8_t>(image.data, image.total() * image.elemSize());
    };
    Result<std::vector<std::uint8_t>> bytes;
    if (smallPictureType(modality) == std::string_view("image/png")) {
        bytes = encodePng(picture.cols, picture.rows, PngFormat::Rgb8, bytesOf(picture),
                          PngEffort::Smallest);
    } else {
        // Depth is grey: one channel says it all.
        if (modality.starts_with("depth")) cv::extractChannel(picture, picture, 0);
        bytes = encodeJpeg(picture.cols, picture.rows, picture.channels(), size.jpeg_quality,
                           bytesOf(picture), JpegTables::Optimized);
    }
    return bytes ? std::move(*bytes) : std::vector<std::uint8_t>();
}

}  // namespace dollytrack::render
