#include "render/verify/amodal_masks.h"

#include "render/verify/run_lengths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numeric>

namespace dollytrack::verify {

Result<std::vector<AmodalMask>> readAmodal(const std::filesystem::path& path, int width,
                                           int height) {
    std::vector<AmodalMask> masks;
    try {
        std::ifstream file(path);
        const nlohmann::json root = nlohmann::json::parse(file);
        for (const auto& one : root.at("objects")) {
            AmodalMask mask{
                one.at("object_id").get<int>(), one.at("bbox").get<std::array<int, 4>>(), {}, 0};
            const auto size = one.at("size").get<std::array<int, 2>>();
            if (size == std::array{height, width}) {
                const auto text = one.at("counts").get<std::string>();
                mask.inside = maskFrom(readRunLengths(text), width, height);
            }
            mask.area = std::accumulate(mask.inside.begin(), mask.inside.end(), 0);
            masks.push_back(std::move(mask));
        }
    } catch (const nlohmann::json::exception& error) {
        return fail(ErrorCode::BadInput, fmt::format("It is no list of masks ({}).", error.what()),
                    path.string());
    }
    return masks;
}

std::string amodalFile(int frame) {
    return fmt::format("amodal/{:06}.json", frame);
}

}  // namespace dollytrack::verify
