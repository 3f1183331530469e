#include "engine/io/files/jpeg_writer.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <limits>

namespace dollytrack::jpeg_writer_test {
namespace {

/// A smooth gradient with a little noise, 3 bytes per pixel.
cv::Mat rgbImage(int width, int height) {
    Random random(3);
    cv::Mat image(height, width, CV_8UC3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int noise = static_cast<int>(random.below(9));
            image.at<cv::Vec3b>(y, x) = {cv::saturate_cast<std::uint8_t>(2 * x + noise),
                                         cv::saturate_cast<std::uint8_t>(255 - 2 * y),
                                         cv::saturate_cast<std::uint8_t>(x + y + noise)};
        }
    }
    return image;
}

std::span<const std::uint8_t> bytesOf(const cv::Mat& image) {
    return {image.data, image.total() * image.elemSize()};
}

TEST(JpegWriter, WritesTheBytesThatOpenCvWrites) {
    const cv::Mat rgb = rgbImage(61, 43);
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    for (const int quality : {1, 50, 90, 100}) {
        for (const bool optimized : {false, true}) {
            const auto bytes = encodeJpeg(61, 43, 3, quality, bytesOf(rgb),
                                          optimized ? JpegTables::Optimized : JpegTables::Standard);
            ASSERT_TRUE(bytes);
            std::vector<std::uint8_t> expected;
            cv::imencode(
                ".jpg", bgr, expected,
                {cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE, optimized ? 1 : 0});
            EXPECT_EQ(*bytes, expected) << quality << ' ' << optimized;
        }
    }
}

TEST(JpegWriter, WritesGreyImages) {
    cv::Mat grey;
    cv::cvtColor(rgbImage(40, 30), grey, cv::COLOR_RGB2GRAY);
    const auto bytes = encodeJpeg(40, 30, 1, 95, bytesOf(grey));
    ASSERT_TRUE(bytes);
    const cv::Mat read = cv::imdecode(*bytes, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(read.type(), CV_8UC1);
    EXPECT_LT(cv::norm(read, grey, cv::NORM_INF), 16.0);
}

TEST(JpegWriter, RefusesSizesThatDoNotFit) {
    const std::vector<std::uint8_t> pixels(70'000);
    EXPECT_FALSE(encodeJpeg(4, 4, 3, 90, std::span(pixels).first(47)));
    EXPECT_FALSE(encodeJpeg(0, 0, 3, 90, {}));
    const auto too_wide = encodeJpeg(70'000, 1, 1, 90, pixels);
    ASSERT_FALSE(too_wide);
    EXPECT_NE(too_wide.error().message.find("65500"), std::string::npos)
        << too_wide.error().message;
}

}  // namespace
}  // namespace dollytrack::jpeg_writer_test
