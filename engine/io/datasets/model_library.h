#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// Whether a number or name from a file can be a folder's name: letters, digits, '-', '_', '.', no
/// more than 128 of them, and no "..".
bool isPlainName(const std::string& text);

/// The folders that may hold a data set's models: those given, then `usual` names beside the scene
/// and beside its folder. Each is tried as it is and with the usual names below it.
std::vector<std::filesystem::path> foldersFor(const std::filesystem::path& scene,
                                              const std::vector<std::filesystem::path>& given,
                                              const std::vector<std::string>& usual);

/// The file of this relative path in the first folder that has it. A path that is absolute or
/// leaves the folder, by dots or by links, is not found.
std::optional<std::filesystem::path> findBelow(const std::vector<std::filesystem::path>& folders,
                                               const std::filesystem::path& relative);

/// Models read once each, however often they are placed. A model's textures are looked up beside
/// it, or one folder up where it lies in a folder called "models".
class ModelLibrary {
  public:
    /// Notes that a model will be needed; the same number for the same path.
    std::size_t add(const std::filesystem::path& path);
    /// Reads all that were added, in parallel. Error: Cancelled.
    Status read(const JobContext& job);
    /// Null, with a reason, for one that cannot be read or is empty.
    [[nodiscard]] RawScene* model(std::size_t index);
    [[nodiscard]] const std::string& reason(std::size_t index) const;
    [[nodiscard]] const std::filesystem::path& path(std::size_t index) const {
        return paths_[index];
    }

  private:
    std::map<std::filesystem::path, std::size_t> numbers_;
    std::vector<std::filesystem::path> paths_;
    std::vector<RawScene> models_;
    std::vector<std::string> reasons_;
};

/// Counts triangles as models are placed, so that few bytes cannot ask for endless memory.
class TriangleBudget {
  public:
    /// Error: BadInput, beyond 6e7 in all.
    Status take(const RawScene& model, const std::string& where);
    /// The same for a part of a model.
    Status take(std::size_t triangles, const std::string& where);

  private:
    std::size_t used_ = 0;
};

}  // namespace dollytrack::io
