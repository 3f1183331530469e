#include "render/light/irradiance_grid.h"

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::render::irradiance_grid_test {
namespace {

using dollytrack::test::SceneBuilder;

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 2, 2));

/// Cells of 10 cm; a wall may stand between the two halves of the box in x.
IrradianceGrid linkedCells(bool with_wall) {
    SceneBuilder builder;
    builder.object("floor").quad({-1, -1, -1}, {4, 0, 0}, {0, 4, 0});
    if (with_wall) builder.object("wall").quad({1, -1, -1}, {0, 4, 0}, {0, 0, 4});
    const Scene scene = builder.build();
    IrradianceGrid cells(kBox, 0.1, 1'000'000);
    cells.link(RayCaster(scene));
    return cells;
}

/// Brightness where x is above 1 m, after blurring light that is only where x is below 1 m.
double beyondTheWall(bool with_wall) {
    const IrradianceGrid cells = linkedCells(with_wall);
    std::vector<Eigen::Vector3f> values(cells.count(), Eigen::Vector3f::Zero());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (cells.center(i).x() < 1.0) values[i].setOnes();
    }
    cells.blur(values, 0.2);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (cells.center(i).x() > 1.0) sum += values[i].x();
    }
    return sum;
}

TEST(IrradianceGrid, NoBlurCrossesAWall) {
    EXPECT_EQ(beyondTheWall(true), 0.0);
    EXPECT_GT(beyondTheWall(false), 100.0);
}

TEST(IrradianceGrid, ABlurIsAsWideAsItSays) {
    const IrradianceGrid cells = linkedCells(false);
    const std::size_t middle = cells.cellAt({0.95, 0.95, 0.95});
    for (const double deviation_m : {0.1, 0.2}) {
        std::vector<Eigen::Vector3f> values(cells.count(), Eigen::Vector3f::Zero());
        values[middle].setOnes();
        cells.blur(values, deviation_m);
        double sum = 0.0;
        Eigen::Array3d squares = Eigen::Array3d::Zero();
        for (std::size_t i = 0; i < values.size(); ++i) {
            sum += values[i].x();
            squares += values[i].x() * (cells.center(i) - cells.center(middle)).array().square();
        }
        EXPECT_NEAR(sum, 1.0, 1e-3);
        for (const double square : squares) {
            EXPECT_NEAR(std::sqrt(square / sum), deviation_m, 0.1 * deviation_m);
        }
    }
}

}  // namespace
}  // namespace dollytrack::render::irradiance_grid_test
