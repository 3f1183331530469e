#pragma once

#include "engine/core/result.h"
#include "engine/io/files/reachable_files.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::habitat {

/// Expands the path patterns of a dataset config. Each folder is listed once; too many folders or
/// files are an error. Not thread-safe.
class FolderSearch {
  public:
    static constexpr std::size_t kMostPatterns = 2'000;  // per kind; HM3D lists 1,000 stages
    static constexpr std::size_t kMostFiles = 100'000;   // per kind

    /// Patterns are relative to `root`; `where` names the config in errors. `files` must outlive
    /// this object.
    FolderSearch(const ReachableFiles& files, std::filesystem::path root, std::string where,
                 JobContext job, std::size_t most_names)
        : files_(files),
          root_(std::move(root)),
          where_(std::move(where)),
          job_(std::move(job)),
          most_names_(most_names) {}

    /// Whether a text contains wildcards.
    [[nodiscard]] static bool isPattern(const std::string& text);

    /// The folders and files that match a path with wildcards. Paths without wildcards are
    /// returned whether they exist or not. Errors: BadInput (too many), Cancelled.
    Result<std::vector<std::filesystem::path>> expand(const std::string& pattern);

    /// The names in a folder; empty for a file or a missing folder. Errors: as above.
    Result<const std::vector<std::string>*> list(const std::filesystem::path& folder);

    [[nodiscard]] tl::unexpected<Error> tooManyPatterns(const std::string& section) const;
    [[nodiscard]] tl::unexpected<Error> tooMany(const char* what) const;

  private:
    const ReachableFiles& files_;
    std::filesystem::path root_;
    std::string where_;
    JobContext job_;
    std::size_t most_names_;
    std::map<std::filesystem::path, std::vector<std::string>> listings_;
    std::size_t work_ = 0;
};

}  // namespace dollytrack::habitat
