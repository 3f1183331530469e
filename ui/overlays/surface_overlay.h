#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

namespace dollytrack::ui {

/// Which patches are drawn, by PatchState.
struct SurfaceOverlayOptions {
    bool unseen = true;
    bool seen = true;  // also SeenAtBest
    bool covered = false;
    bool operator==(const SurfaceOverlayOptions&) const = default;
};

/// The patches as squares on the surface, coloured by what the frames show of them.
[[nodiscard]] PlanLayer surfaceLayer(const SurfaceShare& surface,
                                     const SurfaceOverlayOptions& options);

}  // namespace dollytrack::ui
