#include "engine/jobs/background_worker.h"

#include "engine/core/log.h"

#include <chrono>
#include <exception>

namespace dollytrack {
namespace {

// More frequent progress notifications would take processor time from the work.
constexpr auto kProgressEvery = std::chrono::milliseconds(100);

}  // namespace

BackgroundWorker::BackgroundWorker(std::function<void()> on_change)
    : BackgroundWorker(std::move(on_change), GracePeriod{}) {}

BackgroundWorker::BackgroundWorker(std::function<void()> on_change, GracePeriod grace_period,
                                   Clock clock)
    : grace_period_(grace_period),
      clock_(std::move(clock)),
      on_change_(std::move(on_change)),
      thread_([this] { loop(); }) {}

BackgroundWorker::~BackgroundWorker() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        next_.reset();
        if (cancel_running_) cancel_running_->store(true);
    }
    work_arrived_.notify_one();
    thread_.join();
}

void BackgroundWorker::start(Work work) {
    {
        const std::lock_guard lock(mutex_);
        next_ = std::move(work);
        cancelAfterGracePeriod();
        state_.busy = true;
    }
    work_arrived_.notify_one();
}

/// Cancels an outdated task whose grace period is over. The mutex must be held.
void BackgroundWorker::cancelAfterGracePeriod() {
    if (!cancel_running_ || !next_) return;
    const auto run_for = clock_() - begun_;
    const bool is_near_end = state_.fraction >= grace_period_.near_end;
    if (run_for >= (is_near_end ? 2 : 1) * grace_period_.grace) cancel_running_->store(true);
}

void BackgroundWorker::cancelOutdated() {
    const std::lock_guard lock(mutex_);
    if (cancel_running_ && next_) cancel_running_->store(true);
}

void BackgroundWorker::cancel() {
    const std::lock_guard lock(mutex_);
    next_.reset();
    if (cancel_running_) cancel_running_->store(true);
    if (!cancel_running_) state_ = {};
}

void BackgroundWorker::finish() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return !next_ && !cancel_running_; });
}

BackgroundWorker::State BackgroundWorker::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void BackgroundWorker::loop() {
    std::unique_lock lock(mutex_);
    while (true) {
        work_arrived_.wait(lock, [this] { return stopping_ || next_.has_value(); });
        if (stopping_) return;
        const Work work = std::move(*next_);
        next_.reset();
        const auto cancelled = std::make_shared<std::atomic<bool>>(false);
        cancel_running_ = cancelled;
        begun_ = clock_();
        state_ = {true, 0.0, {}};
        lock.unlock();
        std::chrono::steady_clock::time_point told;  // the first notification is sent at once
        const JobContext job(cancelled, [&](double fraction, std::string_view stage) {
            {
                const std::lock_guard guard(mutex_);
                if (cancel_running_ == cancelled) state_ = {true, fraction, std::string(stage)};
                cancelAfterGracePeriod();
            }
            const auto now = std::chrono::steady_clock::now();
            if (now - told < kProgressEvery) return;
            told = now;
            if (on_change_) on_change_();
        });
        try {
            work(job);
        } catch (const std::exception& error) {
            // Usually out of memory; the next task may need less.
            log::error("jobs", std::string("unexpected failure: ") + error.what());
        }
        lock.lock();
        cancel_running_.reset();
        if (!next_) state_ = {};
        idle_.notify_all();
        lock.unlock();
        if (on_change_) on_change_();
        lock.lock();
    }
}

}  // namespace dollytrack
