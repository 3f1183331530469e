#include "render/formats/media/video_decoder.h"

#include "render/formats/media/libav_functions.h"
#include "render/formats/media/video_encoder.h"

#include <algorithm>

namespace dollytrack::render {
namespace {

/// A file, for libav's callbacks.
struct FileReader {
    InputFile file;
    std::uint64_t at = 0;

    static int read(void* self, std::uint8_t* into, int size) {
        auto& reader = *static_cast<FileReader*>(self);
        const std::size_t count =
            reader.file.read(reader.at, into, static_cast<std::size_t>(std::max(size, 0)));
        reader.at += count;
        return count > 0 ? static_cast<int>(count) : AVERROR_EOF;
    }
    static std::int64_t seek(void* self, std::int64_t offset, int whence) {
        auto& reader = *static_cast<FileReader*>(self);
        return seekInFile(reader.at, reader.file.size(), offset, whence);
    }
};

struct ClosedByLibav {
    void operator()(AVFormatContext* p) const { libavFunctions()->avformat_close_input(&p); }
};

std::uint8_t toByte(int in_65536ths) {
    return static_cast<std::uint8_t>(std::clamp((in_65536ths + 32768) / 65536, 0, 255));
}

/// BT.709 video range to RGB, in integers.
DecodedPicture toRgb(const AVFrame& frame) {
    DecodedPicture picture;
    if (!makeRoom(frame.width, frame.height, 3, 8, picture)) return {};
    std::uint8_t* out = picture.data.data();
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, out += 3) {
            const int luma = 76309 * (frame.data[0][y * frame.linesize[0] + x] - 16);
            const int blue = frame.data[1][y / 2 * frame.linesize[1] + x / 2] - 128;
            const int red = frame.data[2][y / 2 * frame.linesize[2] + x / 2] - 128;
            out[0] = toByte(luma + 117489 * red);
            out[1] = toByte(luma - 13975 * blue - 34925 * red);
            out[2] = toByte(luma + 138438 * blue);
        }
    }
    return picture;
}

}  // namespace

struct VideoDecoder::Impl {
    explicit Impl(InputFile input) : reader{std::move(input)} {}

    FileReader reader;
    std::unique_ptr<AVIOContext, FreedByLibav> io;
    std::unique_ptr<AVFormatContext, ClosedByLibav> demuxer;
    std::unique_ptr<AVCodecContext, FreedByLibav> codec;
    std::unique_ptr<AVFrame, FreedByLibav> frame;
    std::unique_ptr<AVPacket, FreedByLibav> packet;
    const AVStream* stream = nullptr;  // owned by the demuxer
    bool is_read = false;              // all packets were sent

    bool open(const LibavFunctions& av);
    bool sendPacket(const LibavFunctions& av);
};

bool VideoDecoder::Impl::open(const LibavFunctions& av) {
    constexpr int kBuffer = 1 << 16;
    auto* buffer = static_cast<unsigned char*>(av.av_malloc(kBuffer));
    io.reset(av.avio_alloc_context(buffer, kBuffer, 0, &reader, FileReader::read, nullptr,
                                   FileReader::seek));
    if (!io) {
        av.av_freep(&buffer);
        return false;
    }
    AVFormatContext* made = av.avformat_alloc_context();
    if (made == nullptr) return false;
    made->pb = io.get();
    av.av_opt_set(made, "codec_whitelist", "h264", 0);
    // On failure, the function frees the context.
    if (av.avformat_open_input(&made, nullptr, av.av_find_input_format("mov"), nullptr) < 0) {
        return false;
    }
    demuxer.reset(made);
    if (av.avformat_find_stream_info(demuxer.get(), nullptr) < 0) return false;
    for (unsigned i = 0; i < demuxer->nb_streams && stream == nullptr; ++i) {
        const AVCodecParameters& kind = *demuxer->streams[i]->codecpar;
        if (kind.codec_id == AV_CODEC_ID_H264) stream = demuxer->streams[i];
    }
    const AVCodec* decoder = av.avcodec_find_decoder(AV_CODEC_ID_H264);
    if (stream == nullptr || decoder == nullptr) return false;
    codec.reset(av.avcodec_alloc_context3(decoder));
    frame.reset(av.av_frame_alloc());
    packet.reset(av.av_packet_alloc());
    if (!codec || !frame || !packet) return false;
    if (av.avcodec_parameters_to_context(codec.get(), stream->codecpar) < 0) return false;
    codec->thread_count = 1;
    return av.avcodec_open2(codec.get(), decoder, nullptr) >= 0;
}

/// Sends the next packet of the stream, or the end of it, to the decoder.
bool VideoDecoder::Impl::sendPacket(const LibavFunctions& av) {
    while (!is_read) {
        if (av.av_read_frame(demuxer.get(), packet.get()) < 0) {
            is_read = true;
            return av.avcodec_send_packet(codec.get(), nullptr) >= 0;
        }
        const bool is_ours = packet->stream_index == stream->index;
        const int error = is_ours ? av.avcodec_send_packet(codec.get(), packet.get()) : 0;
        av.av_packet_unref(packet.get());
        if (is_ours) return error >= 0;
    }
    return false;
}

VideoDecoder::VideoDecoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VideoDecoder::~VideoDecoder() = default;
VideoDecoder::VideoDecoder(VideoDecoder&&) noexcept = default;
VideoDecoder& VideoDecoder::operator=(VideoDecoder&&) noexcept = default;

Result<VideoDecoder> VideoDecoder::open(InputFile file) {
    const LibavFunctions* av = libavFunctions();
    if (av == nullptr) return fail(ErrorCode::Failed, missingVideoLibrary());
    auto impl = std::make_unique<Impl>(std::move(file));
    if (!impl->open(*av)) return fail(ErrorCode::BadInput, "it cannot be opened as a video");
    return VideoDecoder(std::move(impl));
}

double VideoDecoder::framesPerSecond() const {
    const AVRational rate = impl_->stream->avg_frame_rate;
    return rate.den > 0 ? static_cast<double>(rate.num) / rate.den : 0.0;
}

std::optional<DecodedPicture> VideoDecoder::next() {
    const LibavFunctions& av = *libavFunctions();
    for (;;) {
        const int error = av.avcodec_receive_frame(impl_->codec.get(), impl_->frame.get());
        if (error == AVERROR(EAGAIN) && impl_->sendPacket(av)) continue;
        if (error < 0 || impl_->frame->format != AV_PIX_FMT_YUV420P) return std::nullopt;
        DecodedPicture picture = toRgb(*impl_->frame);
        if (picture.data.empty()) return std::nullopt;
        return picture;
    }
}

}  // namespace dollytrack::render
