#include "app/gather/sources/source_search.h"

#include "app/batch/batch_folder.h"
#include "app/batch/file_pattern.h"
#include "app/batch/scene_files.h"
#include "app/cli/export/room_exports.h"
#include "engine/core/log.h"
#include "engine/core/name_pattern.h"
#include "engine/core/natural_order.h"
#include "render/dataset/folder/dataset_journal.h"
#include "render/dataset/folder/dataset_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

namespace dollytrack::gather {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatasetFolder = "dataset";  // name of a job's dataset folder in a batch
constexpr int kMostLevels = 8;                     // levels of folders that are searched

std::vector<fs::path> foldersIn(const fs::path& folder) {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code unknown;
        if (at->is_directory(unknown)) folders.push_back(at->path());
    }
    std::ranges::sort(folders, [](const fs::path& a, const fs::path& b) {
        return comesBefore(a.filename().string(), b.filename().string());
    });
    return folders;
}

class DatasetSearch {
  public:
    Status look(const fs::path& folder, int levels) {
        std::error_code error;
        const bool is_dataset = fs::exists(folder / render::kCardFile, error) ||
                                fs::exists(folder / render::kJournalFile, error);
        if (is_dataset && !cli::holdsRooms(folder)) return add(folder);
        if (fs::exists(folder / kGatherCard, error)) return {};
        if (cli::holdsRooms(folder)) {
            const auto rooms = cli::roomFolders(folder);
            if (!rooms) return tl::unexpected(rooms.error());
            for (const fs::path& room : *rooms) (void)add(room);
            return {};
        }
        if (fs::exists(folder / "jobs.json", error)) return lookInBatch(folder);
        if (levels == 0) return {};
        if (!entered_.insert(fs::canonical(folder, error)).second) {
            ++looks_;  // found again
            return {};
        }
        // Typical files of a dataset without dataset.json, such as an incomplete copy.
        if (fs::is_regular_file(folder / "annotations.json", error) &&
            fs::is_directory(folder / "rgb", error)) {
            return add(folder);
        }
        for (const fs::path& within : foldersIn(folder)) {
            if (within.filename().string().front() == '.') continue;
            if (Status status = look(within, levels - 1); !status) return status;
        }
        return {};
    }

    /// Number of datasets encountered, including repeated ones.
    [[nodiscard]] std::size_t looks() const { return looks_; }
    std::vector<fs::path> take() { return std::move(found_); }

  private:
    Status add(const fs::path& folder) {
        std::error_code error;
        ++looks_;
        const fs::path canonical = fs::weakly_canonical(fs::absolute(folder, error), error);
        if (added_.insert(canonical).second) found_.push_back(folder);
        return {};
    }

    Status lookInBatch(const fs::path& folder) {
        const Result<batch::BatchList> list = batch::readBatchList(folder);
        if (!list) return tl::unexpected(list.error());
        for (const batch::Job& job : list->jobs) {
            const fs::path dataset = folder / job.name / kDatasetFolder;
            if (job.command != "export") continue;
            std::error_code error;
            const Status status =
                fs::is_directory(dataset, error) ? look(dataset, 0) : add(dataset);
            if (!status) return status;
        }
        return {};
    }

    std::vector<fs::path> found_;
    std::size_t looks_ = 0;
    std::set<fs::path> added_;    // canonical
    std::set<fs::path> entered_;  // canonical
};

/// The folders that match a pattern.
std::vector<fs::path> foldersMatching(const fs::path& pattern) {
    std::vector<fs::path> folders = {pattern.is_absolute() ? pattern.root_path() : fs::path()};
    for (const fs::path& part : pattern.relative_path()) {
        if (part.empty()) continue;
        std::vector<fs::path> next;
        for (const fs::path& folder : folders) {
            if (!batch::isPattern(part.string())) {
                std::error_code error;
                if (fs::is_directory(folder / part, error)) next.push_back(folder / part);
                continue;
            }
            for (const fs::path& within : foldersIn(folder.empty() ? fs::path(".") : folder)) {
                if (!batch::fitsFilePattern(within.filename().string(), part.string())) continue;
                next.push_back(folder / within.filename());
            }
        }
        folders = std::move(next);
    }
    return folders;
}

/// The path from which a dataset is named: without a last folder "dataset", and without dots, which
/// would end WebDataset's keys.
fs::path namingPath(const fs::path& folder) {
    std::error_code error;
    fs::path path = fs::absolute(folder, error).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    if (path.filename() == kDatasetFolder) path = path.parent_path();
    fs::path around = path.parent_path();
    if (around.filename() == kDatasetFolder) around = around.parent_path();
    return around / batch::asName(path.filename().string());
}

std::vector<FoundDataset> named(const std::vector<fs::path>& folders) {
    std::vector<batch::SceneFile> paths;
    for (const fs::path& folder : folders) paths.push_back({namingPath(folder), {}});
    batch::nameScenes(paths);
    std::vector<FoundDataset> found;
    std::set<std::string> taken;
    for (const batch::SceneFile& path : paths) taken.insert(inSmallLetters(path.name));
    std::set<std::string> used;
    for (std::size_t i = 0; i < folders.size(); ++i) {
        std::string name = paths[i].name;
        for (int n = 2; used.contains(inSmallLetters(name)); ++n) {
            const std::string numbered = fmt::format("{}-{}", paths[i].name, n);
            if (!taken.contains(inSmallLetters(numbered))) name = numbered;
        }
        used.insert(inSmallLetters(name));
        found.push_back({folders[i], std::move(name)});
    }
    return found;
}

}  // namespace

std::vector<std::string> withoutFilesBesideFolders(std::vector<std::string> arguments,
                                                   std::string_view subsystem) {
    const auto is_folder = [](const std::string& argument) {
        std::error_code error;
        return fs::is_directory(argument, error);
    };
    if (std::ranges::none_of(arguments, is_folder)) return arguments;
    std::erase_if(arguments, [&](const std::string& argument) {
        std::error_code error;
        if (!fs::is_regular_file(argument, error)) return false;
        log::warn(subsystem, fmt::format("{}: not a folder; left out", argument));
        return true;
    });
    return arguments;
}

Result<std::vector<FoundDataset>> findDatasets(const std::vector<std::string>& arguments) {
    DatasetSearch search;
    for (const std::string& argument : withoutFilesBesideFolders(arguments, "gather")) {
        std::error_code error;
        const bool is_there = fs::exists(argument, error);
        if (is_there && !fs::is_directory(argument, error)) {
            return fail(ErrorCode::BadInput, "The path is a file; give the folder of a dataset.",
                        argument);
        }
        std::vector<fs::path> folders;
        if (is_there) folders.emplace_back(argument);
        if (!is_there && batch::isPattern(argument)) folders = foldersMatching(argument);
        if (folders.empty()) {
            return fail(ErrorCode::BadInput, "The folder does not exist; check the path.",
                        argument);
        }
        const std::size_t before = search.looks();
        for (const fs::path& folder : folders) {
            if (Status status = search.look(folder, kMostLevels); !status) {
                return tl::unexpected(status.error());
            }
        }
        if (search.looks() == before) {
            return fail(
                ErrorCode::BadInput,
                "The folder contains no dataset; give a folder that 'dollytrack export' wrote.",
                argument);
        }
    }
    return named(search.take());
}

}  // namespace dollytrack::gather
