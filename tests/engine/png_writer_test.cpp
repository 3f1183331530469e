#include "engine/io/files/png_writer.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstring>

namespace dollytrack::png_writer_test {
namespace {

std::vector<std::uint8_t> randomBytes(std::size_t count) {
    Random random(7);
    std::vector<std::uint8_t> bytes(count);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
    return bytes;
}

cv::Mat decode(const std::vector<std::uint8_t>& png) {
    return cv::imdecode(png, cv::IMREAD_UNCHANGED);
}

TEST(PngWriter, Gray16ReadsBackBitForBitInOpenCv) {
    const std::vector<std::uint8_t> pixels = randomBytes(2UL * 37 * 23);
    const auto png = encodePng(37, 23, PngFormat::Gray16, pixels);
    ASSERT_TRUE(png);
    const cv::Mat image = decode(*png);
    ASSERT_EQ(image.type(), CV_16UC1);
    ASSERT_EQ(image.size(), cv::Size(37, 23));
    EXPECT_EQ(std::memcmp(image.data, pixels.data(), pixels.size()), 0);
}

TEST(PngWriter, Gray8ReadsBackBitForBitInOpenCv) {
    const std::vector<std::uint8_t> pixels = randomBytes(101UL * 3);
    const auto png = encodePng(101, 3, PngFormat::Gray8, pixels);
    ASSERT_TRUE(png);
    const cv::Mat image = decode(*png);
    ASSERT_EQ(image.type(), CV_8UC1);
    EXPECT_EQ(std::memcmp(image.data, pixels.data(), pixels.size()), 0);
}

TEST(PngWriter, Rgb8KeepsItsChannelOrder) {
    const std::vector<std::uint8_t> pixels = randomBytes(3UL * 20 * 10);
    const auto png = encodePng(20, 10, PngFormat::Rgb8, pixels);
    ASSERT_TRUE(png);
    const cv::Mat image = decode(*png);  // OpenCV holds blue, green, red
    ASSERT_EQ(image.type(), CV_8UC3);
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 20; ++x) {
            const std::uint8_t* rgb = &pixels[3UL * (20 * y + x)];
            EXPECT_EQ(image.at<cv::Vec3b>(y, x), cv::Vec3b(rgb[2], rgb[1], rgb[0]));
        }
    }
}

TEST(PngWriter, TheSmallestFileHasTheSamePixels) {
    std::vector<std::uint8_t> labels(3UL * 96 * 64);  // areas of few colours, as in label images
    for (std::size_t i = 0; i < labels.size(); ++i) {
        labels[i] = static_cast<std::uint8_t>(60 * (i / 3 % 96 / 20) + 10 * (i / 3 / 96 / 9));
    }
    const auto fast = encodePng(96, 64, PngFormat::Rgb8, labels);
    const auto smallest = encodePng(96, 64, PngFormat::Rgb8, labels, PngEffort::Smallest);
    ASSERT_TRUE(fast && smallest);
    EXPECT_LT(smallest->size(), fast->size());
    EXPECT_EQ(cv::norm(decode(*smallest), decode(*fast), cv::NORM_INF), 0.0);
}

TEST(PngWriter, RefusesABufferOfTheWrongSize) {
    EXPECT_FALSE(encodePng(4, 4, PngFormat::Rgb8, randomBytes(47)));
}

}  // namespace
}  // namespace dollytrack::png_writer_test
