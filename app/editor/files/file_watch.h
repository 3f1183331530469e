#pragma once

#include "app/editor/files/known_files.h"
#include "engine/jobs/background_worker.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace dollytrack::editor {

/// Detects that another program has changed the open project's file. Checks in the background about
/// once a second. Main thread only.
class FileWatch {
  public:
    FileWatch(std::shared_ptr<const KnownFiles> known, std::function<void()> wake);

    /// To be called every frame; an empty path watches nothing.
    void look(const std::filesystem::path& file);
    /// Resets the state after the file was read or written here.
    void beginAnew();
    /// Whether the file was changed by another program and this was not dismissed.
    [[nodiscard]] bool changed() const { return changed_ && !dismissed_; }
    /// Dismisses the change; the next change is reported again.
    void dismiss() { dismissed_ = true; }

    static constexpr std::chrono::milliseconds kInterval{1000};

  private:
    /// Time and size; the content is read again only if they change.
    struct Stamp {
        std::filesystem::file_time_type written;
        std::uintmax_t bytes = 0;
        bool operator==(const Stamp&) const = default;
    };
    struct Seen {
        std::uint64_t round = 0;
        Stamp stamp;
        bool changed = false;
    };

    std::shared_ptr<const KnownFiles> known_;
    std::function<void()> wake_;
    std::chrono::steady_clock::time_point last_look_;
    std::uint64_t round_ = 0;  // increases with each reset; older answers are ignored
    std::optional<Stamp> stamp_;
    bool changed_ = false;
    bool dismissed_ = false;
    std::shared_ptr<LatestValue<Seen>> seen_ = std::make_shared<LatestValue<Seen>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
