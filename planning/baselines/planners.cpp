#include "planning/baselines/best_view.h"
#include "planning/baselines/density_walk.h"
#include "planning/baselines/dollytrack_planner.h"
#include "planning/baselines/planner.h"
#include "planning/baselines/random_keys.h"
#include "planning/baselines/test_views.h"
#include "planning/baselines/two_body.h"
#include "planning/baselines/uniform.h"
#include "planning/baselines/wall_stare.h"

#include "engine/core/field_list.h"

#include <algorithm>
#include <array>

namespace dollytrack::planning {
namespace {

constexpr std::array kPlanners = {
    Planner{"dollytrack", "a view for every object, joined by moves proven collision-free",
            "this program, after Information 2025, 16(4), 315",
            "proven for the whole motion, corners included", planWithDollytrack},
    Planner{"paper-smoothing", "the same path with the paper's smoothing",
            "Camera Pose Generation Based on Unity3D, Information 2025, 16(4), 315",
            "none: up to 15 % colliding corners are accepted", planPaperSmoothing},
    Planner{"two-body", "two randomly pushed bodies: the camera and the point it looks at",
            "SceneNet RGB-D (McCormac et al., ICCV 2017), InteriorNet (Li et al., BMVC 2018)",
            "positions are tested at every step; the motion between them is not", planTwoBody},
    Planner{"density-walk", "a random walk attracted by dense triangles",
            "Hypersim (Roberts et al., ICCV 2021)",
            "positions are tested; between them only a free line of sight", planDensityWalk},
    Planner{"best-view", "the views that overlook most of each room's floor plan",
            "3D-FRONT (Fu et al., ICCV 2021)", "positions are tested; there is no motion",
            planBestView},
    Planner{"random-keys", "random key frames joined by RRT* at constant speed",
            "TartanAir, easy (Wang et al., IROS 2020)", "RRT* in free space", planRandomKeysEasy},
    Planner{"random-keys-hard", "the same with sinusoidal bumps",
            "TartanAir, hard (Wang et al., IROS 2020)",
            "RRT* in free space, then shaken: frames are tested; the motion between them is not",
            planRandomKeysHard},
    Planner{"uniform", "random legal poses", "the usual baseline, as in BlenderProc",
            "positions are tested; there is no motion", planUniform},
};

constexpr std::array kAuxiliary = {
    Planner{"wall-stare", "a control: a camera that stares at a bare wall", "this program",
            "positions are tested", planWallStare},
    Planner{"object-facing", "test views: at random objects from 1 to 3 m", "this program",
            "positions are tested; there is no motion", planObjectFacing},
    Planner{"close-views", "test views: at random objects from 0.3 to 1 m", "this program",
            "positions are tested; there is no motion", planCloseViews},
};

}  // namespace

std::span<const Planner> planners() {
    return kPlanners;
}

std::span<const Planner> auxiliaryPlanners() {
    return kAuxiliary;
}

Result<std::vector<const Planner*>> choosePlanners(const std::vector<std::string>& names) {
    std::vector<std::string> known = {"all"};
    for (const Planner& planner : kPlanners) known.emplace_back(planner.name);
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string closest = closestName(name, known);
        std::string list;
        for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
        return fail(
            ErrorCode::Usage,
            "The planner is unknown; " + (closest.empty() ? "the planners are " + list + "."
                                                          : "did you mean " + closest + "?"),
            name);
    }
    const auto asked = [&](std::string_view name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    std::vector<const Planner*> chosen;
    for (const Planner& planner : kPlanners) {
        if (asked("all") || asked(planner.name)) chosen.push_back(&planner);
    }
    return chosen;
}

}  // namespace dollytrack::planning
