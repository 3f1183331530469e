#include "render/size_estimate.h"

#include <gtest/gtest.h>

namespace dollytrack::render {
namespace {

// Middlebury's files are not compressed: eight bytes a pixel, for each frame that flow goes to.
TEST(SizeEstimate, ExpectsTheFilesOfEveryDistanceThatFlowGoesTo) {
    const Scene scene;
    DatasetContents contents{scene, {}, *chooseModalities({"flow_forward"}), {}};
    contents.camera.width_px = 1000;
    contents.camera.height_px = 1000;
    for (const std::vector<int>& distances : {std::vector{1}, {1, 5, 10}}) {
        contents.flow_distances = distances;
        EXPECT_GE(estimateBytes(contents, 10), 10U * distances.size() * 8'000'000U);
        EXPECT_LE(estimateBytes(contents, 10), 10U * distances.size() * 9'000'000U);
    }
    contents.modalities = *chooseModalities({"rgb"});
    const std::uint64_t of_pictures = estimateBytes(contents, 10);
    contents.flow_distances = {1};
    EXPECT_EQ(estimateBytes(contents, 10), of_pictures);
}

}  // namespace
}  // namespace dollytrack::render
