#include "app/editor/files/thumbnail.h"

#include "app/editor/files/folder_entries.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/png_writer.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/text_file.h"
#include "engine/io/pictures/picture_decoder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace dollytrack::editor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPictures = 40;

/// Average of a channel over the pixels x0 <= x < x1, y0 <= y < y1.
std::uint8_t average(int width, std::span<const std::uint8_t> rgba, int channel, int x0, int x1,
                     int y0, int y1) {
    std::size_t sum = 0;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            sum += rgba[4 * (static_cast<std::size_t>(y) * width + x) + channel];
        }
    }
    return static_cast<std::uint8_t>(sum / (static_cast<std::size_t>(x1 - x0) * (y1 - y0)));
}

/// Whether the bytes begin as a PNG of the thumbnail's size.
bool isThumbnailPng(std::string_view bytes) {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    if (bytes.size() < 24 || !bytes.starts_with(kSignature)) return false;
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i) {
            value = (value << 8U) | static_cast<std::uint8_t>(bytes[i]);
        }
        return value;
    };
    return number(16) == Thumbnail::kWidth && number(20) == Thumbnail::kHeight;
}

void removeOldest(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> pictures;
    std::error_code error;
    for (const fs::directory_entry& entry : entriesOf(folder)) {
        const fs::file_time_type time = fs::last_write_time(entry.path(), error);
        if (!error && entry.path().extension() == ".png") pictures.emplace_back(time, entry.path());
    }
    std::ranges::sort(pictures);
    for (std::size_t i = 0; i + kMostPictures < pictures.size(); ++i) {
        fs::remove(pictures[i].second, error);
    }
}

}  // namespace

Thumbnail thumbnailOf(int width, int height, std::span<const std::uint8_t> rgba) {
    Thumbnail picture;
    if (width < Thumbnail::kWidth || height < Thumbnail::kHeight) return picture;
    const int wide = std::min(width, height * Thumbnail::kWidth / Thumbnail::kHeight);
    const int high = std::min(height, width * Thumbnail::kHeight / Thumbnail::kWidth);
    const int left = (width - wide) / 2;
    const int top = (height - high) / 2;
    picture.rgba.reserve(std::size_t{4} * Thumbnail::kWidth * Thumbnail::kHeight);
    for (int y = 0; y < Thumbnail::kHeight; ++y) {
        const int y0 = top + y * high / Thumbnail::kHeight;
        const int y1 = top + (y + 1) * high / Thumbnail::kHeight;
        for (int x = 0; x < Thumbnail::kWidth; ++x) {
            const int x0 = left + x * wide / Thumbnail::kWidth;
            const int x1 = left + (x + 1) * wide / Thumbnail::kWidth;
            for (int channel = 0; channel < 3; ++channel) {
                picture.rgba.push_back(average(width, rgba, channel, x0, x1, y0, y1));
            }
            picture.rgba.push_back(255);
        }
    }
    return picture;
}

fs::path thumbnailFile(const fs::path& folder, const fs::path& project) {
    return folder / (sha256Of(project.native()).substr(0, 32) + ".png");
}

Status writeThumbnail(const fs::path& file, const Thumbnail& picture) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    const auto png =
        encodePng(Thumbnail::kWidth, Thumbnail::kHeight, PngFormat::Rgba8, picture.rgba);
    if (!png) return tl::unexpected(png.error());
    Status written = writeWhole(file, std::span<const std::uint8_t>(*png), Durability::Renamed);
    removeOldest(file.parent_path());
    return written;
}

Thumbnail readThumbnail(const fs::path& file) {
    const Result<std::string> bytes = readText(file, 1);
    if (!bytes || !isThumbnailPng(*bytes)) return {};
    Texture picture;
    const std::span data(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size());
    const bool whole = decodePicture(data, Thumbnail::kWidth, true, picture) &&
                       picture.width == Thumbnail::kWidth && picture.height == Thumbnail::kHeight;
    return {whole ? std::move(picture.rgba) : std::vector<std::uint8_t>()};
}

}  // namespace dollytrack::editor
