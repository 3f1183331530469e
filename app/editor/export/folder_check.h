#pragma once

#include "engine/jobs/background_worker.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

namespace dollytrack::editor {

/// The state of a folder chosen for a dataset.
struct FolderFinding {
    enum class Kind {
        Unknown,     // not checked yet
        Free,        // exists and is empty
        New,         // does not exist, but its parent folder does
        NewInNew,    // neither exists; `around` is the nearest existing parent
        Dataset,     // a complete dataset
        Unfinished,  // an interrupted export, which a new one replaces
        OtherFiles,
        NoFolder,  // the path or a part of it is a file
    };
    std::filesystem::path folder;
    Kind kind = Kind::Unknown;
    std::filesystem::path around = {};
};

[[nodiscard]] FolderFinding lookAtFolder(const std::filesystem::path& folder);

/// Checks a folder repeatedly in the background, because network disks are slow. Main thread only.
class FolderCheck {
  public:
    explicit FolderCheck(std::function<void()> wake) : looker_(std::move(wake)) {}

    /// The latest finding for this folder. To be called every frame while needed.
    const FolderFinding& of(const std::filesystem::path& folder);

  private:
    FolderFinding found_;
    std::filesystem::path asked_;
    std::chrono::steady_clock::time_point asked_at_;
    std::shared_ptr<LatestValue<FolderFinding>> answer_ =
        std::make_shared<LatestValue<FolderFinding>>();
    BackgroundWorker looker_;
};

}  // namespace dollytrack::editor
