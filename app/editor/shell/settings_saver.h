#pragma once

#include "app/editor/shell/settings.h"
#include "engine/jobs/background_worker.h"

#include <optional>

namespace dollytrack::editor {

/// Writes the settings a moment after they last changed, in the background: an editor that is
/// killed has lost none. Main thread only.
class SettingsSaver {
  public:
    /// Once a frame. What the file has already is not written again.
    void follow(const EditorSettings& settings);

    /// What was not written yet is not; nothing is being written any more.
    void stop();

    /// A splitter being dragged changes them with every frame; it is written when it rests.
    static constexpr int kRest_ms = 300;

  private:
    std::optional<EditorSettings> handed_over_;
    BackgroundWorker writer_;
};

}  // namespace dollytrack::editor
