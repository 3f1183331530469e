#pragma once

#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// For each triangle of an imported scene the number of the object that has it, once objects are
/// merged and split. Numbers are dealt out anew with every definition; triangles stay what they
/// are, so two traces of one scene say what became of an object.
using ObjectTrace = std::vector<int>;

ObjectTrace traceObjects(const Scene& imported, const std::vector<ObjectDefinition>& definitions);

/// The numbers in `after` of everything that these objects of `before` are made of, by rising
/// number: one for each, more where an object was split, fewer where several were merged.
std::vector<int> followObjects(const std::vector<int>& ids, const ObjectTrace& before,
                               const ObjectTrace& after);

/// A flag for each object by number, as it is after: set where every part of it had it set.
std::vector<bool> followFlags(const std::vector<bool>& flags, const ObjectTrace& before,
                              const ObjectTrace& after);

}  // namespace dollytrack
