#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/draw/storey_cutaway.h"
#include "render/verify/read/stored_dataset.h"

#include <vector>

namespace dollytrack::view {

/// A storey as the page looks into it from above.
struct PageStorey {
    render::StoreyView heights;
    Eigen::AlignedBox3d box;  // of the building, of this storey's height
};

/// The storeys, lowest first; at least one. Ceilings are where rays upwards from the dataset's
/// cameras end, as many scenes have walls and ceiling in one piece.
[[nodiscard]] std::vector<PageStorey> storeysFor(const Scene& scene, const RayCaster& rays,
                                                 const verify::StoredDataset& dataset);

}  // namespace dollytrack::view
