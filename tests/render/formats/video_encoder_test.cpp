#include "render/formats/media/video_encoder.h"

#include <gtest/gtest.h>

#include <vector>

namespace dollytrack::render::video_encoder_test {
namespace {

std::string video(int width, int height, int frames) {
    auto encoder = VideoEncoder::begin(width, height, 10.0);
    EXPECT_TRUE(encoder) << describe(encoder.error());
    for (int i = 0; i < frames; ++i) {
        std::vector<std::uint8_t> rgb;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    rgb.push_back(static_cast<std::uint8_t>(3 * x + 5 * y * c + 7 * i));
                }
            }
        }
        EXPECT_TRUE(encoder->add(rgb));
    }
    const auto file = encoder->finish();
    EXPECT_TRUE(file) << describe(file.error());
    return file.value_or("");
}

// The file contains no date, no version and nothing that depends on the number of cores.
TEST(VideoEncoder, GivesTheSameBytesAgain) {
    const std::string file = video(96, 64, 40);
    for (int again = 0; again < 4; ++again) EXPECT_TRUE(file == video(96, 64, 40));
    EXPECT_EQ(file.substr(4, 4), "ftyp");
    EXPECT_NE(file.find("moov"), std::string::npos);
}

TEST(VideoEncoder, TakesOddSizes) {
    EXPECT_GT(video(95, 63, 3).size(), 500U);
}

TEST(VideoEncoder, RefusesAPictureOfAnotherSize) {
    auto encoder = VideoEncoder::begin(96, 64, 10.0);
    ASSERT_TRUE(encoder);
    EXPECT_FALSE(encoder->add(std::vector<std::uint8_t>(12)));
}

}  // namespace
}  // namespace dollytrack::render::video_encoder_test
