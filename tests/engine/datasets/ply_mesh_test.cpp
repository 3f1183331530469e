#include "engine/io/models/ply_mesh.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/pointcloud/files/ply_points.h"
#include "engine/io/semantics/labelled_faces.h"
#include "tests/engine/datasets/numbered_mesh.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace dollytrack::ply_mesh_test {
namespace {

using Eigen::Vector3f;
using test::asciiPly;
using test::imported;
using test::says;
using test::TempFolder;
using test::Triangles;
using test::trianglesOf;

/// One triangle per number, which is the face's property object_id of this type.
std::string facesNumbered(const std::string& type, const std::vector<std::string>& numbers) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face " +
        std::to_string(numbers.size()) + "\nproperty list uchar int vertex_indices\nproperty " +
        type + " object_id\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
    for (const std::string& number : numbers) text += "3 0 1 2 " + number + "\n";
    return text;
}

TEST(PlyMesh, NumbersThatAreNotWholeAreNotLabels) {
    const std::vector<std::string> numbers = {"3",   "nan",  "-nan", "inf", "-inf", "1e30",
                                              "2.5", "-0.5", "-7",   "3.0", "0"};
    for (const char* type : {"float", "double"}) {
        const Result<PlyMesh> mesh = parsePlyMesh(facesNumbered(type, numbers), "ids.ply");
        ASSERT_TRUE(mesh) << describe(mesh.error());
        EXPECT_EQ(mesh->face_objects,
                  (std::vector<std::int64_t>{3, -1, -1, -1, -1, -1, -1, -1, -7, 3, 0}));
        // In order of number, unlabelled last.
        const auto faces = semantics::labelFaces(*mesh, {});
        ASSERT_TRUE(faces);
        EXPECT_EQ(faces->of_face, (std::vector<std::size_t>{1, 2, 2, 2, 2, 2, 2, 2, 2, 1, 0}));
        EXPECT_FALSE(faces->objects[2].target);
    }
}

TEST(PlyMesh, ReadsNumbersWithAPlusAndOutOfRange) {
    const Result<PlyMesh> mesh = parsePlyMesh(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "+1.5 1e-400 -1e-400\n+.5e+1 -2 1e400\n0.0 -1e400 +0\n3 0 +1 2\n",
        "numbers.ply");
    ASSERT_TRUE(mesh) << describe(mesh.error());
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(mesh->positions[0], Vector3f(1.5F, 0, 0));
    EXPECT_EQ(mesh->positions[1], Vector3f(5, -2, kInfinity));
    EXPECT_EQ(mesh->positions[2], Vector3f(0, -kInfinity, 0));
    EXPECT_EQ(mesh->face_indices, (std::vector<std::uint32_t>{0, 1, 2}));
    // 1e-396 and 1e395, although the exponents are small.
    const std::string zeros(400, '0');
    EXPECT_EQ(numberFrom("0." + zeros + "1e5"), 0.0);
    EXPECT_EQ(numberFrom("-1" + zeros + "e-5"), -std::numeric_limits<double>::infinity());
    for (const char* wrong : {"+-1", "++1", "+", "1.5x", "1e"}) {
        EXPECT_FALSE(parsePlyMesh(facesNumbered("float", {wrong}), "wrong.ply")) << wrong;
    }
}

/// A number's bytes in a file's order; tests run on little-endian machines.
template <class T>
void append(std::string& bytes, T value, bool big_endian) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
}

/// The mesh with object numbers; `first` is the first byte of each coordinate in the file.
std::string binaryPly(const Triangles& mesh, bool big_endian, std::uint8_t first) {
    std::string bytes = "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
                        "_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                        std::to_string(mesh.faces.size()) +
                        "\nproperty list uchar int vertex_indices\nproperty short object_id\n"
                        "end_header\n";
    for (const Vector3f& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) {
            std::uint32_t bits = 0;
            const float value = p[i];
            std::memcpy(&bits, &value, 4);
            bits = big_endian ? (bits & 0x00FFFFFFU) | std::uint32_t{first} << 24U
                              : (bits & 0xFFFFFF00U) | first;
            append(bytes, bits, big_endian);
        }
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        append(bytes, std::uint8_t{3}, big_endian);
        for (const int index : mesh.faces[f]) append(bytes, std::int32_t{index}, big_endian);
        append(bytes, static_cast<std::int16_t>(mesh.of_face[f]), big_endian);
    }
    return bytes;
}

// A line feed after the header is the first byte of a number, not a line end.
TEST(PlyMesh, TheFirstByteMayBeALineFeed) {
    const Triangles mesh = trianglesOf({{{0, 0, 0}, {1, 2, 3}, 300}});
    const std::string bytes = binaryPly(mesh, false, 0x0A);
    const Result<PlyMesh> read = parsePlyMesh(bytes, "box.ply");
    ASSERT_TRUE(read) << describe(read.error());
    ASSERT_EQ(read->positions.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_LT((read->positions[i] - mesh.positions[i]).norm(), 1e-5F);
    }
    EXPECT_EQ(read->face_indices.size(), 36U);
    EXPECT_EQ(read->face_objects, std::vector<std::int64_t>(12, 300));
    // Truncated at any position, it is damaged.
    for (std::size_t length = 0; length < bytes.size(); length += 7) {
        EXPECT_FALSE(parsePlyMesh(bytes.substr(0, length), "box.ply")) << length;
    }
    const Result<PlyMesh> big = parsePlyMesh(binaryPly(mesh, true, 0x0A), "box.ply");
    ASSERT_TRUE(big) << describe(big.error());
    EXPECT_GT(big->positions[7].minCoeff(), 0.0F);
    EXPECT_LT(big->positions[7].maxCoeff(), 1e-30F) << "an exponent of 0x0A";
}

TEST(PlyMesh, EitherByteOrderIsTheSameMesh) {
    const Triangles mesh = trianglesOf({{{2, 2, 2}, {3, 3.5F, 3.75F}, 258}});
    const Result<PlyMesh> big = parsePlyMesh(binaryPly(mesh, true, 0x40), "big.ply");
    const Result<PlyMesh> text = parsePlyMesh(asciiPly(mesh, true, "object_id"), "text.ply");
    ASSERT_TRUE(big && text);
    EXPECT_EQ(big->positions, mesh.positions);
    EXPECT_EQ(big->positions, text->positions);
    EXPECT_EQ(big->face_indices, text->face_indices);
    EXPECT_EQ(big->face_objects, text->face_objects);
}

TEST(PlyMesh, ReadsStripsAndPlacesOfCorners) {
    const Result<PlyMesh> strips = parsePlyMesh(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 1 4 3\n",
        "s.ply");
    ASSERT_TRUE(strips) << describe(strips.error());
    EXPECT_EQ(strips->face_indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 1, 4, 3}));
    const Result<PlyMesh> corners = parsePlyMesh(
        "ply\nformat ascii 1.0\ncomment TextureFile dark  wood 1.png \r\nelement vertex "
        "3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 2 0 1 6 0.1 0.2 0.3 0.4 0.5 0.6\n",
        "c.ply");
    ASSERT_TRUE(corners) << describe(corners.error());
    EXPECT_EQ(corners->texture, "dark  wood 1.png");
    ASSERT_EQ(corners->uvs.size(), 3U);
    EXPECT_TRUE(corners->positions[0].isApprox(Vector3f(0, 1, 0)));
    EXPECT_TRUE(corners->uvs[2].isApprox(Vector3f(0.5F, 0.6F, 0)));
}

/// Splats of a floor and a wall, and a faint one far away.
std::string splats() {
    std::string lines;
    int count = 1;
    for (int i = 0; i < 80; ++i) {
        for (int k = 0; k < 60; ++k) {
            const std::string x = std::to_string(0.05 * i);
            const std::string other = std::to_string(0.05 * k);
            for (const std::string& place : {x + " " + other + " 0", x + " 0 " + other}) {
                lines += place + " 1.7724539 -1.7724539 0 2 -4\n";
                ++count;
            }
        }
    }
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) + "\n";
    for (const char* name : {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0"}) {
        text += std::string("property float ") + name + "\n";
    }
    return text + "end_header\n" + lines + "90 90 90 0 0 0 -3 -4\n";
}

TEST(Splats, AreToldFromScans) {
    const TempFolder folder;
    const auto path = folder.write("splats.ply", splats());
    const Result<PointCloud> cloud = readPlyCloud(path);
    ASSERT_TRUE(cloud) << describe(cloud.error());
    EXPECT_TRUE(cloud->splats);
    ASSERT_EQ(cloud->points.size(), 9600U) << "the faint one is left out";
    // 0.5 + 1.7724539 / (2 sqrt(pi)) = 1.
    EXPECT_NEAR(cloud->colors[0][0], 255, 1);
    EXPECT_NEAR(cloud->colors[0][1], 0, 1);
    EXPECT_NEAR(cloud->colors[0][2], 127, 1);
    EXPECT_TRUE(says(imported(path).report.warnings, "Gaussian splats, whose centres"));
}

}  // namespace
}  // namespace dollytrack::ply_mesh_test
