#pragma once

#include "render/verify/read/stored_dataset.h"

#include <string>
#include <vector>

namespace dollytrack::verify {

/// A flow file and its mask, as a path without endings.
struct FlowFile {
    std::string stem;  // for example "flow_forward/000012_000013"
    int other = 0;     // frame to which the motions lead
};

/// Flow files that start at a frame, for all directions and distances of the dataset.
std::vector<FlowFile> flowFiles(const StoredDataset& dataset, int frame);

/// Frame distances of the flow; empty if dataset.json lacks them.
std::vector<int> flowDistances(const StoredDataset& dataset, const std::string& modality);

}  // namespace dollytrack::verify
