#pragma once

#include "engine/core/log.h"

#include <cstddef>
#include <deque>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// The last 5000 log records, added from any thread; repeated messages are folded into one line
/// with a count.
class LogBuffer {
  public:
    void add(const log::Record& record);
    [[nodiscard]] std::deque<log::Record> records() const;
    void clear();
    /// Increases with every change.
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

/// Indices of rows: `first` to one before `end`.
struct RowRange {
    std::size_t first = 0;
    std::size_t end = 0;
};

/// The rows of a list that reach into the range between two heights. `bottoms` are the lower ends
/// of all rows, from the top of the list; all in px.
[[nodiscard]] RowRange rowsBetween(std::span<const float> bottoms, float top, float bottom);

/// The records that pass the filters, and their heights in the list. They are kept between window
/// frames, because wrapping thousands of messages takes milliseconds.
struct LogRows {
    std::vector<log::Record> records;
    std::vector<float> bottoms;  // see rowsBetween(); with the gap below
    std::size_t all = 0;         // records in the log, shown or not
    // What the records and the heights were made from.
    unsigned version = 0;
    std::string filter;
    int least_level = 0;
    float width = 0.0F;
    float font_size = 0.0F;
};

struct LogPanelState {
    std::string filter;
    int least_level = 1;  // log::Level
    LogRows rows;
    unsigned seen_warnings = 0;  // LogBuffer::warnings() when the log was drawn last

    /// Number of warnings and errors since the log was drawn last.
    [[nodiscard]] unsigned unseenWarnings(const LogBuffer& buffer) const {
        return buffer.warnings() - seen_warnings;
    }
};

/// Draws the log with text filter, level filter, copy and clear.
void drawLogPanel(LogBuffer& buffer, LogPanelState& state);

}  // namespace dollytrack::ui
