#include "engine/io/files/jpeg_writer.h"

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string>
// Needs size_t and FILE to be declared.
#include <jpeglib.h>

namespace dollytrack {
namespace {

struct JpegWrite {
    jpeg_error_mgr manager;  // first, so that a pointer to it is also one to this struct
    std::jmp_buf leave;
    std::array<char, JMSG_LENGTH_MAX> problem{};
    unsigned char* bytes = nullptr;  // allocated by the library
    unsigned long size = 0;
};

[[noreturn]] void leaveOnJpegError(j_common_ptr info) {
    auto* write = reinterpret_cast<JpegWrite*>(info->err);
    info->err->format_message(info, write->problem.data());
    std::longjmp(write->leave, 1);
}

void ignoreJpegMessage(j_common_ptr /*info*/) {}

/// Contains all calls that libjpeg may leave by longjmp(), and no objects with destructors.
bool compress(jpeg_compress_struct& info, JpegWrite& target, int width, int height, int channels,
              int quality, const std::uint8_t* pixels, JpegTables tables) {
    if (setjmp(target.leave) != 0) return false;
    jpeg_create_compress(&info);
    jpeg_mem_dest(&info, &target.bytes, &target.size);
    info.image_width = static_cast<JDIMENSION>(width);
    info.image_height = static_cast<JDIMENSION>(height);
    info.input_components = channels;
    info.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
    if (tables == JpegTables::Optimized) info.optimize_coding = TRUE;
    jpeg_start_compress(&info, TRUE);
    const std::size_t stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    while (info.next_scanline < info.image_height) {
        // The library takes a non-const pointer but only reads from it.
        JSAMPROW row = const_cast<std::uint8_t*>(pixels) + info.next_scanline * stride;
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    return true;
}

}  // namespace

Result<std::vector<std::uint8_t>> encodeJpeg(int width, int height, int channels, int quality,
                                             std::span<const std::uint8_t> pixels,
                                             JpegTables tables) {
    const bool is_valid = width > 0 && height > 0 && (channels == 1 || channels == 3);
    if (!is_valid || pixels.size() != static_cast<std::size_t>(width) *
                                          static_cast<std::size_t>(height) *
                                          static_cast<std::size_t>(channels)) {
        return fail(ErrorCode::Failed, "an image of " + std::to_string(width) + " x " +
                                           std::to_string(height) + " px came with " +
                                           std::to_string(pixels.size()) + " bytes");
    }
    jpeg_compress_struct info{};
    JpegWrite target{};
    info.err = jpeg_std_error(&target.manager);
    target.manager.error_exit = leaveOnJpegError;
    target.manager.output_message = ignoreJpegMessage;
    const bool done =
        compress(info, target, width, height, channels, quality, pixels.data(), tables);
    jpeg_destroy_compress(&info);
    std::vector<std::uint8_t> bytes;
    if (done) bytes.assign(target.bytes, target.bytes + target.size);
    std::free(target.bytes);
    if (!done) return fail(ErrorCode::Failed, std::string("libjpeg: ") + target.problem.data());
    return bytes;
}

}  // namespace dollytrack
