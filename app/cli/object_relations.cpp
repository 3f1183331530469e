#include "app/cli/object_relations.h"

#include "planning/targets/carriers.h"

namespace dollytrack::cli {
namespace {

const char* wordFor(TargetKind kind) {
    switch (kind) {
        case TargetKind::Support:
            return "on";
        case TargetKind::Shelf:
            return "in";
        case TargetKind::Suspension:
            return "hangs_on";
        case TargetKind::Single:
            break;
    }
    return "";
}

}  // namespace

std::vector<render::ObjectRelation> relationsOf(const Scene& scene, const RayCaster& rays,
                                                const planning::TargetParams& params) {
    const std::vector<planning::Carriage> carriages = planning::findCarriers(scene, rays, params);
    std::vector<render::ObjectRelation> relations;
    for (std::size_t i = 0; i < carriages.size(); ++i) {
        if (carriages[i].carrier == 0) continue;
        relations.push_back(
            {scene.objects[i].id, wordFor(carriages[i].kind), carriages[i].carrier});
    }
    return relations;
}

}  // namespace dollytrack::cli
