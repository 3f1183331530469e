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

/// Writes preview images as PNG files in the background: exact values if the format can hold them,
/// otherwise the displayed colours. Main thread only.
class PictureSaver {
  public:
    explicit PictureSaver(std::function<void()> wake);
    /// Waits until all images are written.
    ~PictureSaver();

    void save(const std::filesystem::path& file, ui::PreviewImage image);
    /// The next unreported write error; nullopt if there is none.
    [[nodiscard]] std::optional<Error> takeError();

  private:
    struct Order {
        std::filesystem::path file;
        ui::PreviewImage image;
    };
    std::shared_ptr<ConcurrentQueue<Order>> orders_ = std::make_shared<ConcurrentQueue<Order>>();
    std::shared_ptr<ConcurrentQueue<Error>> failed_ = std::make_shared<ConcurrentQueue<Error>>();
    std::vector<Error> errors_;
    BackgroundWorker writer_;
};

}  // namespace dollytrack::editor
