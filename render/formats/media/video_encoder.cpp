#include "render/formats/media/video_encoder.h"

#include "render/formats/media/libav_functions.h"

#include <locale.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace dollytrack::render {
namespace {

tl::unexpected<Error> problem(const char* doing, int error) {
    std::array<char, 128> text{};
    const LibavFunctions* av = libavFunctions();
    av->av_strerror(error, text.data(), text.size());
    return fail(ErrorCode::Failed,
                std::string("libav could not ") + doing + " (" + text.data() + ")", "preview.mp4");
}

/// x264 writes its settings into the file, with the decimal separator of the thread's locale.
class PlainNumbers {
  public:
    PlainNumbers() : plain_(::newlocale(LC_ALL_MASK, "C", nullptr)) {
        if (plain_) before_ = ::uselocale(plain_);
    }
    ~PlainNumbers() {
        if (!plain_) return;
        ::uselocale(before_);
        ::freelocale(plain_);
    }
    PlainNumbers(const PlainNumbers&) = delete;
    PlainNumbers& operator=(const PlainNumbers&) = delete;

  private:
    locale_t plain_;
    locale_t before_ = nullptr;
};

template <class T>
using Owned = std::unique_ptr<T, FreedByLibav>;

/// An in-memory file in which the muxer may seek.
struct MemoryFile {
    std::string bytes;
    std::size_t at = 0;

    static int write(void* self, std::uint8_t* data, int size) {
        auto& file = *static_cast<MemoryFile*>(self);
        const auto count = static_cast<std::size_t>(size);
        if (file.bytes.size() < file.at + count) file.bytes.resize(file.at + count);
        std::memcpy(file.bytes.data() + file.at, data, count);
        file.at += count;
        return size;
    }
    static std::int64_t seek(void* self, std::int64_t offset, int whence) {
        auto& file = *static_cast<MemoryFile*>(self);
        return seekInFile(file.at, file.bytes.size(), offset, whence);
    }
};

/// RGB to BT.709 video range in integers, for identical results on every processor.
void toYuv(std::span<const std::uint8_t> rgb, int stride_px, AVFrame& out) {
    const auto pixel = [&](int x, int y) {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_px) +
                                 static_cast<std::size_t>(x));
    };
    // Weights in units of 1/65536, including the range (219 and 224 of 255).
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const std::uint8_t* p = pixel(x, y);
            out.data[0][y * out.linesize[0] + x] = static_cast<std::uint8_t>(
                (11966 * p[0] + 40254 * p[1] + 4064 * p[2] + 32768) / 65536 + 16);
        }
    }
    for (int y = 0; y < out.height / 2; ++y) {
        for (int x = 0; x < out.width / 2; ++x) {
            std::array<int, 3> sum{};
            for (const std::uint8_t* p : {pixel(2 * x, 2 * y), pixel(2 * x + 1, 2 * y),
                                          pixel(2 * x, 2 * y + 1), pixel(2 * x + 1, 2 * y + 1)}) {
                for (std::size_t c = 0; c < 3; ++c) sum[c] += p[c];
            }
            const auto chroma = [&](int r, int g, int b) {
                const int value = r * sum[0] + g * sum[1] + b * sum[2];
                return static_cast<std::uint8_t>((value + 128 * 4 * 65536 + 2 * 65536) /
                                                 (4 * 65536));
            };
            out.data[1][y * out.linesize[1] + x] = chroma(-6596, -22189, 28785);
            out.data[2][y * out.linesize[2] + x] = chroma(28785, -26145, -2640);
        }
    }
}

}  // namespace

struct VideoEncoder::Impl {
    MemoryFile file;
    Owned<AVIOContext> io;
    Owned<AVFormatContext> muxer;
    Owned<AVCodecContext> codec;
    Owned<AVFrame> frame;
    Owned<AVPacket> packet;
    const LibavFunctions* av = nullptr;
    AVStream* stream = nullptr;  // owned by the muxer
    int width = 0;               // of the input images
    int height = 0;

    Status open(double frames_per_s);
    Status openCodec(double frames_per_s);
    Status send(const AVFrame* picture);
};

Status VideoEncoder::Impl::openCodec(double frames_per_s) {
    const PlainNumbers plain;
    const AVCodec* encoder = av->avcodec_find_encoder(AV_CODEC_ID_H264);
    if (!encoder) {
        return fail(ErrorCode::Failed,
                    "libavcodec lacks an H.264 encoder; leave out the format 'video'", "--formats");
    }
    codec.reset(av->avcodec_alloc_context3(encoder));
    if (!codec) return problem("create an encoder", AVERROR(ENOMEM));
    codec->width = width / 2 * 2;
    codec->height = height / 2 * 2;
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->framerate = av->av_d2q(frames_per_s, 100'000);
    codec->time_base = av_inv_q(codec->framerate);
    codec->gop_size = 24;  // frequent key frames, for fast seeking
    codec->color_primaries = AVCOL_PRI_BT709;
    codec->color_trc = AVCOL_TRC_BT709;
    codec->colorspace = AVCOL_SPC_BT709;
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->thread_count = 1;
    codec->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
    // Options of x264; other encoders ignore them and use their defaults.
    av->av_opt_set(codec->priv_data, "preset", "veryfast", 0);
    av->av_opt_set(codec->priv_data, "crf", "24", 0);
    // With mbtree, x264 164 encodes small images differently from run to run.
    av->av_opt_set(codec->priv_data, "mbtree", "0", 0);
    if (const int error = av->avcodec_open2(codec.get(), encoder, nullptr); error < 0) {
        return problem("start the encoder", error);
    }
    return {};
}

Status VideoEncoder::Impl::open(double frames_per_s) {
    if (Status status = openCodec(frames_per_s); !status) return status;
    AVFormatContext* made = nullptr;
    if (const int error = av->avformat_alloc_output_context2(&made, nullptr, "mp4", nullptr);
        error < 0) {
        return problem("create a file", error);
    }
    muxer.reset(made);
    constexpr int kBuffer = 1 << 16;
    io.reset(av->avio_alloc_context(static_cast<unsigned char*>(av->av_malloc(kBuffer)), kBuffer, 1,
                                    &file, nullptr, MemoryFile::write, MemoryFile::seek));
    stream = av->avformat_new_stream(muxer.get(), nullptr);
    frame.reset(av->av_frame_alloc());
    packet.reset(av->av_packet_alloc());
    if (!io || !stream || !frame || !packet) return problem("start a file", AVERROR(ENOMEM));
    muxer->pb = io.get();
    muxer->flags |= AVFMT_FLAG_BITEXACT;  // no version and no date
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = codec->framerate;
    int error = av->avcodec_parameters_from_context(stream->codecpar, codec.get());
    if (error >= 0) error = av->avformat_write_header(muxer.get(), nullptr);
    if (error < 0) return problem("start a file", error);
    frame->format = codec->pix_fmt;
    frame->width = codec->width;
    frame->height = codec->height;
    frame->pts = 0;
    return {};
}

/// Sends an image to the encoder (null: end of stream) and writes the packets it returns.
Status VideoEncoder::Impl::send(const AVFrame* picture) {
    const PlainNumbers plain;
    int error = av->avcodec_send_frame(codec.get(), picture);
    while (error >= 0) {
        error = av->avcodec_receive_packet(codec.get(), packet.get());
        if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return {};
        if (error < 0) break;
        packet->duration = 1;
        av->av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
        packet->stream_index = stream->index;
        error = av->av_interleaved_write_frame(muxer.get(), packet.get());
    }
    return problem("encode an image", error);
}

VideoEncoder::VideoEncoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VideoEncoder::~VideoEncoder() = default;
VideoEncoder::VideoEncoder(VideoEncoder&&) noexcept = default;
VideoEncoder& VideoEncoder::operator=(VideoEncoder&&) noexcept = default;

Result<VideoEncoder> VideoEncoder::begin(int width, int height, double frames_per_s) {
    const LibavFunctions* av = libavFunctions();
    if (av == nullptr) return fail(ErrorCode::Failed, missingVideoLibrary(), "preview.mp4");
    auto impl = std::make_unique<Impl>();
    impl->av = av;
    impl->width = width;
    impl->height = height;
    if (Status status = impl->open(frames_per_s); !status) return tl::unexpected(status.error());
    return VideoEncoder(std::move(impl));
}

Status VideoEncoder::add(std::span<const std::uint8_t> rgb) {
    Impl& impl = *impl_;
    if (rgb.size() !=
        3U * static_cast<std::size_t>(impl.width) * static_cast<std::size_t>(impl.height)) {
        return fail(ErrorCode::Failed, "an image for the video has another size", "preview.mp4");
    }
    // The encoder may still hold the previous image, so each gets its own buffer.
    const std::int64_t pts = impl.frame->pts;
    impl.av->av_frame_unref(impl.frame.get());
    impl.frame->format = impl.codec->pix_fmt;
    impl.frame->width = impl.codec->width;
    impl.frame->height = impl.codec->height;
    if (const int error = impl.av->av_frame_get_buffer(impl.frame.get(), 0); error < 0) {
        return problem("create an image", error);
    }
    toYuv(rgb, impl.width, *impl.frame);
    impl.frame->pts = pts;
    Status status = impl.send(impl.frame.get());
    impl.frame->pts = pts + 1;
    return status;
}

Result<std::string> VideoEncoder::finish() {
    if (Status status = impl_->send(nullptr); !status) return tl::unexpected(status.error());
    if (const int error = impl_->av->av_write_trailer(impl_->muxer.get()); error < 0) {
        return problem("finish the file", error);
    }
    impl_->av->avio_flush(impl_->io.get());
    return std::move(impl_->file.bytes);
}

}  // namespace dollytrack::render
