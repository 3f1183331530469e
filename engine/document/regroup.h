#pragma once

#include "engine/document/split_limits.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// Triangles of a scene that belong together, as indices into Scene::triangles.
using TriangleList = std::vector<std::uint32_t>;

/// The connected pieces of one object (surfaces that share corners, to 0.1 mm), in the order of
/// their first triangles.
std::vector<TriangleList> findPieces(const Scene& scene, const Object& object);

/// The pieces that a split with these limits makes. The triangles of a piece that is not kept join
/// the nearest kept piece. A single piece if fewer than two would be kept.
std::vector<TriangleList> findPieces(const Scene& scene, const Object& object,
                                     const SplitLimits& limits);

/// The longest side of each connected piece's box, m, the largest first.
std::vector<double> pieceSizes(const Scene& scene, const Object& object);

/// How many pieces a split with these limits keeps. Sizes as from pieceSizes().
std::size_t keptPieces(const std::vector<double>& sizes_m, const SplitLimits& limits);

/// Merges objects into one, at the index of the first. `ids` are at least two and rising. If
/// `nyu40` is 0 the new object gets the class of the part with the largest box. It is a target; it
/// counts as part of the building if all its parts do. Ids run 1..n afterwards; other objects keep
/// their measures.
void mergeObjects(Scene& scene, const std::vector<int>& ids, const std::string& name, int nyu40);

/// Replaces the object by pieces from findPieces(), with one name for each. The pieces inherit the
/// object's class and role, except that pieces of walls, floors and other structure that have the
/// size and the shape of furniture become targets of unknown class.
void splitObject(Scene& scene, int id, const std::vector<TriangleList>& pieces,
                 const std::vector<std::string>& names);

/// Names for the pieces of an object: `name` with the lowest numbers that are free in the scene
/// ("chair_1", "chair_2").
std::vector<std::string> pieceNames(const Scene& scene, const std::string& name, std::size_t count);

}  // namespace dollytrack
