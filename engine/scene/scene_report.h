#pragma once

#include "engine/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace dollytrack {

/// What `info` reports, as JSON: sizes, objects, classes, triangles, textures, repairs and doubts.
/// The caller adds the rooms, which are not known here.
nlohmann::json toJson(const Scene& scene);

/// What `info` reports, as text: a summary, one line per object, then notes and warnings.
std::string describeScene(const Scene& scene);

/// The class in tables: that of the label file if it has classes, otherwise that of NYU40;
/// "unknown" for none.
std::string className(const Object& object);
/// "target", "structure" or "excluded".
std::string_view roleName(Role role);
/// "annotation", "wall", "short_side" or "room_centre".
std::string_view frontSourceName(FrontSource source);

}  // namespace dollytrack
