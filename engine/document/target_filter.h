#pragma once

#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The name of objects without a class, as reports print it, wherever a class may be named.
inline constexpr std::string_view kWithoutClass = "unknown";

/// Whether a pattern names the object: its NYU40 class in any usual spelling, or a name (its
/// own, or that of its class, NYU40's or of the scene's own table) in which `*` stands for any text
/// and `?` for one character. Capital and small letters are alike.
bool isNamedBy(const Object& object, std::string_view pattern);

/// Whether a pattern is the name of a class, of NYU40 or of the scene's own table, whether or not
/// the scene has an object of it.
bool isClassName(const Scene& scene, std::string_view pattern);

/// Whether the lists make the object no target.
bool isFilteredOut(const Object& object, const SceneEdits& edits);

/// Excludes the targets that `edits.ignore` names, and where `edits.only` names any, those that it
/// does not. A pattern that names nothing in the scene is warned of.
void filterTargets(Scene& scene, const SceneEdits& edits);

}  // namespace dollytrack
