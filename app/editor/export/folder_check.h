#pragma once

#include "engine/jobs/background_worker.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

namespace dollytrack::editor {

/// What a dataset would find in a folder.
struct FolderFinding {
    enum class Kind {
        Unknown,     // not looked at yet
        Free,        // there and empty
        New,         // not there, but the folder around it is
        NewInNew,    // neither; `around` is the nearest that is there
        Dataset,     // an earlier dataset, which the new one replaces
        Unfinished,  // an export that did not end; the new one replaces it
        OtherFiles,
        NoFolder,  // a file has that name, or a part of the path's
    };
    std::filesystem::path folder;
    Kind kind = Kind::Unknown;
    std::filesystem::path around = {};
};

[[nodiscard]] FolderFinding lookAtFolder(const std::filesystem::path& folder);

/// Keeps looking, in the background: disks far away answer slowly. Main thread only.
class FolderCheck {
  public:
    explicit FolderCheck(std::function<void()> wake) : looker_(std::move(wake)) {}

    /// What is known of this folder now. Once a frame while it matters.
    const FolderFinding& of(const std::filesystem::path& folder);

  private:
    FolderFinding found_;
    std::filesystem::path asked_;
    std::chrono::steady_clock::time_point asked_at_;
    std::shared_ptr<Outbox<FolderFinding>> answer_ = std::make_shared<Outbox<FolderFinding>>();
    BackgroundWorker looker_;
};

}  // namespace dollytrack::editor
