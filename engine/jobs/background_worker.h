#pragma once

#include "engine/jobs/job.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace dollytrack {

/// Runs one piece of work at a time on a thread of its own, for a window that must not wait. A
/// newer piece cancels the one that runs and replaces the one that waits, so a dragged slider never
/// builds a queue. Work sees copies or constant data and leaves its result in a LatestValue.
class BackgroundWorker {
  public:
    using Work = std::function<void(const JobContext&)>;
    using Clock = std::function<std::chrono::steady_clock::time_point()>;

    /// How long a piece may go on after a newer one has arrived: until it has run for `grace` in
    /// all, or for twice as long where it is near its end by then. Without grace it is cancelled at
    /// once. With it, a value that changes all the time still gets results.
    struct GracePeriod {
        std::chrono::milliseconds grace{0};
        double near_end = 0.7;  // fraction of its progress
    };

    struct State {
        bool busy = false;
        double fraction = 0.0;  // of the piece that runs
        std::string stage;
    };

    /// `on_change` is called from the worker's thread when a piece has ended, and at most ten times
    /// a second for its progress: to wake a window. Work that puts out a part of its result before
    /// it ends tells so itself.
    explicit BackgroundWorker(std::function<void()> on_change = {});
    BackgroundWorker(std::function<void()> on_change, GracePeriod grace_period,
                     Clock clock = std::chrono::steady_clock::now);
    /// Cancels and waits.
    ~BackgroundWorker();
    BackgroundWorker(const BackgroundWorker&) = delete;
    BackgroundWorker& operator=(const BackgroundWorker&) = delete;

    void start(Work work);
    void cancel();
    /// Cancels the piece that runs if a newer one waits: for work that has put out what matters.
    void cancelOutdated();
    /// Returns when nothing runs or waits.
    void finish();
    [[nodiscard]] State state() const;

  private:
    void loop();
    void cancelAfterGracePeriod();

    GracePeriod grace_period_;
    Clock clock_;
    std::chrono::steady_clock::time_point begun_;  // the piece that runs

    std::function<void()> on_change_;
    mutable std::mutex mutex_;
    std::condition_variable work_arrived_;
    std::condition_variable idle_;
    std::optional<Work> next_;
    std::shared_ptr<std::atomic<bool>> cancel_running_;
    State state_;
    bool stopping_ = false;
    std::thread thread_;
};

/// Hands the newest value from one thread to another.
template <class T>
class LatestValue {
  public:
    void put(T value) {
        const std::lock_guard lock(mutex_);
        value_ = std::move(value);
    }
    [[nodiscard]] std::optional<T> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(value_, std::nullopt);
    }

  private:
    std::mutex mutex_;
    std::optional<T> value_;
};

/// Hands every value from one thread to another, in order.
template <class T>
class ConcurrentQueue {
  public:
    void put(T value) {
        const std::lock_guard lock(mutex_);
        values_.push_back(std::move(value));
    }
    [[nodiscard]] std::vector<T> takeAll() {
        const std::lock_guard lock(mutex_);
        return std::exchange(values_, {});
    }

  private:
    std::mutex mutex_;
    std::vector<T> values_;
};

}  // namespace dollytrack
