#pragma once

#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// For each triangle of the imported scene, the number of the object that it belongs to after
/// objects were merged and split. The definitions of merged and split objects renumber objects but
/// leave triangles alone, so the traces before and after a change show what became of each object.
using ObjectTrace = std::vector<int>;

ObjectTrace traceObjects(const Scene& imported, const std::vector<ObjectDefinition>& definitions);

/// The numbers in `after` of all objects that hold triangles of these objects of `before`, rising.
/// A split object gives several numbers; merged objects give one.
std::vector<int> followObjects(const std::vector<int>& ids, const ObjectTrace& before,
                               const ObjectTrace& after);

/// Carries flags of objects over, indexed by object number: an object of `after` has the flag if
/// all objects of `before` that it consists of had it.
std::vector<bool> followFlags(const std::vector<bool>& flags, const ObjectTrace& before,
                              const ObjectTrace& after);

}  // namespace dollytrack
