#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack {

/// The limits below which an object counts as small, as given to the import; see sortBySize().
struct SizeRules {
    double small_volume_m3 = 0.1;
    double size_ratio = 5.0;
};

/// Returns the imported scene with the edits applied. New objects are measured as the import
/// measures objects; ids run 1..n again; each object's triangles and vertices are contiguous. An
/// edit's object is found by its number and name, else by its name alone. If that fails the edit is
/// skipped, with a warning in the scene's report. Error: BadInput if the edited scene would have
/// more objects than 16-bit images can number.
Result<Scene> applySceneEdits(const Scene& imported, const SceneEdits& edits,
                              const SizeRules& rules = {});

/// The number of the object in this scene. 0 if it does not exist or if several objects have its
/// name.
int findObject(const Scene& scene, const ObjectRef& wanted);

/// Returns the plan's edits with the object numbers of this scene. An edit that refers to a missing
/// object is left out, with a warning.
PlanEdits findObjects(const PlanEdits& edits, const Scene& edited,
                      std::vector<std::string>& warnings);

/// Whether both edits give the same triangles in the same objects and places. If so, whatever was
/// computed from the geometry (ray-casting structures, free space) is valid for both.
bool sameGeometry(const SceneEdits& a, const SceneEdits& b);

}  // namespace dollytrack
