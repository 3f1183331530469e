#pragma once

#include "engine/core/result.h"
#include "engine/io/gltf/document.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <string>

namespace dollytrack::gltf {

/// Reads the bytes of a glTF 2.0 file, .gltf or .glb. `where` names it in errors. Error: BadInput.
[[nodiscard]] Result<RawScene> readGltf(std::string file, const ReadBeside& read_beside,
                                        const std::string& where, const JobContext& job);

}  // namespace dollytrack::gltf
