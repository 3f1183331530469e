#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace dollytrack::render {

/// Returns a sentence if libavformat is not installed, else null. VideoEncoder and VideoDecoder
/// load it at their first use.
[[nodiscard]] const char* missingVideoLibrary();

/// Encodes an H.264 video as MP4 in memory. Single-threaded and without timestamps: with the same
/// libraries, equal images give equal bytes on any number of cores.
class VideoEncoder {
  public:
    /// Sizes are rounded down to even numbers, as the format requires. Returns Failed if no H.264
    /// encoder or no libavformat is available.
    [[nodiscard]] static Result<VideoEncoder> begin(int width, int height, double frames_per_s);
    ~VideoEncoder();
    VideoEncoder(VideoEncoder&&) noexcept;
    VideoEncoder& operator=(VideoEncoder&&) noexcept;

    /// Adds an sRGB image of the size given to begin(), 3 bytes per pixel, row 0 at the top.
    [[nodiscard]] Status add(std::span<const std::uint8_t> rgb);

    /// The encoded file. The object cannot be used afterwards.
    [[nodiscard]] Result<std::string> finish();

  private:
    struct Impl;
    explicit VideoEncoder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
