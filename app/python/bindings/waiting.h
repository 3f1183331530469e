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

/// A thread that runs the tasks posted to it, one after the other. An OpenGL context, which belongs
/// to one thread, is made, used and destroyed by tasks of the same WorkThread.
class WorkThread {
  public:
    WorkThread();
    /// Runs the tasks that are left, then joins. Does nothing in a forked process: the thread was
    /// not copied.
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

/// What can be stopped: shared by the calls that belong to one piece of work.
using CancelFlag = std::shared_ptr<std::atomic<bool>>;

/// Does work on the thread, with the GIL released, and waits for it: Ctrl-C stops the work,
/// `progress` (None, or called with a fraction and a stage) is called on the waiting thread, and so
/// are Python's loggers with what the engine logs. Whatever Python raises meanwhile stops the work
/// and is raised when it has ended. The work never sees Python. Raises the error of the work.
void waitFor(const pybind11::object& progress, const std::function<Status(const JobContext&)>& work,
             WorkThread& thread, const CancelFlag& cancel_flag);

/// The same on a thread of its own. The flag is set when the work is to stop.
void waitFor(const pybind11::object& progress, const std::function<Status(const JobContext&)>& work,
             const CancelFlag& cancel_flag = std::make_shared<std::atomic<bool>>(false));

/// Raises the error as an exception of dollytrack.errors.
[[noreturn]] void raise(const Error& error);

/// When Python ends, calls of daemon threads are stopped and waited for: such a thread must not
/// come back to an interpreter that is gone.
void stopCallsAtExit();

/// From now on the engine's log goes to Python's loggers "dollytrack.SUBSYSTEM".
void logToPython();

}  // namespace dollytrack::python
