#include "render/frames/mask_rle.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <numeric>

namespace dollytrack::render::mask_rle_test {
namespace {

std::vector<std::uint16_t> randomIds(Random& random, int width, int height, int count) {
    std::vector<std::uint16_t> ids(static_cast<std::size_t>(width) * height);
    std::uint16_t id = 0;
    for (std::uint16_t& value : ids) {
        if (random.below(3) == 0) id = static_cast<std::uint16_t>(random.below(count + 1));
        value = id;
    }
    return ids;
}

/// Paints run lengths into an image, pixel by pixel down the columns.
std::vector<std::uint8_t> paint(const std::vector<std::uint32_t>& counts, int width, int height) {
    std::vector<std::uint8_t> image(static_cast<std::size_t>(width) * height);
    std::size_t place = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        for (std::uint32_t k = 0; k < counts[i]; ++k, ++place) {
            image[place % height * width + place / height] = i % 2;
        }
    }
    return image;
}

TEST(MaskRle, RandomMasksSurviveCompressionAndMatchTheirPixels) {
    Random random(11);
    for (int round = 0; round < 300; ++round) {
        const int width = 1 + static_cast<int>(random.below(40));
        const int height = 1 + static_cast<int>(random.below(40));
        const std::vector<std::uint16_t> ids = randomIds(random, width, height, 5);
        std::vector<int> pixels(6, 0);
        for (const std::uint16_t id : ids) ++pixels[id];
        int previous = 0;
        for (const ObjectMask& mask : objectMasks(width, height, ids)) {
            EXPECT_GT(mask.object_id, previous);
            previous = mask.object_id;
            ASSERT_EQ(std::accumulate(mask.counts.begin(), mask.counts.end(), 0U),
                      static_cast<unsigned>(width * height));
            const auto counts = decompressCounts(compressCounts(mask.counts));
            ASSERT_EQ(counts, mask.counts);
            const auto image = paint(counts, width, height);
            int x0 = width, y0 = height, x1 = -1, y1 = -1, area = 0;
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    const std::size_t i = static_cast<std::size_t>(y) * width + x;
                    ASSERT_EQ(image[i] != 0, ids[i] == mask.object_id);
                    if (image[i] == 0) continue;
                    ++area;
                    x0 = std::min(x0, x);
                    y0 = std::min(y0, y);
                    x1 = std::max(x1, x);
                    y1 = std::max(y1, y);
                }
            }
            EXPECT_EQ(mask.area, static_cast<unsigned>(area));
            EXPECT_EQ(mask.area, static_cast<unsigned>(pixels[mask.object_id]));
            EXPECT_EQ(mask.bbox, (std::array<int, 4>{x0, y0, x1 - x0 + 1, y1 - y0 + 1}));
        }
    }
}

// Worked by hand from the published description: groups of five bits, low first, 0x20 for "more",
// plus 48; from the third run on, differences to the run before the last.
TEST(MaskRle, CompressesTheKnownExamples) {
    EXPECT_EQ(compressCounts(std::array<std::uint32_t, 1>{6}), "6");
    EXPECT_EQ(compressCounts(std::array<std::uint32_t, 1>{16}), "`0");
    EXPECT_EQ(compressCounts(std::array<std::uint32_t, 4>{1, 2, 3, 1}), "123O");
    EXPECT_EQ(compressCounts(std::array<std::uint32_t, 2>{100, 1}), "T31");
}

TEST(MaskRle, BrokenTextGivesNothing) {
    EXPECT_TRUE(decompressCounts("`").empty());
    EXPECT_TRUE(decompressCounts("\x01").empty());
    EXPECT_TRUE(decompressCounts("zzzzzzzzzzzz").empty());
}

}  // namespace
}  // namespace dollytrack::render::mask_rle_test
