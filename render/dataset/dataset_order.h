#pragma once

#include "render/dataset/dataset_contents.h"
#include "render/dataset/dataset_job.h"
#include "render/formats/tables/dataset_card.h"

namespace dollytrack::render {

/// A dataset as far as it is known before its pictures are.
struct DatasetOrder {
    DatasetContents contents;
    DatasetCard card;
};

/// Error: Usage for unknown names, for a range that holds no frame and for a lens that does not go
/// with the camera.
[[nodiscard]] Result<DatasetOrder> describeOrder(const Scene& scene, const CameraParams& camera,
                                                 const Trajectory& trajectory,
                                                 const DatasetSettings& settings,
                                                 const DatasetOrigin& origin);

}  // namespace dollytrack::render
