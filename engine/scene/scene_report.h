#pragma once

#include "engine/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace dollytrack {

/// What `info` says of a scene, for programs: sizes, objects, classes, triangles, textures, and
/// everything repaired or doubtful. Rooms are not known here; the caller adds them.
nlohmann::json toJson(const Scene& scene);

/// The same for people: a summary, one line an object, then notes and warnings.
std::string describeScene(const Scene& scene);

/// "target", "structure" or "excluded".
std::string_view roleName(Role role);
/// "annotation", "wall", "short_side" or "room_centre".
std::string_view frontSourceName(FrontSource source);

}  // namespace dollytrack
