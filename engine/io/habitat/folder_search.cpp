#include "engine/io/habitat/folder_search.h"

#include "engine/core/name_pattern.h"

#include <system_error>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFolders = 20'000;  // listed for all patterns together

}  // namespace

bool FolderSearch::isPattern(const std::string& text) {
    return text.find_first_of("*?") != std::string::npos;
}

Result<std::vector<fs::path>> FolderSearch::expand(const std::string& pattern) {
    std::vector<fs::path> level = {root_};
    for (const fs::path& step : fs::path(pattern)) {
        const std::string part = step.string();
        if (part.empty()) continue;
        std::vector<fs::path> next;
        work_ += level.size();
        for (const fs::path& folder : level) {
            if (!isPattern(part)) {
                next.push_back((folder / part).lexically_normal());
                continue;
            }
            const auto names = list(folder);
            if (!names) return tl::unexpected(names.error());
            work_ += (*names)->size();
            for (const std::string& name : **names) {
                if (next.size() <= kMostFiles && fitsPattern(part, name)) {
                    next.push_back(folder / name);
                }
            }
        }
        if (next.size() > kMostFiles || work_ > most_names_) return tooMany("files");
        level = std::move(next);
    }
    return level;
}

Result<const std::vector<std::string>*> FolderSearch::list(const fs::path& folder) {
    const auto [at, is_new] = listings_.try_emplace(folder);
    if (!is_new) return &at->second;
    if (job_.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    if (listings_.size() > kMostFolders) return tooMany("folders");
    std::error_code error;
    const fs::file_status status =
        files_.reaches(folder) ? fs::status(folder, error) : fs::file_status();
    // Missing folders are listed as well, which records that the scene depends on them.
    if (!fs::exists(status) || fs::is_directory(status)) {
        Result<std::vector<std::string>> names = files_.namesIn(folder);
        if (!names) return tl::unexpected(names.error());
        at->second = std::move(*names);
    }
    work_ += at->second.size();
    if (work_ > most_names_) return tooMany("files");
    return &at->second;
}

tl::unexpected<Error> FolderSearch::tooManyPatterns(const std::string& section) const {
    return fail(ErrorCode::BadInput,
                "the dataset config has more than " + std::to_string(kMostPatterns) + " paths of " +
                    section + "; write folders or wildcards instead",
                where_);
}

tl::unexpected<Error> FolderSearch::tooMany(const char* what) const {
    return fail(ErrorCode::BadInput,
                std::string("the paths of the dataset config match too many ") + what +
                    "; write paths that match fewer",
                where_);
}

}  // namespace dollytrack::habitat
