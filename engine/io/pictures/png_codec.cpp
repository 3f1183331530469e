#include "engine/io/pictures/codecs.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>

namespace dollytrack {
namespace {

struct PngSource {
    PictureBytes bytes;
    DecodedPicture picture;
    std::vector<png_bytep> rows;
};

void readBytes(png_structp png, png_bytep into, png_size_t size) {
    auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
    if (size > source.bytes.size()) png_error(png, "end of file");
    std::memcpy(into, source.bytes.data(), size);
    source.bytes = source.bytes.subspan(size);
}

[[noreturn]] void leaveOnPngError(png_structp png, png_const_charp) {
    png_longjmp(png, 1);
}

void ignorePngWarning(png_structp, png_const_charp) {}

/// Contains all calls that libpng may leave by longjmp(), and no objects with destructors.
bool read(png_structp png, png_infop info, PngSource& source) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, &source, readBytes);
    png_read_info(png, info);
    const bool deep = png_get_bit_depth(png, info) == 16;
    png_set_expand(png);
    if (deep && std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    DecodedPicture& picture = source.picture;
    if (!makeRoom(png_get_image_width(png, info), png_get_image_height(png, info),
                  png_get_channels(png, info), deep ? 16 : 8, picture)) {
        return false;
    }
    const std::size_t stride = png_get_rowbytes(png, info);
    if (stride * static_cast<std::size_t>(picture.height) != picture.data.size()) return false;
    source.rows.resize(picture.height);
    for (std::size_t y = 0; y < source.rows.size(); ++y) {
        source.rows[y] = picture.data.data() + y * stride;
    }
    png_read_image(png, source.rows.data());
    return true;
}

}  // namespace

std::optional<DecodedPicture> unpackPng(PictureBytes bytes) {
    PngSource source{bytes, {}, {}};
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leaveOnPngError, ignorePngWarning);
    if (png == nullptr) return std::nullopt;
    png_infop info = png_create_info_struct(png);
    const bool whole = info != nullptr && read(png, info, source);
    png_destroy_read_struct(&png, &info, nullptr);
    if (!whole) return std::nullopt;
    return std::move(source.picture);
}

}  // namespace dollytrack
