#include "engine/io/orientation/frame_evidence.h"

#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"
#include "engine/scene/room_bounds.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace dollytrack {
namespace {

constexpr double kSupportGap = 0.004;        // of the longest side: largest gap of touching objects
constexpr double kAcross = 0.985;            // cosine of 10 degrees
constexpr std::size_t kEnoughFaces = 20000;  // per mesh; larger meshes are sampled evenly

/// Vertices and triangles of a mesh part or an object.
struct Faces {
    const std::vector<Eigen::Vector3f>* positions;
    std::span<const Triangle> triangles;
};

struct Source {
    MeasuredObject object;  // class and kind; other members are measured
    std::vector<Faces> meshes;
    std::size_t object_in_scene = 0;  // its index there
};

/// Whether a material emits light uniformly, without an emission map.
bool shines(const std::vector<Material>& materials, std::uint32_t index) {
    return index < materials.size() && materials[index].emission.maxCoeff() > 0.0F &&
           materials[index].emission_map < 0;
}

/// Calls `visit(a, b, c, share)` for a sample of the faces; each stands for `share` faces.
template <class Visit>
void visitFaces(const Faces& mesh, Visit&& visit) {
    const std::size_t stride = mesh.triangles.size() / kEnoughFaces + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += stride) {
        const auto corner = [&](std::size_t k) {
            return Eigen::Vector3d((*mesh.positions)[mesh.triangles[i][k]].cast<double>());
        };
        visit(corner(0), corner(1), corner(2), static_cast<double>(stride));
    }
}

MeasuredObject measureSource(const Source& source) {
    MeasuredObject object = source.object;
    for (const Faces& mesh : source.meshes) {
        for (const Triangle& triangle : mesh.triangles) {
            for (const std::uint32_t v : triangle) {
                object.box.extend((*mesh.positions)[v].cast<double>());
            }
        }
        visitFaces(mesh, [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c, double share) {
            const Eigen::Vector3d across = (b - a).cross(c - a);
            const double area = 0.5 * across.norm() * share;
            object.area += area;
            object.centroid += area / 3.0 * (a + b + c);
            Eigen::Index axis = 0;
            if (across.cwiseAbs().maxCoeff(&axis) > kAcross * across.norm()) {
                object.facing[axis] += area;
            }
        });
    }
    if (object.area > 0.0) object.centroid /= object.area;
    return object;
}

/// Whether an object is all walls of the room in one mesh.
bool isShell(const MeasuredObject& object, const Eigen::AlignedBox3d& core) {
    constexpr double kLeastCover = 0.6;
    return object.nyu40 == kNyuWall &&
           (object.box.sizes().array() > kLeastCover * core.sizes().array()).all();
}

/// Extends the core to floors, walls and ceilings that the outlier cut removed: thin objects about
/// as wide as the core, and all walls in one mesh, within twice its extent.
void includeRoomSides(const std::vector<MeasuredObject>& objects, Eigen::AlignedBox3d& core) {
    constexpr double kNear = 2.0;  // times the extent of the core
    const Eigen::AlignedBox3d left = core;
    for (const MeasuredObject& object : objects) {
        for (int axis = 0; axis < 3; ++axis) {
            const double reach = kNear * left.sizes()[axis];
            if (!(isRoomSide(object, left, axis) || isShell(object, left)) ||
                object.box.min()[axis] < left.min()[axis] - reach ||
                object.box.max()[axis] > left.max()[axis] + reach) {
                continue;
            }
            core.min()[axis] = std::min(core.min()[axis], object.box.min()[axis]);
            core.max()[axis] = std::max(core.max()[axis], object.box.max()[axis]);
        }
    }
}

Eigen::AlignedBox3d coreOfObjects(const std::vector<MeasuredObject>& objects) {
    Eigen::AlignedBox3d core;
    if (objects.size() < 8) {
        for (const MeasuredObject& object : objects) core.extend(object.box);
        return core;
    }
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> lows;
        std::vector<double> highs;
        for (const MeasuredObject& object : objects) {
            lows.push_back(object.box.min()[axis]);
            highs.push_back(object.box.max()[axis]);
        }
        std::sort(lows.begin(), lows.end());
        std::sort(highs.begin(), highs.end());
        const std::size_t cut = std::max<std::size_t>(1, objects.size() / 20);
        core.min()[axis] = lows[cut];
        core.max()[axis] = highs[highs.size() - 1 - cut];
    }
    includeRoomSides(objects, core);
    return core;
}

void addLevels(const Source& source, const Eigen::AlignedBox3d& core,
               std::array<LevelAreas, 3>& levels) {
    const bool floor = source.object.nyu40 == kNyuFloor || source.object.nyu40 == kNyuCeiling;
    for (const Faces& mesh : source.meshes) {
        visitFaces(mesh, [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c, double share) {
            const Eigen::Vector3d across = (b - a).cross(c - a);
            Eigen::Index axis = 0;
            const double along = across.cwiseAbs().maxCoeff(&axis);
            if (!(along > kAcross * across.norm())) return;
            const double height = (a[axis] + b[axis] + c[axis]) / 3.0 - core.min()[axis];
            const double step = LevelAreas::kSteps * height / std::max(core.sizes()[axis], 1e-12);
            // A surface on the boundary of the core belongs to it; surfaces outside may be
            // outliers.
            if (step < -0.5 || step > LevelAreas::kSteps + 0.5) return;
            const auto at =
                static_cast<std::size_t>(std::clamp(step, 0.0, LevelAreas::kSteps - 1.0));
            LevelAreas& level = levels[axis];
            const double area = 0.5 * along * share;
            level.all[at] += area;
            if (!source.object.building || source.object.by_shape) level.furniture[at] += area;
            if (floor) level.floors[at] += area;
        });
    }
}

/// Some exporters set an emission colour on every material. If most objects emit light, emission is
/// ignored.
void dropCommonShine(std::vector<Source>& sources) {
    const auto shining =
        std::ranges::count_if(sources, [](const Source& source) { return source.object.shines; });
    if (2 * shining <= static_cast<std::ptrdiff_t>(sources.size())) return;
    for (Source& source : sources) source.object.shines = false;
}

/// `scene` contains the object of each source.
FrameEvidence collect(std::vector<Source> sources, const Scene& scene) {
    dropCommonShine(sources);
    std::vector<MeasuredObject> measured(sources.size());
    parallelFor(sources.size(), [&](std::size_t i) { measured[i] = measureSource(sources[i]); });
    FrameEvidence evidence;
    std::vector<std::size_t> object_of;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (measured[i].box.isEmpty()) continue;
        evidence.objects.push_back(std::move(measured[i]));
        object_of.push_back(sources[i].object_in_scene);
    }
    evidence.core = coreOfObjects(evidence.objects);
    if (evidence.core.isEmpty()) return evidence;
    for (const Source& source : sources) addLevels(source, evidence.core, evidence.levels);
    const std::vector<SideSupport> support =
        measureSupport(scene, kSupportGap * evidence.core.sizes().maxCoeff());
    for (std::size_t i = 0; i < object_of.size(); ++i) {
        evidence.objects[i].support = support[object_of[i]];
    }
    return evidence;
}

/// Whether an object says something about the rooms: grounds, skies and what stands outside do not.
bool describesRoom(const Object& object, const Eigen::AlignedBox3d& room) {
    constexpr double kMargin_m = 0.05;
    constexpr double kWidest = 1.5;  // times the room
    if (room.isEmpty()) return true;
    const Eigen::AlignedBox3d box = worldBounds(object.box);
    const Eigen::Array3d widest = kWidest * room.sizes().array() + kMargin_m;
    return room.exteriorDistance(object.box.center) <= kMargin_m &&
           (box.sizes().array() <= widest).all();
}

/// A scene with one object per draft.
Scene sceneOfDrafts(const RawScene& raw, const std::vector<ObjectDraft>& drafts) {
    Scene scene;
    for (const ObjectDraft& draft : drafts) {
        Object& object = scene.objects.emplace_back();
        object.id = static_cast<int>(scene.objects.size());
        object.first_vertex = static_cast<std::uint32_t>(scene.positions.size());
        object.first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
        for (const std::size_t index : draft.parts) {
            const MeshPart& part = raw.parts[index];
            const auto first = static_cast<std::uint32_t>(scene.positions.size());
            scene.positions.insert(scene.positions.end(), part.positions.begin(),
                                   part.positions.end());
            for (const Triangle& t : part.triangles) {
                scene.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
            }
        }
        object.vertex_count =
            static_cast<std::uint32_t>(scene.positions.size()) - object.first_vertex;
        object.triangle_count =
            static_cast<std::uint32_t>(scene.triangles.size()) - object.first_triangle;
    }
    return scene;
}

}  // namespace

bool isRoomSide(const MeasuredObject& object, const Eigen::AlignedBox3d& core, int axis) {
    constexpr double kLeastCover = 0.6;
    constexpr double kMostCover = 1.3;
    const Eigen::Array3d cover = object.box.sizes().array() / core.sizes().array().max(1e-12);
    const double a = cover[(axis + 1) % 3];
    const double b = cover[(axis + 2) % 3];
    return cover[axis] < kLeastCover && std::min(a, b) > kLeastCover && std::max(a, b) < kMostCover;
}

FrameEvidence collectEvidence(const RawScene& raw, const std::vector<ObjectDraft>& drafts) {
    std::vector<Source> sources;
    for (const ObjectDraft& draft : drafts) {
        Source& source = sources.emplace_back();
        source.object_in_scene = sources.size() - 1;
        source.object.nyu40 = draft.label.nyu40;
        source.object.building = draft.label.kind == LabelKind::Structure;
        source.object.shines = !draft.parts.empty();
        for (const std::size_t index : draft.parts) {
            const MeshPart& part = raw.parts[index];
            source.meshes.push_back({&part.positions, part.triangles});
            source.object.shines &= shines(raw.materials, part.material);
        }
    }
    return collect(std::move(sources), sceneOfDrafts(raw, drafts));
}

FrameEvidence collectEvidence(const Scene& scene, bool classes_by_shape) {
    std::vector<Source> sources;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!describesRoom(object, scene.room_bounds)) continue;
        Source& source = sources.emplace_back();
        source.object_in_scene = i;
        source.object.nyu40 = object.nyu40;
        source.object.building = object.structure;
        source.object.by_shape = classes_by_shape && object.structure;
        source.object.shines = object.triangle_count > 0;
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            const std::uint32_t material = scene.triangle_material[object.first_triangle + t];
            if (shines(scene.materials, material)) continue;
            source.object.shines = false;
            break;
        }
        source.meshes.push_back(
            {&scene.positions,
             std::span(scene.triangles).subspan(object.first_triangle, object.triangle_count)});
    }
    return collect(std::move(sources), scene);
}

}  // namespace dollytrack
