#pragma once

#include "engine/core/result.h"
#include "engine/io/files/input_file.h"
#include "engine/io/pictures/codecs.h"

#include <memory>
#include <optional>

namespace dollytrack::render {

/// Decodes the first H.264 stream of an MP4 file. Such a file may name other files, network
/// addresses and codecs: they are neither opened nor decoded.
class VideoDecoder {
  public:
    /// Returns BadInput if it is no such video, Failed without libavformat.
    [[nodiscard]] static Result<VideoDecoder> open(InputFile file);
    ~VideoDecoder();
    VideoDecoder(VideoDecoder&&) noexcept;
    VideoDecoder& operator=(VideoDecoder&&) noexcept;

    /// Mean number of images per second; 0 if the file does not say.
    [[nodiscard]] double framesPerSecond() const;

    /// The next image as 8-bit RGB; the stream is taken as BT.709 in video range. Returns nullopt
    /// after the last image, and where the stream is damaged.
    [[nodiscard]] std::optional<DecodedPicture> next();

  private:
    struct Impl;
    explicit VideoDecoder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
