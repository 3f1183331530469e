#pragma once

#include "engine/io/sandbox/scene_frame.h"

#include <cstdint>
#include <vector>

namespace dollytrack::test {

/// A scene with data in every member: two meshes under three nodes, two materials, two objects, and
/// a valid, a missing and a broken texture.
io::ReadScene smallReadScene();

std::vector<std::uint8_t> frameOf(const Result<io::ReadScene>& outcome);

}  // namespace dollytrack::test
