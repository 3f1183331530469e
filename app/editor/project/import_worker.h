#pragma once

#include "engine/core/result.h"
#include "engine/io/settings/project_file.h"
#include "engine/jobs/background_worker.h"
#include "engine/scene/scene.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace dollytrack::editor {

/// Imports the scene of the open project again in the background, with other import settings. A
/// newer request replaces an older one.
class ImportWorker {
  public:
    struct Outcome {
        nlohmann::json import;  // the settings
        Result<std::shared_ptr<const Scene>> scene;
    };

    explicit ImportWorker(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Imports the scene that the content of this project file names, with its import settings.
    /// `project` is the file's path; empty: never saved.
    void start(ProjectFile content, const std::filesystem::path& project);
    /// Cancels the request and drops its result.
    void cancel();
    /// The settings of the request whose result was not taken yet; null: there is none.
    [[nodiscard]] const nlohmann::json& awaited() const { return awaited_; }
    [[nodiscard]] BackgroundWorker::State state() const { return worker_.state(); }
    /// The newest result since the last call.
    [[nodiscard]] std::optional<Outcome> take();

  private:
    struct Numbered {
        std::uint64_t request = 0;
        Result<std::shared_ptr<const Scene>> scene;
    };

    std::uint64_t request_ = 0;
    nlohmann::json awaited_;
    std::shared_ptr<LatestValue<Numbered>> results_ = std::make_shared<LatestValue<Numbered>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
