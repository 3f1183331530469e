#include "engine/document/apply_scene_edits.h"

#include "engine/document/regroup.h"
#include "engine/document/target_filter.h"
#include "engine/scene/class_table.h"
#include "engine/scene/front_directions.h"
#include "engine/scene/move_object.h"
#include "engine/scene/object_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dollytrack {
namespace {

// Instance images have 16-bit ids.
constexpr std::size_t kMostObjects = 65'535;

/// Sorted numbers of the wanted objects; empty, with a warning, if one of them is not found.
std::vector<int> findAll(const Scene& scene, const std::vector<ObjectRef>& wanted,
                         const std::string& what, std::vector<std::string>& warnings) {
    std::vector<int> ids;
    for (const ObjectRef& ref : wanted) {
        const int id = findObject(scene, ref);
        if (id == 0) {
            warnings.push_back(
                fmt::format("{} was left out: the scene has no object \"{}\" any more, or several "
                            "with this name",
                            what, ref.name));
            return {};
        }
        ids.push_back(id);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

void define(Scene& scene, const ObjectDefinition& definition) {
    const bool merges = definition.kind == ObjectDefinition::Kind::Merge;
    const std::string what =
        fmt::format("{} \"{}\"", merges ? "the new object" : "the split of", definition.name);
    std::vector<std::string>& warnings = scene.report.warnings;
    const std::vector<int> ids = findAll(scene, definition.objects, what, warnings);
    if (ids.empty()) return;
    if (merges) {
        if (ids.size() > 1) mergeObjects(scene, ids, definition.name, definition.nyu40);
        return;
    }
    const std::vector<TriangleList> pieces =
        findPieces(scene, scene.object(ids.front()), definition.limits);
    if (pieces.size() < 2) {
        warnings.push_back(what + " was left out: it is one connected piece now");
        return;
    }
    splitObject(scene, ids.front(), pieces, pieceNames(scene, definition.name, pieces.size()));
}

void change(Scene& scene, const ObjectChange& wanted) {
    const std::vector<int> ids =
        findAll(scene, {wanted.object}, fmt::format("the change of \"{}\"", wanted.object.name),
                scene.report.warnings);
    if (ids.empty()) return;
    Object& object = scene.objects[ids.front() - 1];
    if (wanted.role) object.role = *wanted.role;
    if (wanted.nyu40) object.nyu40 = *wanted.nyu40;
    if (wanted.front) {
        object.front = *wanted.front;
        object.front_source = FrontSource::Annotation;
    }
    if (wanted.large) {
        object.large = *wanted.large;
        object.size_given = true;
    }
    // Applied last, so that a manually set front turns with its object. Moving does not change
    // sizes or automatically found fronts.
    if (wanted.move) moveObject(scene, object.id, wanted.move->offset_m, wanted.move->turn_rad);
}

/// Updates the object numbers of an edit. Returns false if an object no longer exists.
bool update(std::vector<ObjectRef>& objects, const Scene& scene, const std::string& what,
            std::vector<std::string>& warnings) {
    if (objects.empty()) return true;
    const std::vector<int> ids = findAll(scene, objects, what, warnings);
    if (ids.empty()) return false;
    objects.clear();
    for (const int id : ids) objects.push_back({id, scene.object(id).name});
    return true;
}

}  // namespace

int findObject(const Scene& scene, const ObjectRef& wanted) {
    const auto count = static_cast<int>(scene.objects.size());
    if (wanted.id >= 1 && wanted.id <= count && scene.object(wanted.id).name == wanted.name) {
        return wanted.id;
    }
    int found = 0;
    for (const Object& object : scene.objects) {
        if (object.name != wanted.name) continue;
        if (found != 0) return 0;
        found = object.id;
    }
    return found;
}

Result<Scene> applySceneEdits(const Scene& imported, const SceneEdits& edits,
                              const SizeRules& rules) {
    Scene scene = imported;
    for (const ObjectDefinition& definition : edits.definitions) define(scene, definition);
    assignDatasetClasses(scene);  // target lists may contain dataset classes
    if (scene.objects.size() > kMostObjects) {
        return fail(ErrorCode::BadInput,
                    fmt::format("After the split the scene has {} objects, but instance images can "
                                "number {} at most; split fewer objects.",
                                scene.objects.size(), kMostObjects),
                    imported.name);
    }
    if (!edits.definitions.empty()) {
        findFronts(scene);
        sortBySize(scene.objects, rules.small_volume_m3, rules.size_ratio);
    }
    filterTargets(scene, edits);
    for (const ObjectChange& wanted : edits.changes) change(scene, wanted);
    assignDatasetClasses(scene);
    return scene;
}

PlanEdits findObjects(const PlanEdits& edits, const Scene& edited,
                      std::vector<std::string>& warnings) {
    PlanEdits found = edits;
    for (PinnedPoint& pin : found.pinned) {
        // The pose is kept even without its objects; it is then for the objects that it captures.
        const std::string what = fmt::format("the object list of \"{}\"", pin.name);
        if (!update(pin.objects, edited, what, warnings)) pin.objects.clear();
    }
    std::erase_if(found.removed, [&](RemovedPoint& removed) {
        return !update(removed.objects, edited, "a removed point", warnings);
    });
    return found;
}

bool sameGeometry(const SceneEdits& a, const SceneEdits& b) {
    const auto moves = [](const SceneEdits& edits) {
        std::vector<std::pair<ObjectRef, ObjectMove>> list;
        for (const ObjectChange& change : edits.changes) {
            if (change.move) list.emplace_back(change.object, *change.move);
        }
        return list;
    };
    return a.definitions == b.definitions && moves(a) == moves(b);
}

}  // namespace dollytrack
