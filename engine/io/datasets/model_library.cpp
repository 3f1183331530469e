#include "engine/io/datasets/model_library.h"

#include "engine/core/clean_text.h"
#include "engine/core/text_lists.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/models/model_reader.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cctype>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTriangles = 60'000'000;
constexpr std::size_t kMostRemarks = 20;

bool staysInside(const fs::path& relative) {
    const fs::path normal = relative.lexically_normal();
    return !normal.empty() && normal.is_relative() && *normal.begin() != "..";
}

std::size_t countTriangles(const RawScene& model) {
    std::size_t count = 0;
    for (const MeshPart& part : model.parts) count += part.triangles.size();
    return count;
}

/// The cost of a copy of a part, in triangles; includes vertices that no triangle uses.
std::size_t costOf(const MeshPart& part) {
    return std::max({part.triangles.size(), part.positions.size() / 3, std::size_t{1}});
}

}  // namespace

bool isPlainName(const std::string& text) {
    return !text.empty() && text.size() <= 128 && text.find("..") == std::string::npos &&
           std::all_of(text.begin(), text.end(), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ||
                      c == '.';
           });
}

std::vector<fs::path> foldersFor(const fs::path& scene, const std::vector<fs::path>& given,
                                 const std::vector<std::string>& usual) {
    std::vector<fs::path> folders;
    const auto add = [&](const fs::path& folder) {
        std::error_code error;
        if (!fs::is_directory(folder, error)) return;
        const fs::path tidy = folder.lexically_normal();
        if (std::find(folders.begin(), folders.end(), tidy) == folders.end()) {
            folders.push_back(tidy);
        }
    };
    for (const fs::path& folder : given) {
        add(folder);
        for (const std::string& name : usual) add(folder / name);
    }
    std::error_code error;
    const fs::path beside = fs::absolute(scene, error).lexically_normal().parent_path();
    for (const fs::path& folder : {beside, beside.parent_path()}) {
        for (const std::string& name : usual) add(folder / name);
    }
    return folders;
}

std::optional<fs::path> findBelow(const std::vector<fs::path>& folders, const fs::path& relative) {
    if (!staysInside(relative)) return std::nullopt;
    for (const fs::path& folder : folders) {
        if (ConfinedFolder(folder).has(relative)) return folder / relative;
    }
    return std::nullopt;
}

std::size_t ModelLibrary::add(const fs::path& path) {
    const auto [at, is_new] = numbers_.try_emplace(path, paths_.size());
    if (is_new) paths_.push_back(path);
    return at->second;
}

Status ModelLibrary::read(const JobContext& job) {
    models_.resize(paths_.size());
    reasons_.resize(paths_.size());
    parallelFor(paths_.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        Result<RawScene> read = readModel(paths_[i], job);
        if (!read) {
            reasons_[i] = read.error().message;
            return;
        }
        models_[i] = std::move(*read);
        if (countTriangles(models_[i]) == 0) reasons_[i] = "it contains no triangle";
        fs::path folder = paths_[i].parent_path();
        const bool around = textures_ == TexturePlace::AroundModelsFolder;
        if (around && folder.filename() == "models") folder = folder.parent_path();
        for (TextureRequest& texture : models_[i].textures) texture.folder = folder;
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    return {};
}

RawScene* ModelLibrary::model(std::size_t index) {
    return reasons_[index].empty() ? &models_[index] : nullptr;
}

const std::string& ModelLibrary::reason(std::size_t index) const {
    return reasons_[index];
}

void ModelRemarks::add(const RawScene& model, const std::string& name) {
    warnings_.add(model.warnings, name);
    notes_.add(model.notes, name);
}

void ModelRemarks::addTo(RawScene& scene) const {
    warnings_.addTo(scene.warnings, "further warning of a model is not shown",
                    "further warnings of models are not shown");
    notes_.addTo(scene.notes, "further note on a model is not shown",
                 "further notes on models are not shown");
}

void ModelRemarks::List::add(const std::vector<std::string>& texts, const std::string& name) {
    for (const std::string& text : texts) {
        const auto [at, is_new] = numbers_.try_emplace(text, remarks_.size());
        if (is_new) remarks_.push_back({text, {}});
        remarks_[at->second].models.push_back(cleanText(name));
    }
}

void ModelRemarks::List::addTo(std::vector<std::string>& lines, const char* one,
                               const char* many) const {
    for (std::size_t i = 0; i < std::min(remarks_.size(), kMostRemarks); ++i) {
        lines.push_back(listOf(remarks_[i].models, 5) + ": " + remarks_[i].text);
    }
    if (remarks_.size() > kMostRemarks) {
        lines.push_back(counted(remarks_.size() - kMostRemarks, one, many));
    }
}

Status TriangleBudget::take(const RawScene& model, const std::string& where) {
    std::size_t cost = 0;
    for (const MeshPart& part : model.parts) cost += costOf(part);
    return take(cost, where);
}

Status TriangleBudget::take(const RawScene& model, const std::vector<std::size_t>& parts,
                            const std::string& where) {
    std::size_t cost = 0;
    for (const std::size_t part : parts) cost += costOf(model.parts[part]);
    return take(cost, where);
}

Status TriangleBudget::take(std::size_t triangles, const std::string& where) {
    used_ += triangles;
    if (used_ > kMostTriangles) {
        return fail(ErrorCode::BadInput,
                    "the scene places models of more than " + std::to_string(kMostTriangles) +
                        " triangles in all",
                    where);
    }
    return {};
}

}  // namespace dollytrack
