#pragma once

#include "engine/core/result.h"
#include "engine/io/pictures/texture_loader.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dollytrack {

/// The content of a scene file, with decoded textures.
struct DecodedScene {
    RawScene raw;  // texture requests hold only names
    TextureSet textures;
};

/// Version of the binary format and of the readers' results. It must be raised whenever the same
/// file is read differently: scenes of other versions are neither read nor cached.
inline constexpr std::uint32_t kSerializationVersion = 12;

/// The size of the serialized outcome in bytes.
[[nodiscard]] std::size_t serializedSize(const Result<DecodedScene>& outcome);

/// Serializes the outcome of a reading: magic, version, length, checksum, then the values in the
/// machine's native byte order, because the bytes never leave the machine. `out` has
/// serializedSize() bytes.
void serializeScene(const Result<DecodedScene>& outcome, std::span<std::uint8_t> out);

/// Reads bytes of untrusted origin. Counts are checked against the number of bytes, values by
/// checkScene(); texts are cleaned. If the reading had failed, its error is returned. `damaged` is
/// set if the bytes themselves are invalid; the error then gives the reason.
[[nodiscard]] Result<DecodedScene> deserializeScene(std::span<const std::uint8_t> bytes,
                                                    bool& damaged);

/// Updates the checksum after the bytes were changed, so that tests can reach the checks behind it.
void updateChecksum(std::span<std::uint8_t> bytes);

}  // namespace dollytrack
