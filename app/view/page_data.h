#pragma once

#include "app/view/frame_pictures.h"
#include "app/view/storey_views.h"
#include "app/view/view_mesh.h"
#include "render/verify/read/stored_dataset.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::view {

/// The rows of metrics.counted.per_object in dataset.json by object id; empty without them.
[[nodiscard]] std::map<int, nlohmann::ordered_json> countedRows(
    const verify::StoredDataset& dataset);

/// The dataset's frames that show some object best, by rising index.
[[nodiscard]] std::vector<int> bestFrames(const verify::StoredDataset& dataset);

/// How many bytes of a page the dataset takes at least. Each moving object has a row in each frame,
/// so a small dataset.json can ask for far more than memory holds.
[[nodiscard]] std::size_t leastDataBytes(const verify::StoredDataset& dataset);

/// What the page says of dataset, objects and frames; assets/view/README.md lists the fields.
[[nodiscard]] nlohmann::ordered_json pageData(const verify::StoredDataset& dataset);

/// The description of the surfaces whose numbers stand beside it, and of the storeys.
[[nodiscard]] nlohmann::ordered_json roomData(const Scene& scene, const ViewMesh& mesh,
                                              const std::vector<PageStorey>& storeys);

}  // namespace dollytrack::view
