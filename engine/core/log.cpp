#include "engine/core/log.h"

#include "engine/core/clean_text.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <optional>
#include <utility>

namespace dollytrack::log {
namespace {

spdlog::level::level_enum spdlogLevel(Level level) {
    switch (level) {
        case Level::Debug:
            return spdlog::level::debug;
        case Level::Info:
            return spdlog::level::info;
        case Level::Warning:
            return spdlog::level::warn;
        case Level::Error:
            return spdlog::level::err;
    }
    return spdlog::level::info;
}

void writeToStderr(const Record& record) {
    static const auto logger = [] {
        auto made = std::make_shared<spdlog::logger>(
            "stderr", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
        made->set_pattern("%^%l%$: %v");
        made->set_level(spdlog::level::debug);
        return made;
    }();
    if (record.repeats > 1) {
        logger->log(spdlogLevel(record.level), "{}: {} ({} times)", record.subsystem,
                    record.message, record.repeats);
    } else {
        logger->log(spdlogLevel(record.level), "{}: {}", record.subsystem, record.message);
    }
}

struct State {
    std::mutex mutex;
    Sink sink = writeToStderr;
    Level level = Level::Info;
    std::optional<Record> last;  // written once already; repeats - 1 are pending
};

State& state() {
    static State the_state;
    return the_state;
}

void flushLocked(State& s) {
    if (s.last && s.last->repeats > 1) s.sink(*s.last);
    s.last.reset();
}

void write(Level level, std::string_view subsystem, std::string_view said) {
    State& s = state();
    const std::scoped_lock lock(s.mutex);
    if (level < s.level) return;
    // Messages quote untrusted names and values, and every sink shows or stores them.
    std::string message = cleanText(said);
    if (s.last && s.last->level == level && s.last->subsystem == subsystem &&
        s.last->message == message) {
        ++s.last->repeats;
        return;
    }
    flushLocked(s);
    s.last = Record{level, std::string(subsystem), std::move(message), 1};
    s.sink(*s.last);
}

}  // namespace

const char* name(Level level) {
    switch (level) {
        case Level::Debug:
            return "debug";
        case Level::Info:
            return "info";
        case Level::Warning:
            return "warning";
        case Level::Error:
            break;
    }
    return "error";
}

void debug(std::string_view subsystem, std::string_view message) {
    write(Level::Debug, subsystem, message);
}
void info(std::string_view subsystem, std::string_view message) {
    write(Level::Info, subsystem, message);
}
void warn(std::string_view subsystem, std::string_view message) {
    write(Level::Warning, subsystem, message);
}
void error(std::string_view subsystem, std::string_view message) {
    write(Level::Error, subsystem, message);
}

void setLevel(Level level) {
    const std::scoped_lock lock(state().mutex);
    state().level = level;
}

Sink setSink(Sink sink) {
    const std::scoped_lock lock(state().mutex);
    flushLocked(state());
    return std::exchange(state().sink, sink ? std::move(sink) : Sink(writeToStderr));
}

void flush() {
    const std::scoped_lock lock(state().mutex);
    flushLocked(state());
}

}  // namespace dollytrack::log
