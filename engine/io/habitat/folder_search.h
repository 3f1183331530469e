#pragma once

#include "engine/core/result.h"
#include "engine/io/sandbox/reachable_files.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::habitat {

/// Finds what the patterns of a dataset config stand for. Lists each folder once, and stops with an
/// error where a config leads into too many. For one thread.
class FolderSearch {
  public:
    static constexpr std::size_t kMostPatterns = 2'000;  // of a kind; HM3D lists 1,000 stages
    static constexpr std::size_t kMostFiles = 100'000;   // of one kind

    /// Patterns count from `root`; `where` names the config in errors. `files` has to outlive this
    /// object.
    FolderSearch(const io::ReachableFiles& files, std::filesystem::path root, std::string where,
                 JobContext job, std::size_t most_names)
        : files_(files),
          root_(std::move(root)),
          where_(std::move(where)),
          job_(std::move(job)),
          most_names_(most_names) {}

    /// Whether a text holds wildcards.
    [[nodiscard]] static bool isPattern(const std::string& text);

    /// The folders and files that a path with wildcards stands for.
    Result<std::vector<std::filesystem::path>> expand(const std::string& pattern);

    /// The names in a folder; none of a file.
    Result<const std::vector<std::string>*> list(const std::filesystem::path& folder);

    [[nodiscard]] tl::unexpected<Error> tooManyPatterns(const std::string& section) const;
    [[nodiscard]] tl::unexpected<Error> tooMany(const char* what) const;

  private:
    const io::ReachableFiles& files_;
    std::filesystem::path root_;
    std::string where_;
    JobContext job_;
    std::size_t most_names_;
    std::map<std::filesystem::path, std::vector<std::string>> listings_;
    std::size_t work_ = 0;
};

}  // namespace dollytrack::habitat
