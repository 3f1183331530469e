#pragma once

#include "engine/io/sandbox/scene_serialization.h"

#include <cstdint>
#include <vector>

namespace dollytrack::test {

/// A scene with data in every member: two meshes under three nodes, two materials, two objects, and
/// a valid, a missing and a broken texture.
DecodedScene smallDecodedScene();

std::vector<std::uint8_t> serialized(const Result<DecodedScene>& outcome);

}  // namespace dollytrack::test
