#include "render/verify/read/exr_file.h"

#include "render/encoders/exr.h"

#include <gtest/gtest.h>

namespace dollytrack::verify::exr_file_test {
namespace {

std::string exr() {
    const std::vector<float> values = {0.5F, 1.25F, -3.0F, 1e30F, 0.0F, 7.0F};
    const auto bytes = render::encodeExr(3, 2, values);
    EXPECT_TRUE(bytes);
    return {bytes->begin(), bytes->end()};
}

TEST(ExrFile, ReadsWhatWasWritten) {
    const auto image = decodeExr(exr());
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 3);
    EXPECT_EQ(image->height, 2);
    EXPECT_EQ(image->channels, 1);
    EXPECT_EQ(image->values, (std::vector<float>{0.5F, 1.25F, -3.0F, 1e30F, 0.0F, 7.0F}));
}

TEST(ExrFile, ReadsColoursAsTheyWereRounded) {
    const std::vector<Eigen::Vector3f> values = {{0.1F, 1.0F, -3.0F},
                                                 {1e-9F, 70000.0F, 2.0F},
                                                 {0.5F, 0.25F, 0.0F},
                                                 {1.0F / 3.0F, 4.0F, 5.0F}};
    const auto bytes = render::encodeExr(2, 2, values);
    ASSERT_TRUE(bytes);
    const std::string file(bytes->begin(), bytes->end());
    const auto image = decodeExr(file, 3);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->channels, 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Eigen::Vector3f rounded = render::roundedToHalf(values[i]);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(image->values[3 * i + static_cast<std::size_t>(c)], rounded[c]);
        }
    }
    // 10 binary digits after the first; the largest 16-bit float is 65504.
    EXPECT_NEAR(image->values[0], 0.1F, 0.1F / 2048.0F);
    EXPECT_EQ(image->values[4], 65504.0F);
    EXPECT_FALSE(decodeExr(file));
    EXPECT_FALSE(decodeExr(exr(), 3));
}

TEST(ExrFile, RefusesDamagedFilesAndOtherChannels) {
    const std::string whole = exr();
    for (std::size_t size = 0; size < whole.size(); size += 9) {
        EXPECT_FALSE(decodeExr(std::string_view(whole).substr(0, size))) << size;
    }
    std::string renamed = whole;
    const std::size_t at = renamed.find("chlist");
    ASSERT_NE(at, std::string::npos);
    const std::size_t name = renamed.find('Y', at);
    ASSERT_NE(name, std::string::npos);
    renamed[name] = 'Z';
    const auto image = decodeExr(renamed);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().message, "it has no channel 'Y'");
}

TEST(ExrFile, RefusesASizeThatWouldTakeGigabytes) {
    std::string huge = exr();
    const std::size_t window = huge.find("dataWindow");
    ASSERT_NE(window, std::string::npos);
    const std::size_t values = huge.find("box2i", window) + 6 + 4;  // after its name and size
    huge[values + 8 + 3] = 0x3f;  // the highest byte of its right end
    EXPECT_FALSE(decodeExr(huge));
}

}  // namespace
}  // namespace dollytrack::verify::exr_file_test
