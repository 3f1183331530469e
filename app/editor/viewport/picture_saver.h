#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/core/result.h"
#include "engine/jobs/background_worker.h"
#include "ui/viewport/render_thread.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::editor {

/// Writes pictures of the camera as PNG files in the background: exact values where the format
/// holds them, else the picture one sees. Main thread only.
class PictureSaver {
  public:
    explicit PictureSaver(std::function<void()> wake);
    /// Waits until all is written.
    ~PictureSaver();

    void save(const std::filesystem::path& file, ui::PreviewImage image);
    /// The next picture that could not be written.
    [[nodiscard]] std::optional<Error> takeError();

  private:
    struct Order {
        std::filesystem::path file;
        ui::PreviewImage image;
    };
    std::shared_ptr<Tray<Order>> orders_ = std::make_shared<Tray<Order>>();
    std::shared_ptr<Tray<Error>> failed_ = std::make_shared<Tray<Error>>();
    std::vector<Error> errors_;
    BackgroundWorker writer_;
};

}  // namespace dollytrack::editor
