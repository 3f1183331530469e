#include "render/verify/compare/picture_edges.h"

#include "engine/core/random.h"
#include "render/verify/compare/label_alignment_check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dollytrack::verify::picture_edges_test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

struct Box {
    int x0, y0, x1, y1;
    int id;
};

const std::vector<Box> kBoxes = {{12, 20, 70, 90, 1}, {90, 10, 130, 50, 2}, {80, 70, 148, 100, 3}};

Image16 labels(const std::vector<Box>& boxes) {
    Image16 ids{kWidth, kHeight, 1, std::vector<std::uint16_t>(kWidth * kHeight, 9)};
    for (const Box& box : boxes) {
        for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; ++x) {
                ids.values[y * kWidth + x] = static_cast<std::uint16_t>(box.id);
            }
        }
    }
    return ids;
}

/// An image with a grey value for each id, `contrast` of 255 apart, and the given amount of noise.
Image8 pictureOf(const Image16& ids, int contrast, int noise) {
    Random random(3);
    Image8 picture{kWidth, kHeight, 3, {}};
    for (const std::uint16_t id : ids.values) {
        for (int c = 0; c < 3; ++c) {
            const int shade = 12 + contrast * (id % 9) + static_cast<int>(random.below(noise + 1));
            picture.values.push_back(static_cast<std::uint8_t>(std::min(shade, 255)));
        }
    }
    return picture;
}

Image8 moved(const Image8& picture, int dx, int dy) {
    Image8 result = picture;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::uint8_t* from = picture.pixel(std::clamp(x - dx, 0, kWidth - 1),
                                                     std::clamp(y - dy, 0, kHeight - 1));
            std::copy(from, from + 3, result.values.begin() + 3 * (y * kWidth + x));
        }
    }
    return result;
}

Image8 mirroredPicture(const Image8& picture) {
    Image8 result = picture;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::uint8_t* from = picture.pixel(kWidth - 1 - x, y);
            std::copy(from, from + 3, result.values.begin() + 3 * (y * kWidth + x));
        }
    }
    return result;
}

OutlineAlignment alignmentIn(const Image8& picture, const Image16& ids) {
    return alignmentOf(GradientMap(picture), outlinesOf(ids, false));
}

TEST(PictureEdges, APictureOfItsLabelsIsExplainedHoweverDark) {
    const Image16 ids = labels(kBoxes);
    for (const int contrast : {1, 3, 10, 60}) {
        const OutlineAlignment fit = alignmentIn(pictureOf(ids, contrast, 0), ids);
        EXPECT_GT(fit.own.rank, 0.95) << contrast;
        EXPECT_EQ(fit.elsewhere, "") << contrast;
    }
}

TEST(PictureEdges, AMovedOrMirroredPictureIsToldWithWhatExplainsIt) {
    const Image16 ids = labels(kBoxes);
    const Image8 picture = pictureOf(ids, 30, 6);
    EXPECT_EQ(alignmentIn(moved(picture, 8, 0), ids).elsewhere, "moved by about (8, 0) px");
    EXPECT_EQ(alignmentIn(moved(picture, -4, 12), ids).elsewhere, "moved by about (-4, 12) px");
    EXPECT_EQ(alignmentIn(mirroredPicture(picture), ids).elsewhere, "mirrored left to right");
    EXPECT_EQ(alignmentIn(picture, ids).elsewhere, "");
}

TEST(PictureEdges, APictureOfSomethingElseIsNotExplained) {
    const Image16 ids = labels(kBoxes);
    const Image16 other =
        labels({{30, 5, 45, 115, 4}, {60, 30, 75, 118, 5}, {104, 55, 158, 64, 6}});
    const OutlineAlignment fit = alignmentIn(pictureOf(other, 30, 6), ids);
    EXPECT_LT(fit.best, 0.65);
    const GradientMap gradients(pictureOf(other, 30, 6));
    EXPECT_TRUE(explainsBetter(gradients.fit(outlinesOf(other, false)), fit.own));
    EXPECT_FALSE(explainsBetter(fit.own, gradients.fit(outlinesOf(other, false))));
}

// A door in a wall of the same colour: only a groove a few pixels inside the border is visible.
TEST(PictureEdges, ALineBesideAFaintBorderProvesNothing) {
    const Image16 ids = labels({{40, 0, 110, 95, 1}});
    Image8 picture = pictureOf(ids, 0, 2);
    for (int y = 0; y < 90; ++y) {
        for (int x = 104; x < 106; ++x) {
            for (int c = 0; c < 3; ++c) {
                picture.values[3 * (y * kWidth + x) + c] = 60;
            }
        }
    }
    const Outlines outlines = outlinesOf(ids, false);
    EXPECT_EQ(alignmentOf(GradientMap(picture), outlines).elsewhere, "");
}

TEST(PictureEdges, ABlankPictureHasOneColour) {
    EXPECT_TRUE(isBlank(pictureOf(labels({}), 0, 0)));
    EXPECT_FALSE(isBlank(pictureOf(labels(kBoxes), 1, 0)));
}

TEST(PictureEdges, MirroredOutlinesAreThoseOfTheMirroredImage) {
    const Image16 ids = labels(kBoxes);
    Image16 mirrored_ids = ids;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            mirrored_ids.values[y * kWidth + x] = ids.at(kWidth - 1 - x, kHeight - 1 - y);
        }
    }
    const auto sorted = [](std::vector<std::array<int, 2>> places) {
        std::sort(places.begin(), places.end());
        return places;
    };
    const Outlines expected = outlinesOf(mirrored_ids, false);
    const Outlines found = mirrored(outlinesOf(ids, false), true, true);
    EXPECT_EQ(sorted(found.across), sorted(expected.across));
    EXPECT_EQ(sorted(found.down), sorted(expected.down));
}

TEST(PictureEdges, BordersWithNothingCanBeLeftOut) {
    Image16 ids = labels({{20, 20, 60, 60, 1}, {60, 20, 100, 60, 2}});
    for (std::uint16_t& id : ids.values) id = id == 9 ? 0 : id;
    EXPECT_EQ(outlinesOf(ids, true).count(), 40U);
    EXPECT_EQ(outlinesOf(ids, false).count(), 40U + 2 * 80 + 2 * 40);
}

/// Findings for eight frames of which the first is evenly grey, with dark bands, although its
/// labels have stripes of the walls 1 and 2. In the other frames, wall 2 has the given colour.
std::size_t findingsOfAStripedWall(int wall_colour) {
    std::vector<Image16> ids;
    std::vector<Image8> pictures;
    std::vector<Box> stripes;
    for (int x = 20; x < 140; x += 10) stripes.push_back({x, 0, x + 10, kHeight, 1 + x / 10 % 2});
    ids.push_back(labels(stripes));
    Image8 grey = pictureOf(labels({}), 0, 2);
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
        const std::size_t row = i / (3 * kWidth);
        grey.values[i] = static_cast<std::uint8_t>(row % 40 < 3 ? 50 : grey.values[i] + 108);
    }
    pictures.push_back(grey);
    for (int i = 1; i < 8; ++i) {
        std::vector<Box> boxes = kBoxes;
        for (Box& box : boxes) {
            box.x0 += i;
            box.x1 += i;
        }
        ids.push_back(labels(boxes));
        Image8 picture = pictureOf(labels({}), 0, 2);
        for (std::size_t pixel = 0; pixel < ids.back().values.size(); ++pixel) {
            const int id = ids.back().values[pixel];
            const int colour = id == 1 ? 150 : id == 2 ? wall_colour : id == 3 ? 60 : 140;
            for (std::size_t c = 0; c < 3; ++c) {
                std::uint8_t& value = picture.values[3 * pixel + c];
                value = static_cast<std::uint8_t>(value - 12 + colour);
            }
        }
        pictures.push_back(picture);
    }
    LabelAlignmentCheck check(ids.size(), false);
    for (std::size_t i = 0; i < ids.size(); ++i) check.addFrame(i, pictures[i], ids[i]);
    Findings findings;
    check.report(
        {[](int) { return std::string("rgb.png"); }, [&](int frame) { return pictures[frame]; },
         [&](int frame) { return ids[frame]; }},
        findings);
    return findings.count;
}

// Two walls in one plane, whose ids alternate in stripes, show no edge if they look alike.
TEST(LabelAlignment, BordersBetweenObjectsOfOneColourProveNothing) {
    EXPECT_EQ(findingsOfAStripedWall(145), 0U);
    EXPECT_EQ(findingsOfAStripedWall(220), 1U);
}

}  // namespace
}  // namespace dollytrack::verify::picture_edges_test
