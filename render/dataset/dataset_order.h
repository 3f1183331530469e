#pragma once

#include "render/dataset/contents/dataset_contents.h"
#include "render/dataset/dataset_job.h"
#include "render/formats/tables/dataset_card.h"

namespace dollytrack::render {

/// A dataset's description before its images are drawn.
struct DatasetOrder {
    DatasetContents contents;
    DatasetCard card;
};

/// Describes the dataset that these settings ask for. Returns Usage for unknown names, for a range
/// without frames, and for a lens that does not fit the camera.
[[nodiscard]] Result<DatasetOrder> describeOrder(const Scene& scene, const CameraParams& camera,
                                                 const Trajectory& trajectory,
                                                 const DatasetSettings& settings,
                                                 const DatasetOrigin& origin);

}  // namespace dollytrack::render
