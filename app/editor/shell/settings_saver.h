#pragma once

#include "app/editor/shell/settings.h"
#include "engine/jobs/background_worker.h"

#include <optional>

namespace dollytrack::editor {

/// Writes the settings in the background shortly after each change, so that a killed editor loses
/// none. Main thread only.
class SettingsSaver {
  public:
    /// To be called every frame; writes changed settings soon after the last change. The first call
    /// only takes the settings as those on disk.
    void follow(const EditorSettings& settings);

    /// Drops unwritten changes and waits for a write in progress.
    void stop();

    /// Delay after the last change, since dragging a splitter changes the settings in every frame.
    static constexpr int kRest_ms = 300;

  private:
    std::optional<EditorSettings> handed_over_;
    BackgroundWorker writer_;
};

}  // namespace dollytrack::editor
