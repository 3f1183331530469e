#include "app/editor/export/folder_check.h"

#include <system_error>
#include <utility>

namespace dollytrack::editor {
namespace {

namespace fs = std::filesystem;
using FindingKind = FolderFinding::Kind;

// Files may change while the form is open.
constexpr std::chrono::seconds kLookAgain{1};

}  // namespace

FolderFinding lookAtFolder(const fs::path& folder) {
    FolderFinding found{folder, FindingKind::Unknown};
    std::error_code error;
    if (fs::exists(folder, error)) {
        const auto has = [&](const char* name) { return fs::exists(folder / name, error); };
        if (!fs::is_directory(folder, error)) {
            found.kind = FindingKind::NoFolder;
        } else if (has("dataset.json") || has("rooms.json")) {
            found.kind = FindingKind::Dataset;
        } else if (has(".dollytrack-export")) {
            found.kind = FindingKind::Unfinished;
        } else {
            found.kind = fs::is_empty(folder, error) ? FindingKind::Free : FindingKind::OtherFiles;
        }
        return found;
    }
    fs::path parent =
        folder.has_filename() ? folder.parent_path() : folder.parent_path().parent_path();
    found.kind = fs::exists(parent, error) ? FindingKind::New : FindingKind::NewInNew;
    while (!parent.empty() && !fs::exists(parent, error) && parent != parent.root_path()) {
        parent = parent.parent_path();
    }
    found.around = parent;
    if (!fs::is_directory(parent, error)) found.kind = FindingKind::NoFolder;
    return found;
}

const FolderFinding& FolderCheck::of(const fs::path& folder) {
    if (auto answer = answer_->take()) found_ = std::move(*answer);
    const auto now = std::chrono::steady_clock::now();
    if (folder != asked_ || (now - asked_at_ > kLookAgain && !looker_.state().busy)) {
        asked_ = folder;
        asked_at_ = now;
        looker_.start(
            [folder, latest = answer_](const JobContext&) { latest->put(lookAtFolder(folder)); });
    }
    if (found_.folder != folder) found_ = {folder, FindingKind::Unknown};
    return found_;
}

}  // namespace dollytrack::editor
