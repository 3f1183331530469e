#pragma once

#include "app/project/project_reader.h"
#include "engine/camera/picture_params.h"
#include "engine/core/result.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

namespace dollytrack::editor {

/// Another project that was read to be exported.
struct OtherProject {
    std::filesystem::path file;
    Result<RenderMode> render_mode;  // or why the project cannot be read
};

/// Reads projects that shall be exported besides the open one, one after the other in the
/// background. Main thread only.
class OtherProjects {
  public:
    explicit OtherProjects(std::function<void()> wake) : reader_(std::move(wake)) {}

    void read(const std::filesystem::path& project);
    /// Forgets all projects that have not been read yet.
    void cancel();
    /// The next project that has been read. To be called every frame.
    [[nodiscard]] std::optional<OtherProject> take();
    /// The file that is being read; empty: none.
    [[nodiscard]] const std::filesystem::path& reading() const { return reader_.reading(); }

  private:
    void readNext();

    std::deque<std::filesystem::path> waiting_;  // the first is being read
    ProjectReader<RenderMode> reader_;
};

}  // namespace dollytrack::editor
