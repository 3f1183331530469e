#include "render/verify/read/exr_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace dollytrack::verify {
namespace {

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

Result<ImageF> decodeExr(std::string_view bytes, int channels) {
    constexpr std::array kColours = {"R", "G", "B"};
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
    try {
        BytesStream stream(bytes);
        Imf::InputFile file(stream, 0);
        const Imath::Box2i window = file.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels ||
            width * height > kMostPixels) {
            return fail(ErrorCode::BadInput,
                        fmt::format("its header declares {} x {} px", width, height));
        }
        const auto count = static_cast<std::size_t>(channels);
        ImageF image{static_cast<int>(width), static_cast<int>(height), channels, {}};
        image.values.resize(static_cast<std::size_t>(width * height) * count);
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < count; ++c) {
            const char* name = channels == 1 ? "Y" : kColours[c];
            // The library would fill a missing channel with zeros.
            if (file.header().channels().findChannel(name) == nullptr) {
                return fail(ErrorCode::BadInput, fmt::format("it has no channel '{}'", name));
            }
            constexpr std::size_t kBytes = sizeof(float);
            buffer.insert(
                name, Imf::Slice::Make(Imf::FLOAT, image.values.data() + c, window, count * kBytes,
                                       count * kBytes * static_cast<std::size_t>(width)));
        }
        file.setFrameBuffer(buffer);
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& e) {
        return fail(ErrorCode::BadInput, fmt::format("it cannot be decoded ({})", e.what()));
    }
}

}  // namespace dollytrack::verify
