#pragma once

#include "app/editor/files/thumbnail.h"
#include "engine/jobs/background_worker.h"
#include "render/gl/picture_texture.h"
#include "ui/panels/scene/start_panel.h"
#include "ui/viewport/render_thread.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// What the start screen shows of recent files: whether they exist, their dates and pictures. Files
/// are read and written in the background, because network disks are slow. Main thread only.
class RecentFiles {
  public:
    /// Keeps the pictures in `folder`.
    RecentFiles(std::filesystem::path folder, std::function<void()> wake);
    /// Waits until all pictures are written.
    ~RecentFiles();

    /// Stores the viewport's image as the picture of an open file.
    void keepPicture(const std::filesystem::path& file, const ui::ViewImage& image);

    /// What is known of the files, in their order. To be called every frame while they are shown.
    const std::vector<ui::RecentFile>& of(const std::vector<std::string>& paths);
    /// The files are not shown any more; they are read again before they are shown next.
    void hide();
    /// The result of the last call of of().
    [[nodiscard]] const std::vector<ui::RecentFile>& files() const { return files_; }
    /// Whether everything about the shown files is known.
    [[nodiscard]] bool ready() const { return ready_; }

  private:
    struct Order {
        std::filesystem::path file;
        int width = 0;
        int height = 0;
        std::vector<std::uint8_t> rgba;
    };
    struct Found {
        std::vector<ui::RecentFile> files;
        std::vector<Thumbnail> pictures;  // of each file
    };
    void work();

    std::filesystem::path folder_;
    std::vector<std::string> paths_;  // of the shown files; empty: none are shown
    std::vector<ui::RecentFile> files_;
    std::vector<gl::PictureTexture> textures_;
    bool ready_ = false;
    std::shared_ptr<ConcurrentQueue<Order>> orders_ = std::make_shared<ConcurrentQueue<Order>>();
    std::shared_ptr<LatestValue<Found>> found_ = std::make_shared<LatestValue<Found>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
