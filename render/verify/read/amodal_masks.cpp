#include "render/verify/read/amodal_masks.h"

#include "engine/io/files/bounded_json.h"
#include "render/verify/read/json_file.h"
#include "render/verify/read/run_lengths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

namespace dollytrack::verify {

Result<std::vector<AmodalMask>> readAmodal(const std::filesystem::path& path, int width,
                                           int height) {
    const Result<nlohmann::json> root = readJson(path);
    if (!root) return tl::unexpected(root.error());
    std::vector<AmodalMask> masks;
    std::set<int> ids;
    try {
        for (const auto& one : root->at("objects")) {
            AmodalMask mask{
                one.at("object_id").get<int>(), one.at("bbox").get<std::array<int, 4>>(), {}};
            if (!ids.insert(mask.object_id).second) {
                return fail(ErrorCode::BadInput,
                            fmt::format("object {} has two masks", mask.object_id), path.string());
            }
            if (one.at("size").get<std::array<int, 2>>() == std::array{height, width}) {
                mask.runs = one.at("counts").get<std::string>();
            }
            masks.push_back(std::move(mask));
        }
    } catch (const nlohmann::json::exception& error) {
        return fail(ErrorCode::BadInput,
                    fmt::format("It is not a list of masks ({}).", plainReason(error)),
                    path.string());
    }
    return masks;
}

std::vector<std::uint8_t> insideOf(const AmodalMask& mask, int width, int height) {
    return maskFrom(readRunLengths(mask.runs), width, height);
}

std::string amodalFile(int frame) {
    return fmt::format("amodal/{:06}.json", frame);
}

}  // namespace dollytrack::verify
