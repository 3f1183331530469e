#pragma once

// A curved sheet with heights z = x y for the tests of the glTF reader.

#include "engine/io/import/scene_import.h"
#include "engine/io/models/model_reader.h"
#include "tests/support/glb_writer.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dollytrack::test::gltf {

// Component types of accessors.
inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;

inline constexpr std::size_t kSide = 20;  // vertices along a side of the sheet
inline constexpr std::size_t kCount = kSide * kSide;

/// A vertex of the sheet: x and y from 0 to 1, z = x y.
inline Eigen::Vector3f vertex(std::size_t i) {
    const float x = static_cast<float>(i % kSide) / (kSide - 1);
    const float y = static_cast<float>(i / kSide) / (kSide - 1);
    return {x, y, x * y};
}

inline std::vector<Eigen::Vector3f> vertices() {
    std::vector<Eigen::Vector3f> all;
    for (std::size_t i = 0; i < kCount; ++i) all.push_back(vertex(i));
    return all;
}

template <class Index>
std::vector<Index> triangles() {
    std::vector<Index> all;
    for (std::size_t y = 0; y + 1 < kSide; ++y) {
        for (std::size_t x = 0; x + 1 < kSide; ++x) {
            const std::size_t a = y * kSide + x;
            for (const std::size_t v : {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide}) {
                all.push_back(static_cast<Index>(v));
            }
        }
    }
    return all;
}

inline RawScene read(const std::string& bytes, const std::string& name = "sheet.glb") {
    const TempFolder folder;
    Result<RawScene> raw = readModel(folder.write(name, bytes), {});
    EXPECT_TRUE(raw) << raw.error().message;
    return raw ? std::move(*raw) : RawScene();
}

inline std::string refusalOf(const std::string& bytes, const std::string& name = "sheet.glb") {
    const TempFolder folder;
    const Result<RawScene> raw = readModel(folder.write(name, bytes), {});
    EXPECT_FALSE(raw);
    if (raw) return {};
    EXPECT_EQ(raw.error().code, ErrorCode::BadInput);
    EXPECT_TRUE(raw.error().where.ends_with("/" + name)) << raw.error().where;
    return raw.error().message;
}

/// Expects the complete sheet: its number of triangles, each corner on z = x y within `tolerance`,
/// x and y from 0 to 1. `place`: inverse of the test's transform of the sheet.
inline void expectSheet(const MeshPart& part, float tolerance,
                        const std::function<Eigen::Vector3f(Eigen::Vector3f)>& place = nullptr) {
    EXPECT_EQ(part.triangles.size(), 2 * (kSide - 1) * (kSide - 1));
    Eigen::AlignedBox3f box;
    double area = 0.0;
    for (const Triangle& t : part.triangles) {
        std::array<Eigen::Vector3f, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            corners[c] = part.positions[t[c]];
            if (place) corners[c] = place(corners[c]);
            box.extend(corners[c]);
            ASSERT_NEAR(corners[c].z(), corners[c].x() * corners[c].y(), 3 * tolerance);
        }
        const Eigen::Vector3f cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        ASSERT_GT(cross.z(), 0.0F);
        area += 0.5 * static_cast<double>(cross.z());
    }
    EXPECT_NEAR(area, 1.0, 10 * tolerance);  // seen from above
    EXPECT_NEAR(box.min().minCoeff(), 0.0F, tolerance);
    EXPECT_NEAR(box.max().maxCoeff(), 1.0F, tolerance);
}

/// The sheet as floats and 16-bit indices.
inline GlbWriter plainSheet() {
    GlbWriter file;
    const std::size_t at = file.addAccessor(file.addView(vertices()), kFloat, "VEC3", kCount);
    const auto indices = triangles<std::uint16_t>();
    const std::size_t order =
        file.addAccessor(file.addView(indices), kUnsignedShort, "SCALAR", indices.size());
    file.addMesh("sheet", {{"attributes", {{"POSITION", at}}}, {"indices", order}});
    return file;
}

}  // namespace dollytrack::test::gltf
