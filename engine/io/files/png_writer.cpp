#include "engine/io/files/png_writer.h"

#include <png.h>
#include <zlib.h>

#include <bit>
#include <csetjmp>
#include <string>

namespace dollytrack {
namespace {

struct PngSettings {
    int color_type;
    int bit_depth;
    std::size_t bytes_per_pixel;
    int filter;
    int strategy;
};

/// Measured on rendered rooms (render/encoders/README.md): Z_RLE compresses filtered colour images
/// and labels faster and smaller than level 1's match search; depth needs the search.
PngSettings settingsOf(PngFormat format) {
    switch (format) {
        case PngFormat::Rgb8:
            return {PNG_COLOR_TYPE_RGB, 8, 3, PNG_FILTER_SUB, Z_RLE};
        case PngFormat::Rgb16:
            return {PNG_COLOR_TYPE_RGB, 16, 6, PNG_FILTER_SUB, Z_DEFAULT_STRATEGY};
        case PngFormat::Rgba8:
            return {PNG_COLOR_TYPE_RGB_ALPHA, 8, 4, PNG_FILTER_SUB, Z_DEFAULT_STRATEGY};
        case PngFormat::Gray16:
            return {PNG_COLOR_TYPE_GRAY, 16, 2, PNG_FILTER_SUB, Z_DEFAULT_STRATEGY};
        case PngFormat::Gray8:
            break;
    }
    return {PNG_COLOR_TYPE_GRAY, 8, 1, PNG_FILTER_UP, Z_RLE};
}

struct PngWrite {
    std::vector<std::uint8_t> bytes;
    std::string problem;
};

void appendBytes(png_structp png, png_bytep data, png_size_t size) {
    auto& bytes = static_cast<PngWrite*>(png_get_io_ptr(png))->bytes;
    bytes.insert(bytes.end(), data, data + size);
}

[[noreturn]] void keepPngError(png_structp png, png_const_charp message) {
    static_cast<PngWrite*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
}

void ignoreWriterWarning(png_structp, png_const_charp) {}

/// Contains all calls that libpng may leave by longjmp(), and no objects with destructors.
bool write(png_structp png, png_infop info, PngWrite& target, int width, int height,
           const PngSettings& settings, PngEffort effort, const std::uint8_t* pixels) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &target, appendBytes, nullptr);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_compression_buffer_size(png, 1U << 16U);
    if (effort == PngEffort::Smallest) {
        png_set_compression_level(png, 9);
    } else {
        png_set_compression_level(png, 1);
        png_set_compression_strategy(png, settings.strategy);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, settings.filter);
    }
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                 settings.bit_depth, settings.color_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    if (settings.bit_depth == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    const std::size_t stride = settings.bytes_per_pixel * static_cast<std::size_t>(width);
    for (int y = 0; y < height; ++y) {
        png_write_row(png, pixels + static_cast<std::size_t>(y) * stride);
    }
    png_write_end(png, nullptr);
    return true;
}

}  // namespace

Result<std::vector<std::uint8_t>> encodePng(int width, int height, PngFormat format,
                                            std::span<const std::uint8_t> pixels,
                                            PngEffort effort) {
    const PngSettings settings = settingsOf(format);
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (pixels.size() != count * settings.bytes_per_pixel) {
        return fail(ErrorCode::Failed, "an image of " + std::to_string(width) + " x " +
                                           std::to_string(height) + " px came with " +
                                           std::to_string(pixels.size()) + " bytes");
    }
    PngWrite target;
    target.bytes.reserve(count / 2 + 1024);
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &target, keepPngError, ignoreWriterWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool done =
        info != nullptr && write(png, info, target, width, height, settings, effort, pixels.data());
    png_destroy_write_struct(&png, &info);
    if (!done) return fail(ErrorCode::Failed, "libpng: " + target.problem);
    return std::move(target.bytes);
}

}  // namespace dollytrack
