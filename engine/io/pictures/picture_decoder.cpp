#include "engine/io/pictures/picture_decoder.h"

#include "engine/io/pictures/codecs.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace dollytrack {

std::optional<DecodedPicture> unpackPicture(PictureBytes bytes) {
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()),
                                std::min<std::size_t>(bytes.size(), 16));
    if (head.starts_with("\x89PNG")) return unpackPng(bytes);
    if (head.starts_with("\xFF\xD8")) return unpackJpeg(bytes);
    if (head.starts_with("RIFF") && head.find("WEBP") == 8) return unpackWebp(bytes);
    if (head.starts_with("II") || head.starts_with("MM")) return unpackTiff(bytes);
    return unpackOther(bytes);
}

bool makeRoom(std::int64_t width, std::int64_t height, int channels, int bits,
              DecodedPicture& picture) {
    if (width <= 0 || height <= 0 || width > kMostPicturePixels || height > kMostPicturePixels ||
        width * height > kMostPicturePixels || channels < 1 || channels > 4) {
        return false;
    }
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    picture.channels = channels;
    picture.bits = bits;
    picture.data.resize(static_cast<std::size_t>(width * height) *
                        static_cast<std::size_t>(channels * bits / 8));
    return true;
}

bool decodePicture(std::span<const std::uint8_t> bytes, int longest_side, bool opaque,
                   Texture& texture) {
    if (bytes.empty()) return false;
    try {
        std::optional<DecodedPicture> picture = unpackPicture(bytes);
        if (!picture) return false;
        cv::Mat image(picture->height, picture->width,
                      CV_MAKETYPE(picture->bits == 16 ? CV_16U : CV_8U, picture->channels),
                      picture->data.data());
        if (picture->bits == 16) image.convertTo(image, CV_8U, 1.0 / 257.0);
        const int longest = std::max(image.cols, image.rows);
        if (longest > longest_side) {
            const double scale = static_cast<double>(longest_side) / longest;
            cv::resize(image, image,
                       {std::max(1, static_cast<int>(std::lround(image.cols * scale))),
                        std::max(1, static_cast<int>(std::lround(image.rows * scale)))},
                       0, 0, cv::INTER_AREA);
        }
        if (image.channels() == 2) {
            cv::Mat rgba;
            cv::mixChannels({image}, {rgba = cv::Mat(image.size(), CV_8UC4)},
                            {0, 0, 0, 1, 0, 2, 1, 3});
            image = rgba;
        } else if (image.channels() != 4) {
            cv::cvtColor(image, image,
                         image.channels() == 1 ? cv::COLOR_GRAY2RGBA : cv::COLOR_RGB2RGBA);
        }
        texture.width = image.cols;
        texture.height = image.rows;
        texture.rgba.assign(image.data, image.data + image.total() * 4);
    } catch (const cv::Exception&) {
        return false;
    }
    if (opaque) {
        for (std::size_t i = 3; i < texture.rgba.size(); i += 4) texture.rgba[i] = 255;
    }
    return true;
}

}  // namespace dollytrack
