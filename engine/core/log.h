#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace dollytrack::log {

enum class Level { Debug, Info, Warning, Error };

/// "debug", "info", "warning", "error".
[[nodiscard]] const char* name(Level level);

struct Record {
    Level level = Level::Info;
    std::string subsystem;  // "import", "planning"
    std::string message;
    int repeats = 1;  // how often the same message came in a row
};

void debug(std::string_view subsystem, std::string_view message);
void info(std::string_view subsystem, std::string_view message);
void warn(std::string_view subsystem, std::string_view message);
void error(std::string_view subsystem, std::string_view message);

/// Messages below this level are dropped. Default: Info.
void setLevel(Level level);

/// Replaces the sink (default: stderr, so that stdout stays free for results); returns the one
/// before. Calls are serialised; a message equal to the one before it is counted, not repeated.
using Sink = std::function<void(const Record&)>;
Sink setSink(Sink sink);

/// Writes how often the last message was repeated, if that was not written yet. Called at the end
/// of a program.
void flush();

}  // namespace dollytrack::log
