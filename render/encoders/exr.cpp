#include "render/encoders/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <cstring>
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

}  // namespace

Result<std::vector<std::uint8_t>> encodeExr(int width, int height, std::span<const float> values) {
    try {
        Imf::Header header(width, height);
        header.compression() = Imf::ZIP_COMPRESSION;
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        MemoryStream stream;
        {
            // 0 threads: encodes on the calling thread.
            Imf::OutputFile file(stream, header, 0);
            // The library takes a non-const pointer but only reads from it.
            auto* first = const_cast<char*>(reinterpret_cast<const char*>(values.data()));
            Imf::FrameBuffer buffer;
            buffer.insert("Y", Imf::Slice(Imf::FLOAT, first, sizeof(float),
                                          sizeof(float) * static_cast<std::size_t>(width)));
            file.setFrameBuffer(buffer);
            file.writePixels(height);
        }
        return stream.take();
    } catch (const std::exception& e) {
        return fail(ErrorCode::Failed,
                    std::string("an EXR image cannot be made (") + e.what() + ")");
    }
}

}  // namespace dollytrack::render
