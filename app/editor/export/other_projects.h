#pragma once

#include "engine/camera/picture_params.h"
#include "engine/core/result.h"
#include "engine/jobs/background_worker.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace dollytrack::editor {

/// Another project that was read to be exported.
struct OtherProject {
    std::filesystem::path file;
    Result<RenderMode> render_mode;  // or why the project cannot be read
};

/// Reads projects that shall be exported besides the open one, one after the other in the
/// background: their files contain whole plans, and network disks are slow. Main thread only.
class OtherProjects {
  public:
    explicit OtherProjects(std::function<void()> wake) : worker_(std::move(wake)) {}

    void read(const std::filesystem::path& project);
    /// Forgets all projects that have not been read yet.
    void cancel();
    /// The next project that has been read. To be called every frame.
    [[nodiscard]] std::optional<OtherProject> take();
    /// The file that is being read; empty: none.
    [[nodiscard]] std::filesystem::path reading() const {
        return waiting_.empty() ? std::filesystem::path() : waiting_.front();
    }

  private:
    void readNext();

    struct Answer {
        std::uint64_t question = 0;
        OtherProject project;
    };

    std::deque<std::filesystem::path> waiting_;  // the first is being read
    std::uint64_t question_ = 0;
    std::shared_ptr<LatestValue<Answer>> answers_ = std::make_shared<LatestValue<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
