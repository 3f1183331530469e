#include "app/cli/export/object_relations.h"

#include "engine/core/log.h"
#include "engine/document/apply_scene_edits.h"
#include "planning/targets/supports.h"

#include <algorithm>

namespace dollytrack::cli {
namespace {

const char* wordFor(const planning::SupportRelation& support) {
    if (support.hangs) return "hangs_on";
    return support.kind == TargetKind::Shelf ? "in" : "on";
}

const char* wordFor(const std::string& relation) {
    if (relation == "hangs_on") return "hangs_on";
    return relation == "in" ? "in" : "on";
}

}  // namespace

std::vector<render::ObjectRelation> relationsOf(const Scene& scene, const RayCaster& rays,
                                                const planning::TargetParams& params) {
    const std::vector<planning::SupportRelation> supports =
        planning::findSupports(scene, rays, params);
    std::vector<render::ObjectRelation> relations;
    for (std::size_t i = 0; i < supports.size(); ++i) {
        if (supports[i].holder == 0) continue;
        relations.push_back({scene.objects[i].id, wordFor(supports[i]), supports[i].holder});
    }
    return relations;
}

void overrideRelations(const Scene& scene, const std::vector<AnnotatedRelation>& said,
                       std::vector<render::ObjectRelation>& relations) {
    std::vector<render::ObjectRelation> stated;
    for (const AnnotatedRelation& one : said) {
        const int object = findObject(scene, {0, one.object});
        const int holder = findObject(scene, {0, one.holder});
        if (object == 0 || holder == 0) {
            log::warn("annotations", "no object, or several, are named \"" +
                                         (object == 0 ? one.object : one.holder) + "\"");
            continue;
        }
        stated.push_back({object, wordFor(one.relation), holder});
    }
    std::erase_if(relations, [&](const render::ObjectRelation& found) {
        return std::ranges::any_of(stated, [&](const render::ObjectRelation& one) {
            return one.object_id == found.object_id;
        });
    });
    relations.insert(relations.end(), stated.begin(), stated.end());
    std::ranges::stable_sort(relations, {}, &render::ObjectRelation::object_id);
}

}  // namespace dollytrack::cli
