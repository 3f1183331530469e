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
    std::uint64_t bytes = 0;      // of a file
    std::int64_t modified_s = 0;  // since 1970; 0: not known
};

struct FolderListing {
    std::filesystem::path folder;
    std::vector<FolderEntry> entries;  // in no order
    std::string problem;               // why it could not be read, for the user; empty: it was
};

/// What shall be shown of a folder, and in which order. Folders always come first.
struct FolderOrder {
    enum class Key { Name, Date, Size };
    Key key = Key::Name;
    bool descending = false;
    bool hidden = false;  // also names that begin with a dot
    bool folders_only = false;
    std::vector<std::string> extensions;  // of files, such as ".glb", in lower case; empty: all
    bool operator==(const FolderOrder&) const = default;
};

/// Indices of the entries to be shown, in order. Digits in names count as numbers.
std::vector<std::uint32_t> arrange(const FolderListing& listing, const FolderOrder& order);

/// What there is at a path.
struct PathAnswer {
    enum class Found { Nothing, File, Folder };
    std::filesystem::path path;  // absolute, without "..": what was asked for
    Found found = Found::Nothing;
    bool parent_is_folder = false;
    std::shared_ptr<const FolderListing> listing;  // with Folder
    std::string problem;                           // a new folder could not be made
};

/// Looks into folders on a thread of its own, so that a slow disk never holds up the window. The
/// newest question replaces the ones before.
class FolderReader {
  public:
    /// `wake` is called from the thread when there is an answer.
    explicit FolderReader(std::function<void()> wake = {}) : worker_(std::move(wake)) {}

    /// With `nearest`, a path that does not exist stands for its nearest parent that does.
    void look(const std::filesystem::path& path, bool nearest = false);
    /// Makes a folder and looks into it.
    void makeFolder(const std::filesystem::path& path);
    [[nodiscard]] std::optional<PathAnswer> take() { return answer_->take(); }
    [[nodiscard]] bool busy() const { return worker_.state().busy; }

  private:
    std::shared_ptr<Outbox<PathAnswer>> answer_ = std::make_shared<Outbox<PathAnswer>>();
    BackgroundWorker worker_;
};

/// The same for putting a listing in order, which takes a while for 100,000 entries.
class FolderArranger {
  public:
    struct Answer {
        std::shared_ptr<const FolderListing> listing;
        std::vector<std::uint32_t> rows;
    };
    explicit FolderArranger(std::function<void()> wake = {}) : worker_(std::move(wake)) {}

    void arrange(std::shared_ptr<const FolderListing> listing, const FolderOrder& order);
    [[nodiscard]] std::optional<Answer> take() { return answer_->take(); }

  private:
    std::shared_ptr<Outbox<Answer>> answer_ = std::make_shared<Outbox<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::ui
