#pragma once

#include "engine/jobs/background_worker.h"
#include "render/gl/picture_texture.h"
#include "ui/panels/scene/image_viewer.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// An image file shown in the window: read in the background, then uploaded as a texture of the
/// window's context. Main thread only.
class PictureFile {
  public:
    explicit PictureFile(std::function<void()> wake);
    ~PictureFile();

    void show(const std::filesystem::path& file);
    void close();
    [[nodiscard]] bool isOpen() const { return !file_.empty(); }
    [[nodiscard]] ui::ImageViewerView view();

  private:
    struct Pixels {
        int width = 0;
        int height = 0;
        std::vector<std::uint8_t> rgba;  // empty: the file cannot be read
    };
    std::filesystem::path file_;
    gl::PictureTexture texture_;
    std::string message_;
    std::shared_ptr<LatestValue<Pixels>> read_ = std::make_shared<LatestValue<Pixels>>();
    BackgroundWorker reader_;
};

}  // namespace dollytrack::editor
