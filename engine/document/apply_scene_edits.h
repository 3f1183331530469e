#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack {

/// When an object counts as small, as import was told.
struct SizeRules {
    double small_volume_m3 = 0.1;
    double size_ratio = 5.0;
};

/// The imported scene with the edits applied: new objects measured as import measures them, ids
/// 1..n again, triangles and vertices of each object contiguous. An edit whose object is not found
/// by number and name, nor by its name alone, is left out with a warning in the scene's report.
/// Error: BadInput when the edited scene would have more objects than images can number.
Result<Scene> applySceneEdits(const Scene& imported, const SceneEdits& edits,
                              const SizeRules& rules = {});

/// The number that the object has in this scene; 0 when it is gone, or when several have its name.
int findObject(const Scene& scene, const ObjectRef& wanted);

/// The plan's edits with the numbers that their objects have in this scene. What refers to an
/// object that is gone is left out, and said in `warnings`.
PlanEdits findObjects(const PlanEdits& edits, const Scene& edited,
                      std::vector<std::string>& warnings);

/// Whether the two give scenes of the same triangles in the same objects and places: then what was
/// made of the geometry (ray structures, free space) holds for both.
bool sameGeometry(const SceneEdits& a, const SceneEdits& b);

}  // namespace dollytrack
