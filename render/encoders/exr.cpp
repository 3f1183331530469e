#include "render/encoders/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <string>

namespace dollytrack::render {
namespace {

/// Output stream in memory for the library.
class MemoryStream : public Imf::OStream {
  public:
    MemoryStream() : Imf::OStream("memory") {}

    void write(const char* bytes, int count) override {
        const auto end = static_cast<std::size_t>(at_) + static_cast<std::size_t>(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + at_, bytes, static_cast<std::size_t>(count));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    std::vector<std::uint8_t> bytes_;
    std::uint64_t at_ = 0;
};

/// One channel: its first value, and the distance between pixels in bytes.
struct Channel {
    const char* name;
    const void* first;
    std::size_t step;
};

Result<std::vector<std::uint8_t>> encode(int width, int height, Imf::PixelType type,
                                         std::initializer_list<Channel> channels) {
    try {
        Imf::Header header(width, height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const Channel& channel : channels) {
            header.channels().insert(channel.name, Imf::Channel(type));
        }
        MemoryStream stream;
        {
            // 0 threads: encodes on the calling thread.
            Imf::OutputFile file(stream, header, 0);
            Imf::FrameBuffer buffer;
            for (const Channel& channel : channels) {
                // The library takes a non-const pointer but only reads from it.
                auto* first = static_cast<char*>(const_cast<void*>(channel.first));
                buffer.insert(channel.name,
                              Imf::Slice(type, first, channel.step,
                                         channel.step * static_cast<std::size_t>(width)));
            }
            file.setFrameBuffer(buffer);
            file.writePixels(height);
        }
        return stream.take();
    } catch (const std::exception& e) {
        return fail(ErrorCode::Failed,
                    std::string("an EXR image cannot be made (") + e.what() + ")");
    }
}

/// `first` is the first pixel's first of three values.
template <class Value>
Result<std::vector<std::uint8_t>> encodeColours(int width, int height, Imf::PixelType type,
                                                const Value* first) {
    constexpr std::size_t kStep = 3 * sizeof(Value);
    return encode(width, height, type,
                  {{"R", first, kStep}, {"G", first + 1, kStep}, {"B", first + 2, kStep}});
}

Imath::half rounded(float value) {
    return {std::clamp(value, -static_cast<float>(HALF_MAX), static_cast<float>(HALF_MAX))};
}

}  // namespace

Result<std::vector<std::uint8_t>> encodeExr(int width, int height, std::span<const float> values) {
    return encode(width, height, Imf::FLOAT, {{"Y", values.data(), sizeof(float)}});
}

Result<std::vector<std::uint8_t>> encodeExr(int width, int height,
                                            std::span<const Eigen::Vector3f> values) {
    std::vector<Imath::half> pixels;
    pixels.reserve(3 * values.size());
    for (const Eigen::Vector3f& value : values) {
        for (int c = 0; c < 3; ++c) pixels.push_back(rounded(value[c]));
    }
    return encodeColours(width, height, Imf::HALF, pixels.data());
}

Result<std::vector<std::uint8_t>> encodeExrVectors(int width, int height,
                                                   std::span<const Eigen::Vector3f> values) {
    static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
    return encodeColours(width, height, Imf::FLOAT, reinterpret_cast<const float*>(values.data()));
}

Eigen::Vector3f roundedToHalf(const Eigen::Vector3f& values) {
    return values.unaryExpr([](float value) { return static_cast<float>(rounded(value)); });
}

}  // namespace dollytrack::render
