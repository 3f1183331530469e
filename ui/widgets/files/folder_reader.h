#pragma once

#include "engine/jobs/background_worker.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

struct FolderEntry {
    std::string name;
    bool is_folder = false;
    std::uint64_t bytes = 0;      // of a file; 0 for folders
    std::int64_t modified_s = 0;  // seconds since 1970; 0: unknown
};

struct FolderListing {
    std::filesystem::path folder;
    std::vector<FolderEntry> entries;  // unsorted
    std::string problem;               // message for the user if reading failed; empty otherwise
};

/// Filter and order of a folder's entries. Folders always come first.
struct FolderOrder {
    enum class Key { Name, Date, Size };
    Key key = Key::Name;
    bool descending = false;
    bool hidden = false;  // include names that begin with a dot
    bool folders_only = false;
    std::vector<std::string> extensions;  // such as ".glb", in lower case; empty: all files
    bool operator==(const FolderOrder&) const = default;
};

/// Indices of the displayed entries, in order. Digits in names compare as numbers.
std::vector<std::uint32_t> arrange(const FolderListing& listing, const FolderOrder& order);

/// Result of looking up a path.
struct PathAnswer {
    enum class Found { Nothing, File, Folder };
    std::filesystem::path path;  // absolute and normalized
    Found found = Found::Nothing;
    bool parent_is_folder = false;
    std::shared_ptr<const FolderListing> listing;  // for Folder; null otherwise
    std::string problem;                           // why creating a folder failed; or empty
};

/// Reads folders on a background thread, so that a slow disk never blocks the window. A new request
/// replaces pending ones.
class FolderReader {
  public:
    /// `wake` is called from that thread when there is an answer.
    explicit FolderReader(std::function<void()> wake = {}) : worker_(std::move(wake)) {}

    /// Requests the content at a path. With `nearest`, the nearest existing parent replaces a path
    /// that does not exist.
    void look(const std::filesystem::path& path, bool nearest = false);
    /// Creates a folder and reads it.
    void makeFolder(const std::filesystem::path& path);
    [[nodiscard]] std::optional<PathAnswer> take() { return answer_->take(); }
    [[nodiscard]] bool busy() const { return worker_.state().busy; }

  private:
    std::shared_ptr<LatestValue<PathAnswer>> answer_ = std::make_shared<LatestValue<PathAnswer>>();
    BackgroundWorker worker_;
};

/// Sorts the entries of a folder on a background thread, since 100,000 of them take a while.
class FolderSorter {
  public:
    struct Answer {
        std::shared_ptr<const FolderListing> listing;
        std::vector<std::uint32_t> rows;
    };
    explicit FolderSorter(std::function<void()> wake = {}) : worker_(std::move(wake)) {}

    void arrange(std::shared_ptr<const FolderListing> listing, const FolderOrder& order);
    [[nodiscard]] std::optional<Answer> take() { return answer_->take(); }

  private:
    std::shared_ptr<LatestValue<Answer>> answer_ = std::make_shared<LatestValue<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::ui
