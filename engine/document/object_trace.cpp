#include "engine/document/object_trace.h"

#include "engine/document/apply_scene_edits.h"

#include <algorithm>
#include <numeric>

namespace dollytrack {
namespace {

bool isSet(const std::vector<bool>& flags, int id) {
    return static_cast<std::size_t>(id) < flags.size() && flags[id];
}

std::size_t highestNumber(const ObjectTrace& trace) {
    const auto highest = std::max_element(trace.begin(), trace.end());
    return highest == trace.end() ? 0 : static_cast<std::size_t>(*highest);
}

}  // namespace

ObjectTrace traceObjects(const Scene& imported, const std::vector<ObjectDefinition>& definitions) {
    ObjectTrace trace(imported.triangles.size(), 0);
    const auto note = [&](const Scene& scene, const auto& source) {
        for (const Object& object : scene.objects) {
            for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
                trace[source(object.first_triangle + i)] = object.id;
            }
        }
    };
    if (definitions.empty()) {
        note(imported, [](std::uint32_t triangle) { return triangle; });
        return trace;
    }
    // Edits keep the material of each triangle, so triangle numbers are stored as materials to
    // trace them.
    Scene numbered = imported;
    numbered.textures.clear();
    std::iota(numbered.triangle_material.begin(), numbered.triangle_material.end(), 0U);
    SceneEdits edits;
    edits.definitions = definitions;
    const Result<Scene> edited = applySceneEdits(numbered, edits);
    if (!edited) return traceObjects(imported, {});
    note(*edited, [&](std::uint32_t triangle) { return edited->triangle_material[triangle]; });
    return trace;
}

std::vector<int> followObjects(const std::vector<int>& ids, const ObjectTrace& before,
                               const ObjectTrace& after) {
    std::vector<bool> wanted(highestNumber(before) + 1, false);
    for (const int id : ids) {
        if (id > 0 && static_cast<std::size_t>(id) < wanted.size()) {
            wanted[id] = true;
        }
    }
    std::vector<bool> found(highestNumber(after) + 1, false);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
        if (isSet(wanted, before[i])) found[after[i]] = true;
    }
    std::vector<int> followed;
    for (std::size_t id = 1; id < found.size(); ++id) {
        if (found[id]) followed.push_back(static_cast<int>(id));
    }
    return followed;
}

std::vector<bool> followFlags(const std::vector<bool>& flags, const ObjectTrace& before,
                              const ObjectTrace& after) {
    std::vector<bool> followed(highestNumber(after) + 1, false);
    std::vector<bool> without(followed.size(), false);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
        (isSet(flags, before[i]) ? followed : without)[after[i]] = true;
    }
    for (std::size_t id = 0; id < followed.size(); ++id) {
        if (without[id]) followed[id] = false;
    }
    return followed;
}

}  // namespace dollytrack
