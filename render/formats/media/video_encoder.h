#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace dollytrack::render {

/// Makes an MP4 of H.264 pictures in memory. One thread and no clock: the same pictures give the
/// same bytes with the same libraries, whatever the machine's number of cores.
class VideoEncoder {
  public:
    /// Sizes are rounded down to even ones, as the format asks. Failed when there is no encoder.
    [[nodiscard]] static Result<VideoEncoder> begin(int width, int height, double frames_per_s);
    ~VideoEncoder();
    VideoEncoder(VideoEncoder&&) noexcept;
    VideoEncoder& operator=(VideoEncoder&&) noexcept;

    /// Adds a picture: rows from the top, 3 bytes a pixel, sRGB, of the size given at the
    /// beginning.
    [[nodiscard]] Status add(std::span<const std::uint8_t> rgb);

    /// The file. The object is used up afterwards.
    [[nodiscard]] Result<std::string> finish();

  private:
    struct Impl;
    explicit VideoEncoder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
