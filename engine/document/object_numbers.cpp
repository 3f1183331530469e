#include "engine/document/object_numbers.h"

#include "engine/document/apply_scene_edits.h"

#include <algorithm>

namespace dollytrack {
namespace {

/// Sorts a list by object number and removes duplicates.
template <class T, class IdOf>
void sortById(std::vector<T>& list, IdOf&& idOf) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const T& a, const T& b) { return idOf(a) < idOf(b); });
    const auto same = [&](const T& a, const T& b) { return idOf(a) == idOf(b); };
    list.erase(std::unique(list.begin(), list.end(), same), list.end());
}

bool number(ObjectRef& ref, const Scene& scene, std::vector<std::string>& warnings) {
    if (ref.id > 0) return true;
    ref.id = findObject(scene, ref);
    if (ref.id == 0)
        warnings.push_back("there is not exactly one object named \"" + ref.name + "\"");
    return ref.id > 0;
}

void numberAll(std::vector<ObjectRef>& refs, const Scene& scene,
               std::vector<std::string>& warnings) {
    std::erase_if(refs, [&](ObjectRef& ref) { return !number(ref, scene, warnings); });
    sortById(refs, [](const ObjectRef& ref) { return ref.id; });
}

}  // namespace

Result<Edits> numberObjects(Edits edits, const Scene& imported,
                            std::vector<std::string>& warnings) {
    SceneEdits before;  // each definition refers to the scene after the previous ones
    Result<Scene> scene = imported;
    for (ObjectDefinition& definition : edits.scene.definitions) {
        numberAll(definition.objects, *scene, warnings);
        const bool merges = definition.kind == ObjectDefinition::Kind::Merge;
        if (definition.objects.size() < (merges ? 2U : 1U)) continue;
        before.definitions.push_back(definition);
        scene = applySceneEdits(imported, before);
        if (!scene) return tl::unexpected(std::move(scene.error()));
    }
    edits.scene.definitions = std::move(before.definitions);
    std::erase_if(edits.scene.changes,
                  [&](ObjectChange& change) { return !number(change.object, *scene, warnings); });
    sortById(edits.scene.changes, [](const ObjectChange& change) { return change.object.id; });
    for (PinnedPoint& pin : edits.plan.pinned) numberAll(pin.objects, *scene, warnings);
    for (RemovedPoint& removed : edits.plan.removed) {
        numberAll(removed.objects, *scene, warnings);
    }
    std::erase_if(edits.plan.removed,
                  [](const RemovedPoint& removed) { return removed.objects.empty(); });
    return edits;
}

}  // namespace dollytrack
