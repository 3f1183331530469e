#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/texture_loader.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dollytrack::io {

/// What a scene file holds, pictures decoded.
struct ReadScene {
    RawScene raw;  // its texture requests have names only
    TextureSet textures;
};

/// The version of the frames and of what readers put into them. To be raised whenever the same
/// file is read differently: frames of other versions are neither read nor kept.
inline constexpr std::uint32_t kFrameVersion = 10;

/// Bytes that a frame of this outcome takes.
[[nodiscard]] std::size_t frameSize(const Result<ReadScene>& outcome);

/// Writes the outcome of a reading as one frame: magic, version, length, sum, and then the values
/// in the machine's own byte order (it never leaves it). `out` has frameSize() bytes.
void writeFrame(const Result<ReadScene>& outcome, std::span<std::uint8_t> out);

/// Reads a frame that may come from anywhere: nothing in it is believed. Every count is held
/// against the bytes that are there, the values are checked by checkScene(); texts come back
/// clean. An outcome that was an error comes back as that error. `damaged` tells which it was:
/// true when the frame is none, with the reason as error.
[[nodiscard]] Result<ReadScene> readFrame(std::span<const std::uint8_t> frame, bool& damaged);

/// Makes the sum right again after the bytes were changed; a test's way past the first check.
void sealFrame(std::span<std::uint8_t> frame);

}  // namespace dollytrack::io
