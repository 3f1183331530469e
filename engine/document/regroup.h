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

/// The pieces that a split with these limits makes: those that are kept, each with the triangles of
/// the pieces that stay with it. One, where fewer than two would be kept.
std::vector<TriangleList> findPieces(const Scene& scene, const Object& object,
                                     const SplitLimits& limits);

/// Longest sides of the boxes of an object's connected pieces, m, the largest first.
std::vector<double> pieceSizes(const Scene& scene, const Object& object);

/// How many pieces of these sizes, the largest first, a split with these limits keeps.
std::size_t keptPieces(const std::vector<double>& sizes_m, const SplitLimits& limits);

/// Makes one object of several, at the place of the first. `ids` rise and are at least two. With
/// `nyu40` 0 it has the class of the part with the largest box. It is a target, and a part of the
/// building when all its parts are. Ids run 1..n afterwards; what else was measured stays.
void mergeObjects(Scene& scene, const std::vector<int>& ids, const std::string& name, int nyu40);

/// Puts pieces, as findPieces() gives them, in the place of the object; they are what it was and
/// have the names given, one a piece.
void splitObject(Scene& scene, int id, const std::vector<TriangleList>& pieces,
                 const std::vector<std::string>& names);

/// Names for the pieces of an object: `name` with the first numbers that no object of the scene
/// has ("chair_1", "chair_2").
std::vector<std::string> pieceNames(const Scene& scene, const std::string& name, std::size_t count);

}  // namespace dollytrack
