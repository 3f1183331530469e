#include "engine/core/random.h"
#include "render/encoders/numpy_file.h"
#include "render/formats/labels/mask_outline.h"
#include "render/formats/poses/kitti.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::render::encodings_test {
namespace {

/// Winding number of an outline around a point, by brute force: counts edges that cross the ray to
/// the right.
int windings(const Outline& outline, double x, double y) {
    int count = 0;
    for (std::size_t i = 0; i < outline.corners.size(); ++i) {
        const Eigen::Vector2i& a = outline.corners[i];
        const Eigen::Vector2i& b = outline.corners[(i + 1) % outline.corners.size()];
        if (a.x() != b.x() || a.x() < x) continue;
        if (a.y() < y && b.y() > y) ++count;
        if (a.y() > y && b.y() < y) --count;
    }
    return count;
}

TEST(MaskOutline, GoesAroundExactlyThePixelsInside) {
    Random random(3);
    for (int round = 0; round < 400; ++round) {
        const int width = 1 + static_cast<int>(random.below(12));
        const int height = 1 + static_cast<int>(random.below(12));
        const std::uint32_t often = 1 + random.below(4);
        std::vector<std::uint8_t> mask(static_cast<std::size_t>(width) * height);
        for (auto& pixel : mask) pixel = random.below(4) < often ? 1 : 0;
        const auto outlines = outlinesOf(width, height, mask);
        for (const Outline& outline : outlines) {
            ASSERT_GE(outline.corners.size(), 4U);
            int doubled = 0;
            for (std::size_t i = 0; i < outline.corners.size(); ++i) {
                const Eigen::Vector2i a = outline.corners[i];
                const Eigen::Vector2i b = outline.corners[(i + 1) % outline.corners.size()];
                EXPECT_TRUE((a.x() == b.x()) != (a.y() == b.y()));  // along the pixels' borders
                doubled += a.x() * b.y() - a.y() * b.x();
            }
            EXPECT_EQ(doubled < 0, outline.hole);
        }
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                int around = 0;
                for (const Outline& outline : outlines) {
                    around += windings(outline, x + 0.5, y + 0.5);
                }
                ASSERT_EQ(around, mask[static_cast<std::size_t>(y) * width + x]) << x << " " << y;
            }
        }
    }
}

TEST(MaskOutline, ReadsRunLengthsDownTheColumns) {
    // 3 wide, 2 high; the second column and the pixel below it to the right are inside.
    const std::vector<std::uint32_t> counts = {2, 2, 1, 1};
    const auto outlines = outlinesOfCounts(3, 2, counts);
    ASSERT_EQ(outlines.size(), 1U);
    const std::vector<Eigen::Vector2i> expected = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {1, 2}};
    EXPECT_EQ(outlines[0].corners, expected);
}

TEST(KittiFlow, KeepsFlowToASixtyFourthOfAPixelOrSaysThatItCannot) {
    Random random(4);
    std::vector<Eigen::Vector2f> flows = {{1e10F, 1e10F}, {0, 0}, {511.98F, -512}, {0, 512}};
    for (int i = 0; i < 2000; ++i) {
        flows.emplace_back(static_cast<float>(random.uniform(-700, 700)),
                           static_cast<float>(random.uniform(-700, 700)));
    }
    const auto pixels = kittiFlow(flows);
    ASSERT_EQ(pixels.size(), 3 * flows.size());
    for (std::size_t i = 0; i < flows.size(); ++i) {
        const double u = flows[i].x(), v = flows[i].y();
        const std::uint16_t* p = &pixels[3 * i];
        const bool inside = std::max(std::abs(u), std::abs(v)) < 511.9;
        const bool outside = std::max(std::abs(u), std::abs(v)) > 512.1;
        if (inside || outside) {
            EXPECT_EQ(p[2], inside ? 1 : 0);
        }
        if (p[2] == 0) {
            EXPECT_EQ(p[0] + p[1], 0);
            continue;
        }
        EXPECT_NEAR((p[0] - 32768.0) / 64.0, u, 0.5 / 64.0 + 1e-4);
        EXPECT_NEAR((p[1] - 32768.0) / 64.0, v, 0.5 / 64.0 + 1e-4);
    }
}

TEST(NumpyFile, HasItsHeaderAndAlignsItsValues) {
    const std::vector<std::uint8_t> values = {1, 2, 3, 4, 5, 6};
    const auto bytes = numpyBytes("|u1", {2, 3}, values);
    const std::size_t header = bytes[8] + 256U * bytes[9];
    EXPECT_EQ((10 + header) % 64, 0U);
    ASSERT_EQ(bytes.size(), 10 + header + 6);
    const std::string text(bytes.begin() + 10, bytes.begin() + 10 + static_cast<long>(header));
    EXPECT_TRUE(text.starts_with("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, ), }"));
    EXPECT_EQ(text.back(), '\n');
    EXPECT_TRUE(std::equal(values.begin(), values.end(), bytes.end() - 6));
}

}  // namespace
}  // namespace dollytrack::render::encodings_test
