#pragma once

#include "render/verify/read/stored_dataset.h"

#include <string>
#include <vector>

namespace dollytrack::verify {

/// A file of motions from one frame to another, and its mask, without their endings.
struct FlowFile {
    std::string stem;  // "flow_forward/000012_000013"
    int other = 0;     // the frame that the motions lead to
};

/// Those that begin at a frame, of all directions and distances that the dataset has.
std::vector<FlowFile> flowFiles(const StoredDataset& dataset, int frame);

/// The numbers of frames that motions lead over; empty when dataset.json does not tell.
std::vector<int> flowDistances(const StoredDataset& dataset, const std::string& modality);

}  // namespace dollytrack::verify
