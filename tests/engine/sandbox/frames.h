#pragma once

#include "engine/io/sandbox/scene_frame.h"

#include <cstdint>
#include <vector>

namespace dollytrack::test {

/// A scene with something in every member: two meshes under three nodes, two materials, two
/// objects, a picture that was found, one that is missing and a broken one.
io::ReadScene smallReadScene();

std::vector<std::uint8_t> frameOf(const Result<io::ReadScene>& outcome);

}  // namespace dollytrack::test
