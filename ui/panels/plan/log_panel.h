#pragma once

#include "engine/core/log.h"

#include <deque>
#include <mutex>
#include <string>

namespace dollytrack::ui {

/// The last 5000 log records, added from any thread; repeated messages are folded into one line
/// with a count.
class LogBuffer {
  public:
    void add(const log::Record& record);
    [[nodiscard]] std::deque<log::Record> records() const;
    void clear();
    /// Increases with every record, for automatic scrolling.
    [[nodiscard]] unsigned version() const;
    /// Number of different warnings and errors added so far.
    [[nodiscard]] unsigned warnings() const;

  private:
    static constexpr std::size_t kKept = 5000;
    mutable std::mutex mutex_;
    std::deque<log::Record> records_;
    unsigned version_ = 0;
    unsigned warnings_ = 0;
};

struct LogPanelState {
    std::string filter;
    int least_level = 1;  // log::Level
    unsigned seen_version = 0;
    unsigned seen_warnings = 0;  // LogBuffer::warnings() when the log was drawn last

    /// Number of warnings and errors since the log was drawn last.
    [[nodiscard]] unsigned unseenWarnings(const LogBuffer& buffer) const {
        return buffer.warnings() - seen_warnings;
    }
};

/// Draws the log with text filter, level filter, copy and clear.
void drawLogPanel(LogBuffer& buffer, LogPanelState& state);

}  // namespace dollytrack::ui
