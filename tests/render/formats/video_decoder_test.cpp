#include "render/formats/media/video_decoder.h"
#include "render/formats/media/video_encoder.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::render::video_decoder_test {
namespace {

constexpr int kWidth = 65;  // odd: the video has one column less
constexpr int kHeight = 48;

/// A uniform image with a colour of its own for each frame.
std::vector<std::uint8_t> imageOf(int frame) {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        for (const int value : {40 * frame, 200 - 30 * frame, 90}) {
            rgb.push_back(static_cast<std::uint8_t>(value));
        }
    }
    return rgb;
}

std::string video(int frames) {
    auto encoder = VideoEncoder::begin(kWidth, kHeight, 12.5);
    EXPECT_TRUE(encoder);
    for (int i = 0; encoder && i < frames; ++i) EXPECT_TRUE(encoder->add(imageOf(i)));
    auto bytes = encoder->finish();
    EXPECT_TRUE(bytes);
    return bytes ? *bytes : std::string();
}

Result<VideoDecoder> opened(const test::TempFolder& folder, const std::string& bytes) {
    auto file = openNamedFile(folder.write("video.mp4", bytes));
    if (!file) return tl::unexpected(file.error());
    return VideoDecoder::open(std::move(*file));
}

TEST(VideoDecoder, DecodesEachImageInOrder) {
    const test::TempFolder folder;
    auto decoder = opened(folder, video(5));
    ASSERT_TRUE(decoder);
    EXPECT_NEAR(decoder->framesPerSecond(), 12.5, 1e-6);
    for (int frame = 0; frame < 5; ++frame) {
        const auto picture = decoder->next();
        ASSERT_TRUE(picture) << frame;
        EXPECT_EQ(picture->width, kWidth - 1);
        EXPECT_EQ(picture->height, kHeight);
        const std::vector<std::uint8_t> expected = imageOf(frame);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(picture->data[3 * 700 + c], expected[c], 4) << frame << ' ' << c;
        }
    }
    EXPECT_FALSE(decoder->next());
    EXPECT_FALSE(decoder->next());
}

TEST(VideoDecoder, DamagedFilesEndEarlyOrAreRefused) {
    const test::TempFolder folder;
    const std::string whole = video(5);
    EXPECT_FALSE(opened(folder, ""));
    EXPECT_FALSE(opened(folder, "no video"));
    EXPECT_FALSE(opened(folder, whole.substr(0, whole.size() / 4)));
    for (std::size_t at = 40; at < whole.size(); at += 7) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(~damaged[at]);
        auto decoder = opened(folder, damaged);
        for (int frame = 0; decoder && frame < 100; ++frame) {
            if (!decoder->next()) break;
        }
    }
}

}  // namespace
}  // namespace dollytrack::render::video_decoder_test
