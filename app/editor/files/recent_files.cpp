#include "app/editor/files/recent_files.h"

#include "app/editor/files/local_time.h"
#include "engine/core/log.h"

#include <algorithm>
#include <utility>

namespace dollytrack::editor {
namespace {

namespace fs = std::filesystem;

/// The name and folder in the path; the disk is not read.
ui::RecentFile named(const std::string& path) {
    ui::RecentFile file;
    file.path = path;
    file.name = fs::path(path).filename().string();
    file.folder = fs::path(path).parent_path().string();
    return file;
}

void lookAt(ui::RecentFile& file) {
    std::error_code error;
    file.missing = !fs::exists(file.path, error) && !error;
    if (file.missing) return;
    const fs::file_time_type written = fs::last_write_time(file.path, error);
    constexpr std::size_t kToMinutes = 16;
    if (!error) file.date = localTime(written).substr(0, kToMinutes);
}

}  // namespace

RecentFiles::RecentFiles(fs::path folder, std::function<void()> wake)
    : folder_(std::move(folder)), worker_(std::move(wake)) {}

RecentFiles::~RecentFiles() {
    worker_.finish();
}

void RecentFiles::keepPicture(const fs::path& file, const ui::ViewImage& image) {
    orders_->put({file, image.width, image.height, image.rgba});
    work();
}

void RecentFiles::work() {
    // A newer task replaces a waiting one, so each task takes all pictures and reads all files.
    worker_.start([orders = orders_, found = found_, folder = folder_,
                   paths = paths_](const JobContext& job) {
        for (const Order& order : orders->takeAll()) {
            const Thumbnail picture = thumbnailOf(order.width, order.height, order.rgba);
            if (picture.rgba.empty()) continue;
            const Status written = writeThumbnail(thumbnailFile(folder, order.file), picture);
            if (!written) log::debug("editor", describe(written.error()));
        }
        Found now;
        for (const std::string& path : paths) {
            if (job.cancelled()) return;
            now.files.push_back(named(path));
            lookAt(now.files.back());
            now.pictures.push_back(readThumbnail(thumbnailFile(folder, path)));
        }
        found->put(std::move(now));
    });
}

const std::vector<ui::RecentFile>& RecentFiles::of(const std::vector<std::string>& paths) {
    if (paths != paths_) {
        paths_ = paths;
        ready_ = paths.empty();
        // Known pictures stay until the files have been read again.
        std::vector<ui::RecentFile> files;
        for (const std::string& path : paths) {
            const auto known = std::ranges::find(files_, path, &ui::RecentFile::path);
            files.push_back(known != files_.end() ? *known : named(path));
        }
        files_ = std::move(files);
        work();
    }
    std::optional<Found> found = found_->take();
    const bool current =
        found && std::ranges::equal(found->files, paths_, {}, &ui::RecentFile::path);
    if (!current) return files_;
    files_ = std::move(found->files);
    textures_.clear();
    textures_.resize(files_.size());
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (found->pictures[i].rgba.empty()) continue;
        textures_[i].upload(Thumbnail::kWidth, Thumbnail::kHeight, found->pictures[i].rgba);
        files_[i].texture = textures_[i].get();
    }
    ready_ = true;
    return files_;
}

void RecentFiles::hide() {
    paths_.clear();
    files_.clear();
    textures_.clear();
    ready_ = false;
}

}  // namespace dollytrack::editor
