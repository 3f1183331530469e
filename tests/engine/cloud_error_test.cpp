#include "engine/geometry/cloud_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace dollytrack::cloud_error_test {
namespace {

// A diverged reconstruction has such points; cells must have neighbours nevertheless.
TEST(CloudError, PointsFarBeyondAnyGridCoverNothingButThemselves) {
    const double huge = std::numeric_limits<double>::max();
    const std::vector<Eigen::Vector3d> surface = {{0, 0, 0}, {1, 0, 0}};
    const std::vector<Eigen::Vector3d> cloud = {
        {huge, 0, 0}, {-huge, huge, -huge}, {1e30, -1e30, 0}, {0.01, 0, 0}};
    EXPECT_EQ(coveredShare(surface, cloud, 0.05), 0.5);
    const std::vector<Eigen::Vector3d> far = {{huge, 0, 0}, {0, -huge, 0}};
    EXPECT_EQ(coveredShare(far, std::vector<Eigen::Vector3d>{{0, 0, 0}}, 0.05), 0.0);
}

}  // namespace
}  // namespace dollytrack::cloud_error_test
