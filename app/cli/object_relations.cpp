#include "app/cli/object_relations.h"

#include "planning/targets/carriers.h"

namespace dollytrack::cli {
namespace {

const char* wordFor(const planning::Carriage& carriage) {
    if (carriage.hangs) return "hangs_on";
    return carriage.kind == TargetKind::Shelf ? "in" : "on";
}

}  // namespace

std::vector<render::ObjectRelation> relationsOf(const Scene& scene, const RayCaster& rays,
                                                const planning::TargetParams& params) {
    const std::vector<planning::Carriage> carriages = planning::findCarriers(scene, rays, params);
    std::vector<render::ObjectRelation> relations;
    for (std::size_t i = 0; i < carriages.size(); ++i) {
        if (carriages[i].holder == 0) continue;
        relations.push_back({scene.objects[i].id, wordFor(carriages[i]), carriages[i].holder});
    }
    return relations;
}

}  // namespace dollytrack::cli
