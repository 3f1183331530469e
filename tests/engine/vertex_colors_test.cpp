#include "engine/io/raw_scene/vertex_colors.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::vertex_colors_test {
namespace {

using test::imported;
using test::TempFolder;

/// The colour of an image with bilinear filtering, 0 to 1; v points up.
Eigen::Vector3f sample(const std::vector<std::uint8_t>& rgba, int width, int height, float u,
                       float v) {
    const float x = u * static_cast<float>(width) - 0.5F;
    const float y = (1.0F - v) * static_cast<float>(height) - 0.5F;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const float weight = (1.0F - std::abs(x - static_cast<float>(left + i))) *
                                 (1.0F - std::abs(y - static_cast<float>(top + j)));
            const int column = std::clamp(left + i, 0, width - 1);
            const int row = std::clamp(top + j, 0, height - 1);
            for (int c = 0; c < 3; ++c) {
                sum[c] += weight * static_cast<float>(rgba[4UL * (row * width + column) + c]);
            }
        }
    }
    return sum / 255.0F;
}

/// A strip of triangles and quadrilaterals along x whose vertices have the given colours.
struct Strip {
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> indices;

    void face(std::uint32_t size) {
        constexpr float kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const auto x = static_cast<float>(sizes.size());
        sizes.push_back(size);
        for (std::uint32_t i = 0; i < size; ++i) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.emplace_back(x + kCorners[i][0], kCorners[i][1], 0.0F);
        }
    }
    [[nodiscard]] SourceMesh mesh() const { return {positions, {}, {}, sizes, indices}; }
};

TEST(VertexColors, AreInterpolatedWithinTrianglesAndAtTheCornersOfQuadrilaterals) {
    Strip strip;
    for (std::uint32_t i = 0; i < 9; ++i) strip.face(3 + i % 2);
    std::vector<Eigen::Vector3f> colors;
    for (std::size_t i = 0; i < strip.positions.size(); ++i) {
        const auto k = static_cast<float>(i);
        // Not extreme, so that the fourth texel of a triangle is not clamped.
        colors.emplace_back(0.5F + 0.15F * std::sin(k), 0.5F + 0.15F * std::cos(k),
                            0.4F + 0.005F * k);
    }
    const auto painted = paintVertexColors(strip.mesh(), colors);
    ASSERT_TRUE(painted);
    ASSERT_EQ(painted->indices.size(), strip.indices.size());
    const TextureRequest& texture = painted->texture;
    const auto colorAt = [&](const Eigen::Vector3f& uv) {
        return sample(texture.embedded, texture.embedded_width, texture.embedded_height, uv.x(),
                      uv.y());
    };
    constexpr float kTolerance = 1.5F / 255.0F;
    std::size_t first = 0;
    for (const std::uint32_t size : strip.sizes) {
        const auto uv = [&](std::size_t i) { return painted->uvs[painted->indices[first + i]]; };
        for (std::size_t i = 0; i < size; ++i) {
            EXPECT_TRUE(painted->positions[painted->indices[first + i]] ==
                        strip.positions[first + i]);
            EXPECT_LT((colorAt(uv(i)) - colors[first + i]).cwiseAbs().maxCoeff(), kTolerance);
        }
        for (const auto& [a, b] : {std::pair(0.2F, 0.3F), {0.6F, 0.1F}, {0.1F, 0.8F}}) {
            if (size != 3) break;
            const float c = 1.0F - a - b;
            const Eigen::Vector3f expected =
                a * colors[first] + b * colors[first + 1] + c * colors[first + 2];
            const Eigen::Vector3f shown = colorAt(a * uv(0) + b * uv(1) + c * uv(2));
            EXPECT_LT((shown - expected).cwiseAbs().maxCoeff(), kTolerance);
        }
        first += size;
    }
}

TEST(VertexColors, FacesOfOneColourShareTexels) {
    Strip strip;
    std::vector<Eigen::Vector3f> colors;
    for (int i = 0; i < 300; ++i) {
        strip.face(3);
        const Eigen::Vector3f color = i % 3 == 0   ? Eigen::Vector3f(1, 0, 0)
                                      : i % 3 == 1 ? Eigen::Vector3f(0, 1, 0)
                                                   : Eigen::Vector3f(0, 0, 1);
        colors.insert(colors.end(), 3, color);
    }
    const auto painted = paintVertexColors(strip.mesh(), colors);
    ASSERT_TRUE(painted);
    EXPECT_EQ(painted->texture.embedded.size(), 4U * 4U * 4U);
    EXPECT_FALSE(paintVertexColors(strip.mesh(), std::vector(colors.size(), colors.front())));
    EXPECT_FALSE(paintVertexColors(strip.mesh(), {}));
    colors.pop_back();
    EXPECT_FALSE(paintVertexColors(strip.mesh(), colors));
}

TEST(VertexColors, InvalidIndicesStayInvalid) {
    for (const std::uint32_t size : {3U, 4U, 5U}) {
        Strip strip;
        std::vector<Eigen::Vector3f> colors;
        for (std::uint32_t face = 0; face < 2; ++face) {
            strip.sizes.push_back(size);
            for (std::uint32_t i = 0; i < size; ++i) {
                const auto k = static_cast<float>(i);
                strip.indices.push_back(static_cast<std::uint32_t>(strip.positions.size()));
                strip.positions.emplace_back(std::cos(k), std::sin(k), 0.0F);
                colors.emplace_back(0.1F * k, 0.5F, 1.0F - 0.1F * k);
            }
        }
        strip.indices[1] = 77;
        const auto painted = paintVertexColors(strip.mesh(), colors);
        ASSERT_TRUE(painted);
        ASSERT_EQ(painted->indices.size(), 2 * size);
        for (std::size_t i = 0; i < painted->indices.size(); ++i) {
            EXPECT_EQ(painted->indices[i] < painted->positions.size(), i != 1);
        }
    }
}

TEST(VertexColors, BecomeATextureOfAPlyMesh) {
    const TempFolder folder;
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& [x, color] : {std::pair("0", "200 30 10"), {"5", "20 60 250"}}) {
        for (const char* corner : {" 0 0 ", " 2 0 ", " 0 2 "}) {
            text += std::string(x) + corner + color + "\n";
        }
    }
    text += "3 0 1 2\n3 3 4 5\n";
    const Scene scene = imported(folder.write("walls.ply", text));
    ASSERT_EQ(scene.triangles.size(), 2U);
    int red = 0;
    int blue = 0;
    for (std::size_t t = 0; t < 2; ++t) {
        const int index = scene.materials[scene.triangle_material[t]].texture;
        ASSERT_GE(index, 0);
        const Texture& texture = scene.textures[static_cast<std::size_t>(index)];
        Eigen::Vector2f uv = Eigen::Vector2f::Zero();
        for (const std::uint32_t v : scene.triangles[t]) uv += scene.uvs[v] / 3.0F;
        const Eigen::Vector3f color =
            255.0F * sample(texture.rgba, texture.width, texture.height, uv.x(), uv.y());
        red += (color - Eigen::Vector3f(200, 30, 10)).norm() < 1.0F;
        blue += (color - Eigen::Vector3f(20, 60, 250)).norm() < 1.0F;
    }
    EXPECT_EQ(red, 1);
    EXPECT_EQ(blue, 1);
}

}  // namespace
}  // namespace dollytrack::vertex_colors_test
