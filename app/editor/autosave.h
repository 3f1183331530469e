#pragma once

#include "engine/io/project_file.h"
#include "engine/jobs/background_worker.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Work of an editor that ended without closing its project.
struct LostWork {
    std::filesystem::path file;     // the copy, itself a project
    std::filesystem::path project;  // where it was saved before; empty: never
    std::string scene;              // name of its scene file
    std::string when;               // local time, for people
};

/// Keeps a copy of unsaved work in the state folder, written whole in the background, so that a
/// crash costs at most the interval.
class Autosave {
  public:
    /// The project that a copy's work belongs to.
    struct Origin {
        std::filesystem::path project;  // empty: never saved
        std::string sha256;             // of that file when the work on it began
    };

    Autosave();
    ~Autosave();

    /// Whether it is time to hand over a new copy.
    [[nodiscard]] bool isDue() const;
    void store(io::ProjectFile snapshot, const Origin& origin);
    /// Copies handed over so far.
    [[nodiscard]] int count() const { return count_; }
    /// Removes the copy that this work was restored from, once the new one is written.
    void forgetAfterwards(const LostWork& work) { restored_from_ = work.file; }
    /// The work is saved, or thrown away by its owner: the copy goes.
    void discard();

    /// Copies whose editor no longer runs, newest first.
    [[nodiscard]] static std::vector<LostWork> findLost();
    static void forget(const LostWork& work);
    /// Takes our notes out of a copy's other sections.
    [[nodiscard]] static Origin takeOrigin(nlohmann::json& others);

    static constexpr std::chrono::seconds kInterval{5};

  private:
    std::filesystem::path file_;
    std::filesystem::path restored_from_;
    std::chrono::steady_clock::time_point last_;
    int count_ = 0;
    BackgroundWorker writer_;
};

}  // namespace dollytrack::editor
