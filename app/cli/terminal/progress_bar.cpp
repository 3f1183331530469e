#include "app/cli/terminal/progress_bar.h"

#include "engine/core/clean_text.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace dollytrack::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr auto kPlainLine = std::chrono::seconds(10);
constexpr int kBarWidth = 24;
// Below this fraction an estimate of the time left is too unstable.
constexpr double kEnoughToGuess = 0.02;

std::string timeLeft(double seconds) {
    const long s = std::lround(seconds);
    return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                     : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

struct ProgressBar::State {
    bool terminal = isatty(STDERR_FILENO) != 0;
    Clock::time_point begin = Clock::now();
    Clock::time_point last_shown = begin;
    bool open = false;

    ~State() { finish(); }

    void show(double fraction, const std::string& note) {
        const auto now = Clock::now();
        if (now - last_shown <
            (terminal ? Clock::duration(kRedraw) : Clock::duration(kPlainLine))) {
            return;
        }
        last_shown = now;
        const double spent = std::chrono::duration<double>(now - begin).count();
        const std::string left =
            fraction > kEnoughToGuess
                ? fmt::format(", {} left", timeLeft(spent / fraction * (1.0 - fraction)))
                : "";
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
