#include "render/verify/read/flow_files.h"

#include <fmt/format.h>

namespace dollytrack::verify {

std::vector<int> flowDistances(const StoredDataset& dataset, const std::string& modality) {
    const auto convention = dataset.convention(modality);
    if (!convention.is_object() || !convention.contains("distances")) return {};
    std::vector<int> distances;
    for (const auto& one : convention["distances"]) {
        if (one.is_number_integer()) distances.push_back(one.get<int>());
    }
    return distances;
}

std::vector<FlowFile> pairFiles(const StoredDataset& dataset, const std::string& modality,
                                int frame) {
    std::vector<FlowFile> files;
    if (!dataset.has(modality)) return files;
    const int direction = modality == "flow_backward" ? -1 : 1;
    for (const int distance : flowDistances(dataset, modality)) {
        const int frames = static_cast<int>(dataset.frames.size());
        if (distance < 1 || distance >= frames) continue;
        const int other = frame + direction * distance;
        if (other < 0 || other >= frames) continue;
        files.push_back({fmt::format("{}/{:06}_{:06}", modality, frame, other), other});
    }
    return files;
}

std::vector<FlowFile> flowFiles(const StoredDataset& dataset, int frame) {
    std::vector<FlowFile> files = pairFiles(dataset, "flow_forward", frame);
    for (FlowFile& file : pairFiles(dataset, "flow_backward", frame)) {
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace dollytrack::verify
