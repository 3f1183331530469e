#include "render/dataset/size_estimate.h"

#include "render/encoders/modalities.h"
#include "render/formats/formats.h"

#include <gtest/gtest.h>

namespace dollytrack::render::size_estimate_test {
namespace {

// Middlebury's files are not compressed: eight bytes per pixel, for each frame that has flow.
TEST(SizeEstimate, ExpectsTheFilesOfEveryDistanceThatFlowGoesTo) {
    const Scene scene;
    DatasetContents contents{scene, {}, *chooseModalities({"flow_forward"}), {}};
    contents.camera.width_px = 1000;
    contents.camera.height_px = 1000;
    for (const std::vector<int>& distances : {std::vector{1}, {1, 5, 10}}) {
        contents.flow_distances = distances;
        EXPECT_GE(estimateBytes(contents, {}, 10), 10U * distances.size() * 8'000'000U);
        EXPECT_LE(estimateBytes(contents, {}, 10), 10U * distances.size() * 9'000'000U);
    }
    contents.modalities = *chooseModalities({"rgb"});
    const std::uint64_t of_pictures = estimateBytes(contents, {}, 10);
    contents.flow_distances = {1};
    EXPECT_EQ(estimateBytes(contents, {}, 10), of_pictures);
}

// 21 bytes for each track and frame; the number of tracks is limited.
TEST(SizeEstimate, ExpectsTracksNotToGrowWithLargeImages) {
    const Scene scene;
    DatasetContents contents{scene, {}, *chooseModalities({"tracks"}), {}};
    contents.camera.width_px = 320;
    contents.camera.height_px = 240;
    EXPECT_GE(estimateBytes(contents, {}, 300), 300U * 2'560U * 21U);
    contents.camera.width_px = 4000;
    contents.camera.height_px = 3000;
    EXPECT_GE(estimateBytes(contents, {}, 300), 300U * 10'000U * 21U);
    EXPECT_LE(estimateBytes(contents, {}, 300), 300U * 10'000U * 24U);
}

// TartanAir's arrays are not compressed either: 4 bytes of depth, 1 of classes, 8 of motion and 1
// of its mask.
TEST(SizeEstimate, ExpectsTheFilesOfFormats) {
    const Scene scene;
    DatasetContents contents{scene, {}, *chooseModalities({"rgb"}), {}};
    contents.camera.width_px = 1000;
    contents.camera.height_px = 1000;
    const auto more = estimateBytes(contents, *chooseFormats({"tartanair"}), 10) -
                      estimateBytes(contents, {}, 10);
    EXPECT_GE(more, 140'000'000U);
    EXPECT_LE(more, 200'000'000U);
}

}  // namespace
}  // namespace dollytrack::render::size_estimate_test
