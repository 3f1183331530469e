#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace dollytrack::python {

/// A thread that runs posted tasks in order. An OpenGL context belongs to one thread, so it is
/// created, used and destroyed by tasks of the same WorkThread.
class WorkThread {
  public:
    WorkThread();
    /// Runs the remaining tasks, then joins. Does nothing in a forked process, which has no copy of
    /// the thread.
    ~WorkThread();
    WorkThread(const WorkThread&) = delete;
    WorkThread& operator=(const WorkThread&) = delete;

    void post(std::function<void()> task);

  private:
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<std::function<void()>> tasks;
        bool ends = false;
    };
    static void work(const std::shared_ptr<State>& state);

    std::shared_ptr<State> state_ = std::make_shared<State>();
    int process_;
    std::unique_ptr<std::thread> thread_;
};

/// Cancellation flag shared by the calls of one operation.
using CancelFlag = std::shared_ptr<std::atomic<bool>>;

/// Runs `work` on the thread with the GIL released and waits for it. Ctrl-C cancels the work.
/// `progress` (None, or a callable that takes fraction and stage) and Python's loggers are called
/// on the waiting thread. A Python exception raised meanwhile cancels the work and is rethrown when
/// it has ended. `work` must not use Python. Raises the error of `work`.
void waitFor(const pybind11::object& progress, const std::function<Status(const JobContext&)>& work,
             WorkThread& thread, const CancelFlag& cancel_flag);

/// The same on a new thread. The flag is set when the work is to stop.
void waitFor(const pybind11::object& progress, const std::function<Status(const JobContext&)>& work,
             const CancelFlag& cancel_flag = std::make_shared<std::atomic<bool>>(false));

/// Raises an error as the matching exception of dollytrack.errors.
[[noreturn]] void raise(const Error& error);

/// Registers an exit handler that cancels running calls and waits for them: daemon threads must not
/// return to a finalized interpreter.
void stopCallsAtExit();

/// Redirects the engine's log to Python's loggers "dollytrack.SUBSYSTEM".
void logToPython();

}  // namespace dollytrack::python
