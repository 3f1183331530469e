#include "planning/baselines/reachable_surface.h"

#include "planning/collision/swept_sphere.h"
#include "planning/coverage/reachable_patches.h"
#include "planning/free_space/free_space.h"

namespace dollytrack::planning {
namespace {

constexpr std::size_t kPlacesAround = 400;
constexpr int kRaysAround = 20'000;  // per position: 7 cm apart at 3 m

}  // namespace

Result<std::vector<SurfacePatch>> reachableSurface(const MappedScene& scene, double spacing_m,
                                                   const JobContext& job) {
    return reachablePatches(*scene.scene, *scene.rays,
                            evenPlaces(*scene.free_space, *scene.sphere, kPlacesAround),
                            kRaysAround, spacing_m, job);
}

}  // namespace dollytrack::planning
