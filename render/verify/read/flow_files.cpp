#include "render/verify/read/flow_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <set>

namespace dollytrack::verify {

std::vector<int> flowDistances(const StoredDataset& dataset, const std::string& modality) {
    const auto convention = dataset.convention(modality);
    if (!convention.is_object() || !convention.contains("distances")) return {};
    // dataset.json may be hostile: only distances that frames can have, each once.
    std::set<int> distances;
    for (const auto& one : convention["distances"]) {
        if (!one.is_number_integer()) continue;
        const auto distance = one.get<std::int64_t>();
        if (distance >= 1 && distance <= std::numeric_limits<int>::max()) {
            distances.insert(static_cast<int>(distance));
        }
    }
    return {distances.begin(), distances.end()};
}

std::vector<FlowFile> pairFiles(const StoredDataset& dataset, const std::string& modality,
                                int frame) {
    std::vector<FlowFile> files;
    if (!dataset.has(modality)) return files;
    const int direction = modality == "flow_backward" ? -1 : 1;
    for (const int distance : flowDistances(dataset, modality)) {
        const int frames = static_cast<int>(dataset.frames.size());
        if (distance >= frames) break;
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
