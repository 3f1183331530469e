#include "app/cli/terminal/progress_lines.h"

#include "engine/core/clean_lines.h"
#include "engine/jobs/progress_estimate.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace dollytrack::cli {
namespace {

using Clock = ProgressEstimate::Clock;
using Json = nlohmann::ordered_json;

constexpr auto kBetween = std::chrono::milliseconds(100);

/// One call per line, so that lines of several threads do not mix.
void writeLine(const Json& json) {
    const std::string line =
        cleanLines(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
}

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Rounds to three decimals.
double rounded(double value) {
    return std::round(value * 1000.0) / 1000.0;
}

const char* nameOf(ErrorCode code) {
    switch (code) {
        case ErrorCode::Usage:
            return "usage";
        case ErrorCode::BadInput:
            return "bad_input";
        case ErrorCode::NoOpenGl:
            return "no_opengl";
        case ErrorCode::CannotWrite:
            return "cannot_write";
        case ErrorCode::Cancelled:
            return "cancelled";
        case ErrorCode::Failed:
            break;
    }
    return "failed";
}

}  // namespace

struct ProgressLines::State {
    Clock::time_point begin = Clock::now();
    ProgressEstimate estimate{begin};
    std::optional<Clock::time_point> last_line;
    int frames = 0;
    int frames_done = 0;
    int frames_found = 0;  // frames that a resumed export had finished; not part of the rate
    Clock::time_point frames_begin;

    void addFrames(int done, int total) {
        if (frames == 0) {
            frames_found = done;
            frames_begin = Clock::now();
        }
        frames = total;
        frames_done = done;
    }

    void show(double reported, std::string_view stage) {
        const double fraction = estimate.add(reported);
        if (last_line && Clock::now() - *last_line < kBetween) return;
        last_line = Clock::now();
        Json line = {{"stage", stage}, {"fraction", rounded(fraction)}};
        if (frames > 0) {
            line["frames_done"] = frames_done;
            line["frames"] = frames;
        }
        const double spent = frames > 0 ? secondsSince(frames_begin) : 0.0;
        if (frames_done > frames_found && spent > 0.0) {
            const double rate = (frames_done - frames_found) / spent;
            line["frames_per_s"] = rounded(rate);
            line["seconds_left"] = rounded((frames - frames_done) / rate);
        } else if (const auto left = estimate.secondsLeft(); left && frames == 0) {
            line["seconds_left"] = rounded(*left);
        }
        writeLine(line);
    }
};

ProgressLines::ProgressLines() : state_(std::make_shared<State>()) {}

JobContext ProgressLines::context(std::shared_ptr<const std::atomic<bool>> cancel_flag) const {
    return {
        std::move(cancel_flag),
        [state = state_](double fraction, std::string_view stage) { state->show(fraction, stage); },
        [state = state_](int done, int total) { state->addFrames(done, total); }};
}

log::Sink ProgressLines::logSink() {
    return [](const log::Record& record) {
        writeLine({{"log",
                    {{"level", log::name(record.level)},
                     {"subsystem", record.subsystem},
                     {"message", record.message},
                     {"repeats", record.repeats}}}});
    };
}

void ProgressLines::finish(int exit_code) const {
    Json line = {{"done", true},
                 {"exit_code", exit_code},
                 {"seconds", rounded(secondsSince(state_->begin))}};
    if (state_->frames > 0) {
        line["frames_done"] = state_->frames_done;
        line["frames"] = state_->frames;
    }
    writeLine(line);
}

void ProgressLines::fail(const Error& error, int exit_code) {
    writeLine({{"error",
                {{"code", nameOf(error.code)},
                 {"exit_code", exit_code},
                 {"message", error.message},
                 {"where", error.where}}}});
}

}  // namespace dollytrack::cli
