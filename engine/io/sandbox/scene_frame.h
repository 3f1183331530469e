#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/texture_loader.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dollytrack::io {

/// The content of a scene file, with decoded textures.
struct ReadScene {
    RawScene raw;  // texture requests hold only names
    TextureSet textures;
};

/// Version of the frame format and of the readers' results. It must be raised whenever the same
/// file is read differently: frames of other versions are neither read nor cached.
inline constexpr std::uint32_t kFrameVersion = 10;

/// The size of this outcome's frame in bytes.
[[nodiscard]] std::size_t frameSize(const Result<ReadScene>& outcome);

/// Writes the outcome of a reading as a frame: magic, version, length, checksum, then the values in
/// the machine's native byte order, because a frame never leaves the machine. `out` has frameSize()
/// bytes.
void writeFrame(const Result<ReadScene>& outcome, std::span<std::uint8_t> out);

/// Reads a frame of untrusted origin. Counts are checked against the size of the frame, values by
/// checkScene(); texts are cleaned. If the outcome was an error, that error is returned. `damaged`
/// is set if the frame itself is invalid; the error then gives the reason.
[[nodiscard]] Result<ReadScene> readFrame(std::span<const std::uint8_t> frame, bool& damaged);

/// Updates the checksum after the bytes were changed, so that tests can reach the checks behind it.
void sealFrame(std::span<std::uint8_t> frame);

}  // namespace dollytrack::io
