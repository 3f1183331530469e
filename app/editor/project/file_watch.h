#pragma once

#include "app/editor/project/known_files.h"
#include "engine/jobs/background_worker.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace dollytrack::editor {

/// Notices that another program has written the open project's file. Looks in the background about
/// once a second. Main thread only.
class FileWatch {
  public:
    FileWatch(std::shared_ptr<const KnownFiles> known, std::function<void()> wake);

    /// Once a frame; an empty path: there is nothing to watch.
    void look(const std::filesystem::path& file);
    /// The file was read or written here: what was seen of it before says nothing any more.
    void beginAnew();
    /// Whether the file holds something else than what is known here, and nobody was told.
    [[nodiscard]] bool changed() const { return changed_ && !dismissed_; }
    /// It was seen: says nothing until the file changes once more.
    void dismiss() { dismissed_ = true; }

    static constexpr std::chrono::milliseconds kInterval{1000};

  private:
    /// Cheap to ask for. When it is the same, the content is not read again.
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
    std::uint64_t round_ = 0;  // rises when what is known changes
    std::optional<Stamp> stamp_;
    bool changed_ = false;
    bool dismissed_ = false;
    std::shared_ptr<Outbox<Seen>> seen_ = std::make_shared<Outbox<Seen>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
