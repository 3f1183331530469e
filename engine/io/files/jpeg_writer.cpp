#include "engine/io/files/jpeg_writer.h"

#include <array>
#include <csetjmp>
#include <cstdio>
#include <new>
#include <string>
// Needs size_t and FILE to be declared.
#include <jpeglib.h>
// Needs jpeglib.h.
#include <jerror.h>

namespace dollytrack {
namespace {

struct JpegErrors {
    jpeg_error_mgr manager;  // first, so that a pointer to it is also one to this struct
    std::jmp_buf leave;
    std::array<char, JMSG_LENGTH_MAX> problem{};
};

/// Collects the compressed bytes. The library's own destination frees its buffer twice after an
/// error.
struct JpegBytes {
    jpeg_destination_mgr manager;  // first, so that a pointer to it is also one to this struct
    std::vector<std::uint8_t> bytes;

    static JpegBytes& of(j_compress_ptr info) { return *reinterpret_cast<JpegBytes*>(info->dest); }

    /// Makes room for more bytes; exceptions must not pass through the library.
    bool grow(std::size_t size) noexcept {
        try {
            const std::size_t used = bytes.size();
            bytes.resize(size);
            manager.next_output_byte = bytes.data() + used;
            manager.free_in_buffer = size - used;
        } catch (const std::bad_alloc&) {
            return false;
        }
        return true;
    }
};

void beginBytes(j_compress_ptr info) {
    if (!JpegBytes::of(info).grow(1U << 16U)) ERREXIT1(info, JERR_OUT_OF_MEMORY, 0);
}

boolean growBytes(j_compress_ptr info) {
    JpegBytes& target = JpegBytes::of(info);
    if (!target.grow(2 * target.bytes.size())) ERREXIT1(info, JERR_OUT_OF_MEMORY, 0);
    return TRUE;
}

void endBytes(j_compress_ptr info) {
    JpegBytes& target = JpegBytes::of(info);
    target.bytes.resize(target.bytes.size() - target.manager.free_in_buffer);
}

[[noreturn]] void leaveOnJpegError(j_common_ptr info) {
    auto* errors = reinterpret_cast<JpegErrors*>(info->err);
    info->err->format_message(info, errors->problem.data());
    std::longjmp(errors->leave, 1);
}

void ignoreJpegMessage(j_common_ptr /*info*/) {}

/// Contains all calls that libjpeg may leave by longjmp(), and no objects with destructors.
bool compress(jpeg_compress_struct& info, JpegErrors& errors, JpegBytes& target, int width,
              int height, int channels, int quality, const std::uint8_t* pixels,
              JpegTables tables) {
    if (setjmp(errors.leave) != 0) return false;
    jpeg_create_compress(&info);
    info.dest = &target.manager;
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
    JpegErrors errors{};
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leaveOnJpegError;
    errors.manager.output_message = ignoreJpegMessage;
    JpegBytes target{};
    target.manager.init_destination = beginBytes;
    target.manager.empty_output_buffer = growBytes;
    target.manager.term_destination = endBytes;
    const bool done =
        compress(info, errors, target, width, height, channels, quality, pixels.data(), tables);
    jpeg_destroy_compress(&info);
    if (!done) return fail(ErrorCode::Failed, std::string("libjpeg: ") + errors.problem.data());
    return std::move(target.bytes);
}

}  // namespace dollytrack
