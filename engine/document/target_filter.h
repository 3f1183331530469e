#pragma once

#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The class name of objects without a class, in reports and wherever a class can be given.
inline constexpr std::string_view kWithoutClass = "unknown";

/// Whether a pattern matches the object. A pattern is its NYU40 class in any usual spelling, or a
/// name in which `*` stands for any text and `?` for one character; it is compared with the
/// object's name and with the names of its NYU40 class and of its class in the scene's own table.
/// Case does not matter.
bool isNamedBy(const Object& object, std::string_view pattern);

/// Whether a pattern is the name of an NYU40 class or of a class in the scene's own table. The
/// scene need not have an object of this class.
bool isClassName(const Scene& scene, std::string_view pattern);

/// Whether the lists `ignore` and `only` make the object a non-target.
bool isFilteredOut(const Object& object, const SceneEdits& edits);

/// Excludes the targets that match `edits.ignore`, and, if `edits.only` is not empty, those that do
/// not match it. Warns of patterns that match nothing in the scene.
void filterTargets(Scene& scene, const SceneEdits& edits);

}  // namespace dollytrack
