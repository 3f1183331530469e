#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <cstdint>

namespace dollytrack::render {

// Each name once: its type is the header's, its symbol the library's.
// clang-format off
#define DOLLYTRACK_LIBAV_FUNCTIONS(each)                                                          \
    each(av_d2q) each(av_find_input_format) each(av_frame_alloc) each(av_frame_free)              \
    each(av_frame_get_buffer) each(av_frame_unref) each(av_freep)                                 \
    each(av_interleaved_write_frame) each(av_log_set_level) each(av_malloc) each(av_opt_set)      \
    each(av_packet_alloc) each(av_packet_free) each(av_packet_rescale_ts) each(av_packet_unref)   \
    each(av_read_frame) each(av_strerror) each(av_write_trailer)                                  \
    each(avcodec_alloc_context3) each(avcodec_find_decoder) each(avcodec_find_encoder)            \
    each(avcodec_free_context) each(avcodec_open2) each(avcodec_parameters_from_context)          \
    each(avcodec_parameters_to_context) each(avcodec_receive_frame) each(avcodec_receive_packet)  \
    each(avcodec_send_frame) each(avcodec_send_packet)                                            \
    each(avformat_alloc_context) each(avformat_alloc_output_context2) each(avformat_close_input)  \
    each(avformat_find_stream_info) each(avformat_free_context) each(avformat_new_stream)         \
    each(avformat_open_input) each(avformat_write_header)                                         \
    each(avio_alloc_context) each(avio_context_free) each(avio_flush)
// clang-format on

/// The functions of libavformat, libavcodec and libavutil for reading and writing videos. The
/// libraries bring more than 100 others and take a tenth of a second to load, so they are loaded
/// at the first use.
struct LibavFunctions {
#define DOLLYTRACK_DECLARE(name) decltype(&::name) name = nullptr;
    DOLLYTRACK_LIBAV_FUNCTIONS(DOLLYTRACK_DECLARE)
#undef DOLLYTRACK_DECLARE
};

/// Loads the libraries once; null if one is missing. Safe to call from many threads.
[[nodiscard]] const LibavFunctions* libavFunctions();

/// A seek in a file of `size` bytes as libav's callback has to do it: sets `at` and returns it, or
/// returns the size if asked for, or an error.
std::int64_t seekInFile(std::uint64_t& at, std::uint64_t size, std::int64_t offset, int whence);

/// Frees libav's objects. They exist only after libavFunctions() has succeeded.
struct FreedByLibav {
    void operator()(AVCodecContext* p) const { libavFunctions()->avcodec_free_context(&p); }
    void operator()(AVFrame* p) const { libavFunctions()->av_frame_free(&p); }
    void operator()(AVPacket* p) const { libavFunctions()->av_packet_free(&p); }
    void operator()(AVFormatContext* p) const { libavFunctions()->avformat_free_context(p); }
    void operator()(AVIOContext* p) const {
        libavFunctions()->av_freep(&p->buffer);
        libavFunctions()->avio_context_free(&p);
    }
};

}  // namespace dollytrack::render
