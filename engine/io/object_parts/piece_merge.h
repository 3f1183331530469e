#pragma once

#include "engine/geometry/contact.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// A draft that went into another one.
struct MergedPiece {
    std::string name;       // empty where nobody named it
    std::size_t whole = 0;  // index of the draft that it is in now
};

/// Puts pieces together that one thing was modelled from: pieces whose name says nothing of their
/// own ("Circle.012", "Wood_Mesh031", "handle", pieces of a scene taken apart) with what they are
/// attached to, and the boards of one shelf. What merely stands on something stays apart: a cup
/// on a table, a table on the floor. What the file names as a thing of its own stays one, unless
/// its name says that it is a part, and it touches another, or floats within 3 cm of its surface.
/// Parts are in the world's frame. `structure` tells which drafts are walls, floor and the like;
/// only pieces named as parts join those (a handle its door).
///
/// `by_material` marks drafts that may be one material of an object. Their names are ignored: such
/// a draft joins what it is attached to unless the classes differ, and where nothing holds it, the
/// smallest draft around it. Two drafts of one class join only if one lies inside the other. Two
/// drafts that stand side by side on a third one, as books on a board, are not joined.
std::vector<MergedPiece> mergePieces(const RawScene& raw, const std::vector<bool>& structure,
                                     std::vector<ObjectDraft>& drafts,
                                     const std::vector<bool>& by_material = {});

/// Surfaces that are no farther apart than this, in metres, are modelled as touching.
inline constexpr float kContactGap = 0.003F;

/// The surfaces of a draft's parts, which must outlive them.
std::vector<SurfaceView> surfacesOf(const RawScene& raw, const ObjectDraft& draft);

/// Whether `smaller` has the smaller volume and at least half of it lies inside `larger`.
bool liesInside(const Eigen::AlignedBox3f& smaller, const Eigen::AlignedBox3f& larger);

/// The upper of two things merely stands on the lower one: it touches it with its underside only,
/// is the smaller one in plan, and could stand by itself.
bool standsOn(const Eigen::AlignedBox3f& upper, const Eigen::AlignedBox3f& lower,
              const std::vector<Eigen::Vector3f>& contact);

/// How well a draft's name serves as the name of a whole that it is a part of. `named`: somebody
/// gave it, and not a program.
int nameRank(const ObjectDraft& draft, bool named);

}  // namespace dollytrack
