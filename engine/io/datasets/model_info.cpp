#include "engine/io/datasets/model_info.h"

#include "engine/io/files/bounded_json.h"
#include "engine/io/files/confined_folder.h"

namespace dollytrack {
namespace {

constexpr const char* kName = "model_info.json";

ModelInfo infoOf(const nlohmann::json& entry) {
    return {textIn(entry, "category"), textIn(entry, "super-category"),
            textIn(entry, "category_id")};
}

}  // namespace

Result<std::map<std::string, ModelInfo>> readModelInfo(const std::filesystem::path& path) {
    const Result<nlohmann::json> read = readBoundedJson(path);
    if (!read) return tl::unexpected(read.error());
    std::map<std::string, ModelInfo> models;
    if (read->is_object()) {
        for (const auto& [jid, entry] : read->items()) models[jid] = infoOf(entry);
    } else if (read->is_array()) {
        for (const nlohmann::json& entry : *read) models[textIn(entry, "model_id")] = infoOf(entry);
    } else {
        return fail(ErrorCode::BadInput, "It is not a list of models.", path.string());
    }
    return models;
}

std::vector<std::filesystem::path> modelInfoBeside(
    const std::vector<std::filesystem::path>& folders) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& folder : folders) {
        files.push_back(folder.parent_path() / kName);
    }
    return files;
}

std::filesystem::path findModelInfo(const std::vector<std::filesystem::path>& folders) {
    for (const std::filesystem::path& folder : folders) {
        for (const std::filesystem::path& place : {folder, folder.parent_path()}) {
            if (hasFile(place / kName)) return place / kName;
        }
    }
    return {};
}

}  // namespace dollytrack
