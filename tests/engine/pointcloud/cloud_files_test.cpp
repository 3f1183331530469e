#include "engine/core/random.h"
#include "engine/io/pointcloud/files/cloud_file.h"
#include "engine/io/pointcloud/files/lzf.h"
#include "engine/io/pointcloud/files/pcd_points.h"
#include "engine/io/pointcloud/files/ply_points.h"
#include "engine/io/pointcloud/files/text_points.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace dollytrack::cloud_files_test {
namespace {

std::string bytesOf(std::initializer_list<float> values) {
    std::string bytes;
    for (const float value : values) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
    return bytes;
}

std::string pcdHeader(const std::string& data, int points = 3) {
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\n"
           "SIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " +
           std::to_string(points) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
           std::to_string(points) + "\nDATA " + data + "\n";
}

std::string packedColor(std::uint32_t color) {
    return {reinterpret_cast<const char*>(&color), sizeof(color)};
}

/// LZF without compression: runs of literal bytes.
std::string storedLzf(const std::string& bytes) {
    std::string packed;
    for (std::size_t at = 0; at < bytes.size(); at += 32) {
        const std::string run = bytes.substr(at, 32);
        packed += static_cast<char>(run.size() - 1);
        packed += run;
    }
    const auto count = [](std::size_t n) { return packedColor(static_cast<std::uint32_t>(n)); };
    return count(packed.size()) + count(bytes.size()) + packed;
}

void expectThreePoints(const Result<PointCloud>& cloud) {
    ASSERT_TRUE(cloud) << describe(cloud.error());
    ASSERT_EQ(cloud->points.size(), 2U);  // the NaN point is dropped
    EXPECT_EQ(cloud->left_out, 1U);
    EXPECT_EQ(cloud->points[0], Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(cloud->points[1], Eigen::Vector3d(-1.0, 0.5, 0.25));
    ASSERT_EQ(cloud->colors.size(), 2U);
    EXPECT_EQ(cloud->colors[0], (std::array<std::uint8_t, 3>{255, 128, 1}));
    EXPECT_EQ(cloud->colors[1], (std::array<std::uint8_t, 3>{0, 0, 9}));
}

// Written by hand from the format's description: 3 literals, then 6 bytes from 3 back, which
// overlap the output.
TEST(Lzf, CopiesWhatItJustMade) {
    const std::vector<std::uint8_t> packed = {2, 'a', 'b', 'c', 0x80, 2};
    const auto out = unpackLzf(packed, 9);
    ASSERT_TRUE(out);
    EXPECT_EQ(std::string(out->begin(), out->end()), "abcabcabc");
}

TEST(Lzf, ReadsLongCopies) {
    const std::vector<std::uint8_t> packed = {0, 'x', 0xE0, 91, 0};  // 7 + 91 + 2 copies of 'x'
    const auto out = unpackLzf(packed, 101);
    ASSERT_TRUE(out);
    EXPECT_EQ(*out, std::vector<std::uint8_t>(101, 'x'));
}

TEST(Lzf, RefusesWhatPointsOutside) {
    const std::vector<std::uint8_t> before_begin = {0, 'x', 0x20, 5};
    const std::vector<std::uint8_t> cut = {31, 'x'};
    const std::vector<std::uint8_t> too_much = {2, 'a', 'b', 'c'};
    const std::vector<std::uint8_t> no_distance = {0, 'x', 0x20};
    EXPECT_FALSE(unpackLzf(before_begin, 4));
    EXPECT_FALSE(unpackLzf(cut, 32));
    EXPECT_FALSE(unpackLzf(too_much, 2));
    EXPECT_FALSE(unpackLzf(no_distance, 4));
    EXPECT_FALSE(unpackLzf(too_much, std::size_t{1} << 40U));  // a bomb
}

TEST(Pcd, ReadsTextBinaryAndCompressedAlike) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expectThreePoints(
        readPcd(pcdHeader("ascii") + "1 2 3 16744449\nnan nan nan 0\n-1 0.5 0.25 9\n", "a.pcd"));
    expectThreePoints(readPcd(pcdHeader("binary") + bytesOf({1, 2, 3}) + packedColor(0xFF8001) +
                                  bytesOf({nan, nan, nan}) + packedColor(0) +
                                  bytesOf({-1, 0.5F, 0.25F}) + packedColor(9),
                              "b.pcd"));
    const std::string by_field = bytesOf({1, nan, -1}) + bytesOf({2, nan, 0.5F}) +
                                 bytesOf({3, nan, 0.25F}) + packedColor(0xFF8001) + packedColor(0) +
                                 packedColor(9);
    expectThreePoints(readPcd(pcdHeader("binary_compressed") + storedLzf(by_field), "c.pcd"));
}

TEST(Pcd, SaysWhatIsWrong) {
    const auto messageOf = [](const std::string& bytes) {
        const auto cloud = readPcd(bytes, "x.pcd");
        return cloud ? std::string() : describe(cloud.error());
    };
    EXPECT_NE(messageOf(pcdHeader("binary") + "short").find("too short for the 3 points"),
              std::string::npos);
    EXPECT_NE(messageOf(pcdHeader("ascii") + "1 2\n").find("x.pcd:12"), std::string::npos);
    EXPECT_NE(
        messageOf("VERSION 0.7\nFIELDS a b\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\n"
                  "POINTS 1\nDATA ascii\n1 2\n")
            .find("no field 'x'"),
        std::string::npos);
    EXPECT_NE(messageOf(pcdHeader("ascii", 2'000'000'000)).find("does not belong in a PCD header"),
              std::string::npos);
}

TEST(TextPoints, FindsSeparatorsColoursAndNames) {
    for (const char* text :
         {"1 2 3 255 128 1\nnan 0 0 0 0 0\n-1 0.5 0.25 0 0 9\n",
          "3\n1,2,3,255,128,1\nnan,0,0,0,0,0\n-1,0.5,0.25,0,0,9\n",
          "# a scan\n1;2;3;255;128;1\nnan;0;0;0;0;0\n-1;0.5;0.25;0;0;9\n",
          "1\t2\t3\t0.7\t255\t128\t1\nnan\t0\t0\t0\t0\t0\t0\n-1\t.5\t.25\t0.7\t0\t0\t9\n",
          "//X Y Z R G B\n1 2 3 255 128 1\nnan 0 0 0 0 0\n-1 0.5 0.25 0 0 9\n",
          "blue,red,green,z,x,y\n1,255,128,3,1,2\n0,0,0,nan,0,0\n9,0,0,0.25,-1,0.5\n"}) {
        SCOPED_TRACE(text);
        expectThreePoints(readTextPoints(text, "scan.xyz"));
    }
}

TEST(TextPoints, TakesSixColumnsWithNegativesForNormals) {
    const auto cloud = readTextPoints("1 2 3 0 0 -1\n4 5 6 0 1 0\n", "scan.xyz");
    ASSERT_TRUE(cloud);
    EXPECT_TRUE(cloud->colors.empty());
    ASSERT_EQ(cloud->normals.size(), 2U);
    EXPECT_EQ(cloud->normals[0], Eigen::Vector3f(0, 0, -1));
}

TEST(TextPoints, NamesTheLine) {
    const auto uneven = readTextPoints("1 2 3\n4 5\n", "scan.xyz");
    ASSERT_FALSE(uneven);
    EXPECT_EQ(uneven.error().where, "scan.xyz:2");
    EXPECT_FALSE(readTextPoints("no numbers\n", "scan.xyz"));
}

TEST(PlyPoints, ToldFromMeshes) {
    EXPECT_TRUE(isPlyOfPoints("ply\nformat ascii 1.0\nelement vertex 3\nend_header\n"));
    EXPECT_TRUE(isPlyOfPoints("ply\nelement vertex 3\nelement face 0\nend_header\n"));
    EXPECT_FALSE(isPlyOfPoints("ply\nelement vertex 3\nelement face 1\nend_header\n"));
    EXPECT_FALSE(isPlyOfPoints("obj\nend_header\n"));
}

// A file with any change is read or refused, and has no more points than fit into it.
TEST(CloudFiles, AnswerWhateverIsInThem) {
    const std::string by_field = bytesOf({1, 5, -1}) + bytesOf({2, 6, 0.5F}) +
                                 bytesOf({3, 7, 0.25F}) + packedColor(0xFF8001) + packedColor(0) +
                                 packedColor(9);
    const std::vector<std::string> files = {
        pcdHeader("ascii") + "1 2 3 16744449\nnan nan nan 0\n-1 0.5 0.25 9\n",
        pcdHeader("binary") + bytesOf({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}),
        pcdHeader("binary_compressed") + storedLzf(by_field),
        "1 2 3 255 128 1\nnan 0 0 0 0 0\n-1 0.5 0.25 0 0 9\n"};
    Random random(7);
    int read = 0;
    for (int round = 0; round < 4000; ++round) {
        std::string bytes = files[static_cast<std::size_t>(round) % files.size()];
        for (std::uint32_t change = random.below(4); change-- > 0;) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
            if (random.below(5) == 0) {
                bytes.resize(at);
            } else {
                bytes[at] = static_cast<char>(random.below(256));
            }
            if (bytes.empty()) break;
        }
        const auto cloud =
            bytes.starts_with("#") ? readPcd(bytes, "x.pcd") : readTextPoints(bytes, "x.xyz");
        if (!cloud) {
            EXPECT_FALSE(cloud.error().message.empty());
            continue;
        }
        ++read;
        EXPECT_LE(cloud->points.size(), bytes.size());
        for (const Eigen::Vector3d& p : cloud->points) EXPECT_TRUE(p.allFinite());
    }
    EXPECT_GT(read, 500);
}

}  // namespace
}  // namespace dollytrack::cloud_files_test
