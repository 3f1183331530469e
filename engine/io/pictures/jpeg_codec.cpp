#include "engine/io/pictures/codecs.h"

#include <csetjmp>
#include <cstdio>
// Needs size_t and FILE to be declared.
#include <jpeglib.h>

namespace dollytrack {
namespace {

struct Watch {
    jpeg_error_mgr manager;  // first, so that a pointer to it is also one to this struct
    std::jmp_buf leave;
};

[[noreturn]] void onError(j_common_ptr info) {
    std::longjmp(reinterpret_cast<Watch*>(info->err)->leave, 1);
}

void onMessage(j_common_ptr) {}

/// Converts CMYK, which programs store inverted, to RGB.
void fromCmyk(std::vector<std::uint8_t>& row, std::uint8_t* out) {
    for (std::size_t x = 0; 4 * x < row.size(); ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
            out[3 * x + c] = static_cast<std::uint8_t>(row[4 * x + c] * row[4 * x + 3] / 255);
        }
    }
}

/// Contains all calls that libjpeg may leave by longjmp(), and no objects with destructors.
bool read(jpeg_decompress_struct& info, Watch& watch, PictureBytes bytes, DecodedPicture& picture,
          std::vector<std::uint8_t>& row) {
    if (setjmp(watch.leave) != 0) return false;
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, bytes.data(), bytes.size());
    jpeg_read_header(&info, TRUE);
    const bool grey = info.jpeg_color_space == JCS_GRAYSCALE;
    const bool cmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
    info.out_color_space = grey ? JCS_GRAYSCALE : cmyk ? JCS_CMYK : JCS_RGB;
    if (!makeRoom(info.image_width, info.image_height, grey ? 1 : 3, 8, picture)) return false;
    jpeg_start_decompress(&info);
    const std::size_t stride =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
    row.resize(cmyk ? 4 * static_cast<std::size_t>(picture.width) : 0);
    while (info.output_scanline < info.output_height) {
        std::uint8_t* out = picture.data.data() + info.output_scanline * stride;
        JSAMPROW line = cmyk ? row.data() : out;
        jpeg_read_scanlines(&info, &line, 1);
        if (cmyk) fromCmyk(row, out);
    }
    jpeg_finish_decompress(&info);
    return true;
}

}  // namespace

std::optional<DecodedPicture> unpackJpeg(PictureBytes bytes) {
    jpeg_decompress_struct info{};
    Watch watch{};
    info.err = jpeg_std_error(&watch.manager);
    watch.manager.error_exit = onError;
    watch.manager.output_message = onMessage;
    DecodedPicture picture;
    std::vector<std::uint8_t> row;
    const bool whole = read(info, watch, bytes, picture, row);
    jpeg_destroy_decompress(&info);
    if (!whole) return std::nullopt;
    return picture;
}

}  // namespace dollytrack
