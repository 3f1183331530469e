#include "app/python/bindings/work_thread.h"

#include "app/cli/command_line.h"
#include "app/python/bindings/arrays.h"
#include "engine/core/log.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace dollytrack::python {
namespace {

constexpr std::chrono::milliseconds kLookAround{50};  // interval for checking Ctrl-C and progress

/// Messages from the working thread to the waiting one.
struct News {
    std::mutex mutex;
    std::condition_variable changed;
    bool ended = false;
    bool has_progress = false;
    double fraction = 0.0;
    std::string stage;
    Status result;
};

/// Log records wait here for a thread that holds the GIL: engine threads must never wait for the
/// GIL while others wait for the log.
struct LogQueue {
    static constexpr std::size_t kMost = 10'000;
    std::mutex mutex;
    std::vector<log::Record> records;
};

LogQueue& logQueue() {
    static auto* const queue = new LogQueue;  // never destroyed: used until the interpreter's end
    return *queue;
}

void handOnLog() {
    log::flush();
    std::vector<log::Record> records;
    {
        const std::lock_guard lock(logQueue().mutex);
        records.swap(logQueue().records);
    }
    for (const log::Record& record : records) {
        constexpr int kPythonLevels[] = {10, 20, 30, 40};  // levels of Python's logging module
        const std::string count =
            record.repeats > 1 ? " (" + std::to_string(record.repeats) + " times)" : "";
        py::module_::import("dollytrack.arguments")
            .attr("log")(record.subsystem, kPythonLevels[static_cast<int>(record.level)],
                         textOf(record.message), count);
    }
}

/// The Python calls that are waiting.
struct RunningCalls {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<CancelFlag> flags;
};

RunningCalls& runningCalls() {
    static auto* const calls = new RunningCalls;  // never destroyed
    return *calls;
}

class RunningCall {
  public:
    explicit RunningCall(CancelFlag flag) : flag_(std::move(flag)) {
        const std::lock_guard lock(runningCalls().mutex);
        runningCalls().flags.push_back(flag_);
    }
    ~RunningCall() {
        const std::lock_guard lock(runningCalls().mutex);
        runningCalls().flags.erase(std::ranges::find(runningCalls().flags, flag_));
        runningCalls().changed.notify_all();
    }
    RunningCall(const RunningCall&) = delete;
    RunningCall& operator=(const RunningCall&) = delete;

  private:
    CancelFlag flag_;
};

JobContext contextOf(const std::shared_ptr<News>& news, const CancelFlag& cancel_flag) {
    return {cancel_flag, [news](double fraction, std::string_view stage) {
                const std::lock_guard lock(news->mutex);
                news->has_progress = true;
                news->fraction = fraction;
                news->stage = stage;
            }};
}

Status outcomeOf(const std::function<Status(const JobContext&)>& work, const JobContext& job) {
    try {
        return work(job);
    } catch (const std::exception& exception) {
        return tl::unexpected(cli::errorOf(exception));
    } catch (...) {
        return fail(ErrorCode::Failed, "unexpected failure");
    }
}

/// Periodic work of the waiting thread, with the GIL: signals, log, progress. Throws exceptions
/// raised by Python.
void pollPython(const py::object& progress, News& news) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    handOnLog();
    double fraction = 0.0;
    std::string stage;
    {
        const std::lock_guard lock(news.mutex);
        if (!std::exchange(news.has_progress, false)) return;
        fraction = news.fraction;
        stage = news.stage;
    }
    if (!progress.is_none()) progress(fraction, stage);
}

/// Raises an error in a process forked after the engine was used, which lacks the engine's threads.
void checkNotForked() {
    static std::atomic<int> used_by = 0;
    int nobody = 0;
    const int process = ::getpid();
    if (used_by.compare_exchange_strong(nobody, process) || nobody == process) return;
    raise({ErrorCode::Failed,
           "this process was forked after planning or rendering; use multiprocessing's 'spawn' "
           "start method instead.",
           {}});
}

}  // namespace

WorkThread::WorkThread()
    : process_(::getpid()), thread_(std::make_unique<std::thread>(&WorkThread::work, state_)) {}

WorkThread::~WorkThread() {
    if (process_ != ::getpid()) {
        (void)thread_.release();  // even detaching would access the missing thread
        return;
    }
    {
        const std::lock_guard lock(state_->mutex);
        state_->ends = true;
    }
    state_->changed.notify_one();
    thread_->join();
}

void WorkThread::post(std::function<void()> task) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->tasks.push_back(std::move(task));
    }
    state_->changed.notify_one();
}

void WorkThread::work(const std::shared_ptr<State>& state) {
    while (true) {
        std::unique_lock lock(state->mutex);
        state->changed.wait(lock, [&] { return state->ends || !state->tasks.empty(); });
        if (state->tasks.empty()) return;
        const std::function<void()> task = std::move(state->tasks.front());
        state->tasks.pop_front();
        lock.unlock();
        task();
    }
}

void waitFor(const py::object& progress, const std::function<Status(const JobContext&)>& work,
             WorkThread& thread, const CancelFlag& cancel_flag) {
    checkNotForked();
    const RunningCall running(cancel_flag);
    const auto news = std::make_shared<News>();
    thread.post([news, &work, job = contextOf(news, cancel_flag)] {
        Status result = outcomeOf(work, job);
        // Notified under the lock, because the waiting thread may then destroy these objects.
        const std::lock_guard lock(news->mutex);
        news->result = std::move(result);
        news->ended = true;
        news->changed.notify_one();
    });
    std::exception_ptr raised;
    bool ended = false;
    while (!ended) {
        {
            const py::gil_scoped_release release;
            std::unique_lock lock(news->mutex);
            ended = news->changed.wait_for(lock, kLookAround, [&] { return news->ended; });
        }
        if (raised) continue;
        try {
            pollPython(progress, *news);
        } catch (...) {
            raised = std::current_exception();
            cancel_flag->store(true);
        }
    }
    if (raised) std::rethrow_exception(raised);
    if (!news->result) raise(news->result.error());
}

void waitFor(const py::object& progress, const std::function<Status(const JobContext&)>& work,
             const CancelFlag& cancel_flag) {
    WorkThread thread;
    waitFor(progress, work, thread, cancel_flag);
}

void raise(const Error& error) {
    const py::object exception = py::module_::import("dollytrack.errors")
                                     .attr("error_of")(static_cast<int>(error.code),
                                                       textOf(error.message), textOf(error.where));
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
    throw py::error_already_set();
}

void stopCallsAtExit() {
    const auto stop = [process = ::getpid()] {
        if (::getpid() != process) return;  // the threads do not exist in a forked process
        const py::gil_scoped_release release;
        std::unique_lock lock(runningCalls().mutex);
        for (const CancelFlag& flag : runningCalls().flags) flag->store(true);
        runningCalls().changed.wait(lock, [] { return runningCalls().flags.empty(); });
    };
    py::module_::import("atexit").attr("register")(py::cpp_function(stop));
}

void logToPython() {
    log::setSink([](const log::Record& record) {
        const std::lock_guard lock(logQueue().mutex);
        if (logQueue().records.size() < LogQueue::kMost) logQueue().records.push_back(record);
    });
}

}  // namespace dollytrack::python
