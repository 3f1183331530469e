#include "engine/io/import/structure_finder.h"

#include "engine/geometry/oriented_box.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"
#include "engine/scene/room_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack {
namespace {

/// Surface area of a draft by direction, and its position among the other objects.
struct Shape {
    OrientedBox box;
    Eigen::AlignedBox3d bounds;
    std::size_t triangles = 0;
    double area = 0.0;
    double level_area = 0.0;     // faces up or down
    double upright_area = 0.0;   // faces sideways
    double sloped_area = 0.0;    // faces neither up, down nor sideways
    double largest_plane = 0.0;  // upright area that faces along the box's thin side
    double above = 0.0;          // share of all objects whose centre is above its bottom
    double inside = 0.0;         // share of all objects whose centre is inside its bounds
    bool held = false;           // lies in another object of a similar footprint, as in a bed frame
};

Shape measureShape(const RawScene& raw, const ObjectDraft& draft) {
    Shape shape;
    shape.bounds = boundsOf(raw, draft).cast<double>();
    std::vector<Eigen::Vector3f> points;
    for (const std::size_t part : draft.parts) {
        const auto& more = raw.parts[part].positions;
        points.insert(points.end(), more.begin(), more.end());
    }
    shape.box = fitUprightBox(points);
    const double turn = shape.box.half_size.x() < shape.box.half_size.y()
                            ? shape.box.yaw
                            : shape.box.yaw + 0.5 * std::numbers::pi;
    const Eigen::Vector3d thin(std::cos(turn), std::sin(turn), 0.0);
    for (const std::size_t index : draft.parts) {
        const MeshPart& part = raw.parts[index];
        shape.triangles += part.triangles.size();
        for (const Triangle& t : part.triangles) {
            const Eigen::Vector3d a = part.positions[t[0]].cast<double>();
            const Eigen::Vector3d normal = (part.positions[t[1]].cast<double>() - a)
                                               .cross(part.positions[t[2]].cast<double>() - a);
            const double length = normal.norm();
            shape.area += 0.5 * length;
            if (std::abs(normal.z()) > 0.97 * length) shape.level_area += 0.5 * length;
            if (std::abs(normal.z()) < 0.2 * length) {
                shape.upright_area += 0.5 * length;
            } else if (std::abs(normal.z()) < 0.97 * length) {
                shape.sloped_area += 0.5 * length;
            }
            if (std::abs(normal.dot(thin)) > 0.97 * length) shape.largest_plane += 0.5 * length;
        }
    }
    return shape;
}

struct Verdict {
    bool is_structure = false;
    int nyu40 = 0;
};

/// Whether a shape is a side of a roof: large, sloped, and above nearly all other objects.
bool isRoof(const Shape& shape, const Eigen::AlignedBox3d& building) {
    const Eigen::Vector3d size = shape.bounds.sizes();
    return size.x() * size.y() > 2.0 && std::max(size.x(), size.y()) > 2.0 &&
           shape.sloped_area > 0.6 * shape.area && shape.above < 0.1 &&
           shape.bounds.min().z() - building.min().z() > 1.8;
}

/// Share of the objects whose centre is above the shape's bottom, without large objects at the same
/// height, which are other sides of the same roof.
double shareAbove(const Shape& shape, const std::vector<Object>& boxes) {
    double above = 0.0;
    for (const Object& other : boxes) {
        const double middle = other.box.center.z();
        const bool is_beside = other.box.half_size.head<2>().prod() > 0.5 &&
                               middle - other.box.half_size.z() > shape.bounds.min().z() - 0.3;
        above += !is_beside && middle > shape.bounds.min().z();
    }
    return above / static_cast<double>(boxes.size());
}

/// Whether a floor is a roof or ceiling instead: it lies at the top of the building, and nothing is
/// above it.
bool isTopmost(const Object& floor, const std::vector<Object>& boxes,
               const Eigen::AlignedBox3d& building) {
    constexpr double kLeastStorey_m = 1.8;
    constexpr double kSlab_m = 0.3;
    const auto topOf = [](const Object& object) {
        return object.box.center.z() + object.box.half_size.z();
    };
    return floor.box.half_size.z() < 0.5 * kSlab_m &&
           topOf(floor) - building.min().z() > kLeastStorey_m &&
           std::ranges::none_of(
               boxes, [&](const Object& other) { return topOf(other) > topOf(floor) + kSlab_m; });
}

/// Whether a large thin sheet is a floor above the lowest point of the building, because walls or
/// other rooms reach farther down. It is recognized by the objects that stand on it.
bool isFloorSheet(const Shape& shape) {
    constexpr double kThickest_m = 0.1;
    constexpr double kLeastWidth_m = 2.0;
    constexpr double kLeastLength_m = 3.0;
    constexpr double kMostAbove = 0.75;  // of all objects
    const Eigen::Vector3d size = shape.bounds.sizes();
    return size.z() < kThickest_m && std::min(size.x(), size.y()) > kLeastWidth_m &&
           std::max(size.x(), size.y()) > kLeastLength_m && shape.above > kMostAbove && !shape.held;
}

Verdict judge(const Shape& shape, const Eigen::AlignedBox3d& room) {
    const Eigen::Vector3d size = shape.bounds.sizes();
    const Eigen::Vector3d room_size = room.sizes();
    const double covers_x = size.x() / std::max(1e-9, room_size.x());
    const double covers_y = size.y() / std::max(1e-9, room_size.y());
    const double low = shape.bounds.min().z() - room.min().z();
    const double high = room.max().z() - shape.bounds.max().z();
    // The floor slab of a room whose unit is too large is thicker than 0.4 m, but lower than a
    // room.
    const double thickest = std::clamp(0.1 * std::min(size.x(), size.y()), 0.4, 1.5);
    const bool flat = size.z() < thickest && shape.level_area > 0.4 * shape.area;

    if (covers_x > 1.3 && covers_y > 1.3) {
        return {true, flat && low < 0.5 ? int{kNyuFloor} : int{kNyuOtherStructure}};
    }
    const double share = shape.box.half_size.x() * shape.box.half_size.y() * 4.0 /
                         std::max(1e-9, room_size.x() * room_size.y());
    // A step or platform: thicker than a rug, and larger than low table tops. Its level faces cover
    // most of its footprint; those of separate cushions in one mesh do not.
    const bool covers_it = shape.level_area > 0.6 * 4.0 * shape.box.half_size.head<2>().prod();
    const bool platform =
        flat && size.z() > 0.06 && low < 0.6 && share > 0.12 && covers_it && !shape.held;
    if (platform && shape.bounds.min().z() < room.min().z() + 0.45) return {true, kNyuFloor};
    if (flat && covers_it && share > 0.3 && isFloorSheet(shape)) return {true, kNyuFloor};
    if (flat && share > 0.3) {
        if (high < 0.3 * room_size.z() && low > 1.8) return {true, kNyuCeiling};
        if (low < 0.3) return {true, kNyuFloor};
    }
    // A shell encloses the room: its walls and often floor and ceiling in one mesh.
    if (covers_x > 0.6 && covers_y > 0.6 && size.z() > 1.5 && shape.inside > 0.7) {
        return {true, kNyuWall};
    }
    if (covers_x > 0.85 && covers_y > 0.85 && size.z() > 0.6 * room_size.z()) {
        return {true, kNyuWall};
    }
    // A frame around the room: skirting, cornice, rails.
    if (covers_x > 0.85 && covers_y > 0.85 && (low < 0.3 || high < 0.5)) {
        return {true, kNyuOtherStructure};
    }
    // Beams, cornices, skirting boards: bars along most of the room.
    const double across = std::max(size.z(), std::min(size.x(), size.y()));
    const double along = std::max(size.x(), size.y());
    if (across < 0.4 && along > 3.0 && std::max(covers_x, covers_y) > 0.7) {
        return {true, kNyuOtherStructure};
    }
    const double thickness = 2.0 * std::min(shape.box.half_size.x(), shape.box.half_size.y());
    const double length = 2.0 * std::max(shape.box.half_size.x(), shape.box.half_size.y());
    const bool tall = size.z() > 0.75 * room_size.z() && size.z() > 1.8 && low < 0.3;
    if (tall && thickness < 0.35 && length > 0.8 && shape.largest_plane > 0.6 * shape.area) {
        return {true, kNyuWall};
    }
    // Columns and narrow strips of wall beside doors, from floor to ceiling.
    if (tall && high < 0.1 && shape.upright_area > 0.7 * shape.area && shape.triangles <= 64) {
        return {true, kNyuWall};
    }
    return {};
}

/// Whether an object stands around and below this one, as a bed does around its mattress.
bool isHeld(const Eigen::AlignedBox3d& one, const std::vector<Object>& boxes) {
    constexpr double kStep = 0.1;
    constexpr double kLowBack = 1.2;  // higher ones are walls around a raised floor
    const double footprint = one.sizes().head<2>().prod();
    return std::ranges::any_of(boxes, [&](const Object& other) {
        const Eigen::Vector3d& half = other.box.half_size;
        const Eigen::Array2d apart =
            (one.center() - other.box.center).head<2>().array().abs() - half.head<2>().array();
        const bool around = (apart + 0.45 * one.sizes().head<2>().array() < 0.0).all();
        return around && 4.0 * half.head<2>().prod() < 2.0 * footprint &&
               other.box.center.z() - half.z() < one.min().z() - kStep &&
               other.box.center.z() + half.z() > one.min().z() &&
               other.box.center.z() + half.z() < one.max().z() + kLowBack && !other.structure;
    });
}

/// Marks wall cladding: thin upright sheets with a wall's material, or longer than pictures are.
void addCladding(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                 const std::vector<Shape>& shapes, std::vector<Verdict>& verdicts) {
    std::set<std::uint32_t> wall_materials;
    const auto isSheet = [&](std::size_t i) {
        const Eigen::Vector3d& half = shapes[i].box.half_size;
        return shapes[i].area > 0.3 && 2.0 * half.head<2>().minCoeff() < 0.06 &&
               shapes[i].largest_plane > 0.6 * shapes[i].area;
    };
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const bool named = drafts[i].label.kind == LabelKind::Structure;
        if ((named ? drafts[i].label.nyu40 : verdicts[i].nyu40) != kNyuWall) continue;
        for (const std::size_t part : drafts[i].parts) {
            wall_materials.insert(raw.parts[part].material);
        }
    }
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (verdicts[i].is_structure || !isSheet(i)) continue;
        const Eigen::Vector3d& half = shapes[i].box.half_size;
        const bool long_sheet = 2.0 * half.head<2>().maxCoeff() > 2.0 && half.z() > 0.3;
        const bool same_material = std::any_of(
            drafts[i].parts.begin(), drafts[i].parts.end(),
            [&](std::size_t part) { return wall_materials.contains(raw.parts[part].material); });
        if (!drafts[i].loose && (same_material || long_sheet)) verdicts[i] = {true, kNyuWall};
    }
}

}  // namespace

std::vector<bool> findStructure(const RawScene& raw, std::vector<ObjectDraft>& drafts) {
    std::vector<Object> boxes(drafts.size());
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const Eigen::AlignedBox3d bounds = boundsOf(raw, drafts[i]).cast<double>();
        boxes[i].box.center = bounds.center();
        boxes[i].box.half_size = 0.5 * bounds.sizes();
        // The names of pieces are those of their materials.
        if (!drafts[i].loose) boxes[i].name = drafts[i].name;
        boxes[i].nyu40 = drafts[i].label.nyu40;
        boxes[i].structure = drafts[i].label.kind == LabelKind::Structure;
    }
    Eigen::AlignedBox3d room = findRoomBounds(boxes);

    std::vector<Shape> shapes(drafts.size());
    std::vector<Verdict> verdicts(drafts.size());
    std::vector<char> by_shape(drafts.size(), 0);
    parallelFor(drafts.size(), [&](std::size_t i) {
        const Label& label = drafts[i].label;
        // "House_12" is structure by its name; the shape decides between wall and floor. A backdrop
        // may have the shape of walls.
        const bool vague = label.kind == LabelKind::Structure &&
                           label.nyu40 == kNyuOtherStructure && !isBackdrop(boxes[i]);
        // Pieces of a split mesh are named after their material, so their shape is used as well.
        const bool by_name = label.kind == LabelKind::Target || label.kind == LabelKind::Structure;
        if (by_name && !vague && !drafts[i].loose) return;
        Shape& shape = shapes[i];
        shape = measureShape(raw, drafts[i]);
        double inside = 0.0;
        for (const Object& other : boxes) inside += shape.bounds.contains(other.box.center);
        shape.above = shareAbove(shape, boxes);
        shape.held = isHeld(shape.bounds, boxes);
        shape.inside = boxes.size() < 6 ? 0.0 : inside / static_cast<double>(boxes.size());
        by_shape[i] = 1;
    });
    // Roofs are ceilings, so that cut-away views remove them. The room's height is measured without
    // them.
    std::vector<Object> below;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (by_shape[i] != 0 && isRoof(shapes[i], room)) {
            verdicts[i] = {true, kNyuCeiling};
        } else {
            below.push_back(boxes[i]);
        }
    }
    if (below.size() < boxes.size() && !below.empty()) room = findRoomBounds(below);
    parallelFor(drafts.size(), [&](std::size_t i) {
        if (by_shape[i] != 0 && !verdicts[i].is_structure) verdicts[i] = judge(shapes[i], room);
    });
    addCladding(raw, drafts, shapes, verdicts);
    std::vector<bool> structure(drafts.size());
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        Label& label = drafts[i].label;
        if (verdicts[i].is_structure) label = {LabelKind::Structure, verdicts[i].nyu40, "(shape)"};
        if (label.kind == LabelKind::Structure && label.nyu40 == kNyuFloor &&
            isTopmost(boxes[i], boxes, room)) {
            label = {LabelKind::Structure, kNyuCeiling, "(shape)"};
        }
        structure[i] = label.kind == LabelKind::Structure;
    }
    return structure;
}

void findUnnamedStructure(const RawScene& raw, std::vector<ObjectDraft>& drafts) {
    constexpr std::size_t kFewestObjects = 6;
    constexpr double kLeastWidth_m = 2.5;
    constexpr double kLeastHeight_m = 1.8;
    Eigen::AlignedBox3d bounds;
    for (const ObjectDraft& draft : drafts) bounds.extend(boundsOf(raw, draft).cast<double>());
    if (drafts.size() < kFewestObjects || bounds.sizes().z() < kLeastHeight_m ||
        bounds.sizes().head<2>().minCoeff() < kLeastWidth_m) {
        return;
    }
    std::vector<ObjectDraft> judged = drafts;
    for (ObjectDraft& draft : judged) {
        // Objects of such a source are targets, even if no word of their name is known.
        if (draft.label.pattern.empty() && draft.label.nyu40 == 0) draft.label = {};
    }
    const bool names_structure = std::ranges::any_of(
        drafts, [](const ObjectDraft& draft) { return draft.label.kind == LabelKind::Structure; });
    const std::vector<bool> structure = findStructure(raw, judged);
    // Without any other object, shapes alone are too weak: they may be those of furniture.
    const bool has_others = std::ranges::find(structure, false) != structure.end();
    if (has_others || names_structure) drafts = std::move(judged);
}

}  // namespace dollytrack
