#include "app/editor/shell/settings_saver.h"

#include "engine/core/log.h"

#include <chrono>
#include <thread>

namespace dollytrack::editor {

void SettingsSaver::follow(const EditorSettings& settings) {
    if (handed_over_ == settings) return;
    const bool first = !handed_over_;
    handed_over_ = settings;
    // The first settings are as read: a second editor must not overwrite the first one's changes.
    if (first) return;
    writer_.start([settings](const JobContext& job) {
        constexpr int kStep_ms = 20;
        for (int waited = 0; waited < kRest_ms && !job.cancelled(); waited += kStep_ms) {
            std::this_thread::sleep_for(std::chrono::milliseconds(kStep_ms));
        }
        if (job.cancelled()) return;  // newer settings are waiting
        if (const Status saved = saveSettings(settings); !saved) {
            log::warn("editor", describe(saved.error()));
        }
    });
}

void SettingsSaver::stop() {
    writer_.cancel();
    writer_.finish();
}

}  // namespace dollytrack::editor
