#pragma once

#include "render/verify/read/stored_dataset.h"

#include <string>
#include <vector>

namespace dollytrack::verify {

/// A file of a modality that leads from one frame to another, as a path without endings.
struct FlowFile {
    std::string stem;  // for example "flow_forward/000012_000013"
    int other = 0;     // frame to which the motions lead
};

/// Files of flow_forward, flow_backward or scene_flow that start at a frame, for all distances of
/// the dataset; none if it lacks the modality.
std::vector<FlowFile> pairFiles(const StoredDataset& dataset, const std::string& modality,
                                int frame);

/// Optical flow files that start at a frame, in both directions.
std::vector<FlowFile> flowFiles(const StoredDataset& dataset, int frame);

/// Frame distances of the flow; empty if dataset.json lacks them.
std::vector<int> flowDistances(const StoredDataset& dataset, const std::string& modality);

}  // namespace dollytrack::verify
