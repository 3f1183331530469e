#include "render/encoders/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <cstring>
#include <stdexcept>
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

/// Input stream in memory for the library.
class BytesStream : public Imf::IStream {
  public:
    explicit BytesStream(std::string_view bytes) : Imf::IStream("memory"), bytes_(bytes) {}

    bool read(char* into, int count) override {
        if (count < 0 || at_ + static_cast<std::uint64_t>(count) > bytes_.size()) {
            throw std::runtime_error("it is truncated");
        }
        std::memcpy(into, bytes_.data() + at_, static_cast<std::size_t>(count));
        at_ += static_cast<std::uint64_t>(count);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) throw std::runtime_error("it is truncated");
        at_ = position;
    }

  private:
    std::string_view bytes_;
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

Result<DecodedExr> decodeExr(std::string_view bytes) {
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
    try {
        BytesStream stream(bytes);
        Imf::InputFile file(stream, 0);
        const Imath::Box2i window = file.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels ||
            width * height > kMostPixels) {
            return fail(ErrorCode::BadInput, "its header declares " + std::to_string(width) +
                                                 " x " + std::to_string(height) + " px");
        }
        const bool is_grey = file.header().channels().findChannel("Y") != nullptr;
        const std::vector<const char*> names =
            is_grey ? std::vector{"Y"} : std::vector{"R", "G", "B"};
        DecodedExr image{
            static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()), {}};
        image.values.resize(static_cast<std::size_t>(width * height) * names.size());
        const std::size_t pixel = sizeof(float) * names.size();
        const std::size_t row = pixel * static_cast<std::size_t>(width);
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < names.size(); ++c) {
            // The library addresses pixels by their place in the data window.
            char* first = reinterpret_cast<char*>(image.values.data() + c) -
                          window.min.x * static_cast<std::ptrdiff_t>(pixel) -
                          window.min.y * static_cast<std::ptrdiff_t>(row);
            buffer.insert(names[c], Imf::Slice(Imf::FLOAT, first, pixel, row));
        }
        file.setFrameBuffer(buffer);
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& e) {
        return fail(ErrorCode::BadInput, std::string("it cannot be decoded (") + e.what() + ")");
    }
}

}  // namespace dollytrack::render
