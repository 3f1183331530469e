#include "app/editor/files/thumbnail.h"

#include "engine/io/files/png_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor::thumbnail_test {
namespace {

namespace fs = std::filesystem;

std::string pngOf(int width, int height) {
    const std::vector<std::uint8_t> pixels(std::size_t{4} * width * height, 90);
    const auto png = *encodePng(width, height, PngFormat::Rgba8, pixels);
    return {png.begin(), png.end()};
}

TEST(Thumbnail, AveragesTheMiddleOfAnImage) {
    // Twice as large and wider by 40 px on each side; columns alternate between 100 and 200.
    const int width = 2 * Thumbnail::kWidth + 80;
    const int height = 2 * Thumbnail::kHeight;
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < width * height; ++i) {
        const int x = i % width;
        const bool outside = x < 40 || x >= width - 40;
        const auto value = static_cast<std::uint8_t>(outside ? 0 : x % 2 == 0 ? 100 : 200);
        rgba.insert(rgba.end(), {value, value, 7, 0});
    }
    const Thumbnail picture = thumbnailOf(width, height, rgba);
    ASSERT_EQ(picture.rgba.size(), std::size_t{4} * Thumbnail::kWidth * Thumbnail::kHeight);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        ASSERT_EQ(picture.rgba[i], 150) << i;
        ASSERT_EQ(picture.rgba[i + 2], 7);
        ASSERT_EQ(picture.rgba[i + 3], 255) << "opaque";
    }
    EXPECT_TRUE(thumbnailOf(100, 100, std::vector<std::uint8_t>(40000)).rgba.empty());
}

TEST(Thumbnail, IsReadAsItWasWritten) {
    const test::TempFolder temporary;
    const fs::path file = thumbnailFile(temporary.path() / "new", "/homes/kitchen.dolly");
    EXPECT_NE(file, thumbnailFile(temporary.path() / "new", "/homes/kitchen2.dolly"));
    EXPECT_TRUE(readThumbnail(file).rgba.empty()) << "there is none yet";
    Thumbnail picture;
    for (int i = 0; i < Thumbnail::kWidth * Thumbnail::kHeight; ++i) {
        const auto value = static_cast<std::uint8_t>(i % 251);
        picture.rgba.insert(picture.rgba.end(), {value, 30, 40, 255});
    }
    ASSERT_TRUE(writeThumbnail(file, picture));
    EXPECT_EQ(readThumbnail(file).rgba, picture.rgba);
}

TEST(Thumbnail, OtherFilesAreNotUnpacked) {
    const test::TempFolder temporary;
    const auto isRead = [&](const std::string& bytes) {
        return !readThumbnail(temporary.write("picture.png", bytes)).rgba.empty();
    };
    const std::string good = pngOf(Thumbnail::kWidth, Thumbnail::kHeight);
    EXPECT_TRUE(isRead(good));
    EXPECT_FALSE(isRead(pngOf(Thumbnail::kWidth + 1, Thumbnail::kHeight)));
    EXPECT_FALSE(isRead(pngOf(4000, 4000))) << "one of few bytes and many pixels";
    EXPECT_FALSE(isRead(good.substr(0, good.size() / 2)));
    EXPECT_FALSE(isRead(good + std::string(2U << 20U, 'x'))) << "too large a file";
    EXPECT_FALSE(isRead(""));
    EXPECT_FALSE(isRead(good.substr(0, 8)));
    fs::create_directory(temporary.path() / "folder.png");
    EXPECT_TRUE(readThumbnail(temporary.path() / "folder.png").rgba.empty());
}

TEST(Thumbnail, OldPicturesAreRemoved) {
    const test::TempFolder temporary;
    const Thumbnail picture = {
        std::vector<std::uint8_t>(std::size_t{4} * Thumbnail::kWidth * Thumbnail::kHeight, 255)};
    const fs::path oldest = temporary.write("oldest.png", "x");
    fs::last_write_time(oldest, fs::last_write_time(oldest) - std::chrono::hours(1));
    for (int i = 0; i < 40; ++i) {
        const fs::path file = thumbnailFile(temporary.path(), std::to_string(i));
        ASSERT_TRUE(writeThumbnail(file, picture));
        EXPECT_TRUE(fs::exists(file));
        EXPECT_EQ(fs::exists(oldest), i < 39) << i;
    }
}

}  // namespace
}  // namespace dollytrack::editor::thumbnail_test
