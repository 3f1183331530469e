#include "app/cli/terminal/progress_bar.h"

#include "engine/core/clean_text.h"
#include "engine/jobs/progress_estimate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

namespace dollytrack::cli {
namespace {

using Clock = ProgressEstimate::Clock;

constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr auto kPlainLine = std::chrono::seconds(10);
constexpr int kBarWidth = 24;

std::string timeLeft(double seconds) {
    const long s = std::lround(seconds);
    return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                     : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

struct ProgressBar::State {
    bool terminal = isatty(STDERR_FILENO) != 0;
    Clock::time_point last_shown = Clock::now();
    ProgressEstimate estimate{last_shown};
    bool open = false;

    ~State() { finish(); }

    void show(double reported, const std::string& note) {
        const auto now = Clock::now();
        const double fraction = estimate.add(reported, now);
        if (now - last_shown <
            (terminal ? Clock::duration(kRedraw) : Clock::duration(kPlainLine))) {
            return;
        }
        last_shown = now;
        const std::optional<double> seconds = estimate.secondsLeft(now);
        const std::string left = seconds ? fmt::format(", {} left", timeLeft(*seconds)) : "";
        if (terminal) {
            const int full = static_cast<int>(std::lround(fraction * kBarWidth));
            fmt::print(stderr, "\r[{:<{}}] {:3.0f} %  {}{}\033[K", std::string(full, '='),
                       kBarWidth, fraction * 100.0, note, left);
            std::fflush(stderr);
            open = true;
        } else {
            fmt::print(stderr, "{:3.0f} %  {}{}\n", fraction * 100.0, note, left);
        }
    }

    void finish() {
        if (open) fmt::print(stderr, "\r\033[K");
        open = false;
    }
};

ProgressBar::ProgressBar() : state_(std::make_shared<State>()) {}

void ProgressBar::show(double fraction, const std::string& note) const {
    state_->show(fraction, cleanText(note));
}

void ProgressBar::finish() const {
    state_->finish();
}

JobContext::Progress ProgressBar::callback() const {
    return [state = state_](double fraction, std::string_view stage) {
        state->show(fraction, cleanText(stage));
    };
}

}  // namespace dollytrack::cli
