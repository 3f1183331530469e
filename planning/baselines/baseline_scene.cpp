#include "planning/baselines/baseline_scene.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/gaze/texture_corners.h"
#include "planning/timing/clip.h"
#include "planning/visibility/view_estimator.h"

#include <cmath>

namespace dollytrack::planning {

Result<MappedScene> mapScene(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                             const PlanParams& params, const JobContext& job) {
    if (Status status = validate(params); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const auto rays = std::make_shared<const RayCaster>(*scene);
    auto map = FreeSpace::build(*scene, *rays, params.camera, params.free_space, job);
    if (!map) return tl::unexpected(std::move(map.error()));
    const auto free_space = std::make_shared<const FreeSpace>(std::move(*map));
    const auto region = std::make_shared<const AllowedRegion>(
        *scene, *rays, *free_space, edits.no_go, params.free_space, params.body,
        params.camera.camera_radius_m);
    MappedScene made = mappedSceneOf(std::move(scene), edits, params, rays, free_space, region);
    made.texture_corners = std::make_shared<const TextureCorners>(*made.scene);
    return made;
}

MappedScene mappedSceneOf(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                          const PlanParams& params, std::shared_ptr<const RayCaster> rays,
                          std::shared_ptr<const FreeSpace> free_space,
                          std::shared_ptr<const AllowedRegion> region) {
    MappedScene made;
    made.scene = std::move(scene);
    made.edits = edits;
    made.rays = std::move(rays);
    made.free_space = std::move(free_space);
    made.region = std::move(region);
    made.sphere = std::make_shared<const SweptSphere>(
        *made.rays, *made.free_space, params.camera.camera_radius_m, made.region.get());
    made.views = std::make_shared<const ViewEstimator>(*made.scene, *made.rays, params.camera);
    return made;
}

std::vector<int> shareByRoom(const MappedScene& scene, int total, int least) {
    const auto& rooms = scene.free_space->rooms();
    double volume = 0.0;
    for (const Room& room : rooms) volume += room.volume_m3;
    std::vector<int> shares(rooms.size(), 0);
    int given = 0;
    for (std::size_t i = 1; i < rooms.size(); ++i) {
        const int share = static_cast<int>(std::lround(total * rooms[i].volume_m3 / volume));
        if (share < least || share > total - given) continue;
        shares[i] = share;
        given += share;
    }
    shares[0] = total - given;
    return shares;
}

Eigen::Vector3d randomPlace(const MappedScene& scene, int room, Random& random) {
    constexpr int kTries = 200;
    const auto& cells = scene.sphere->cells(room);
    const double half = 0.5 * scene.free_space->resolution_m();
    for (int i = 0; i < kTries && !cells.empty(); ++i) {
        const Eigen::Vector3d cell =
            cells[random.below(static_cast<std::uint32_t>(cells.size()))].cast<double>();
        const double dx = random.uniform(-half, half);
        const double dy = random.uniform(-half, half);
        const double dz = random.uniform(-half, half);
        const Eigen::Vector3d place = cell + Eigen::Vector3d(dx, dy, dz);
        if (scene.sphere->fits(place)) return place;
    }
    return scene.free_space->rooms()[room].sample;
}

int frameBudget(const PlanParams& params) {
    if (params.timing.duration_s > 0.0) return clipFrames(params.timing);
    return params.timing.max_frames > 0 ? params.timing.max_frames : 300;
}

}  // namespace dollytrack::planning
