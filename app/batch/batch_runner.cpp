#include "app/batch/batch_runner.h"

#include "app/batch/batch_folder.h"
#include "app/batch/log_end.h"
#include "app/cli/command_line.h"
#include "app/process/child_process.h"
#include "engine/core/clean_text.h"
#include "engine/core/log.h"
#include "engine/core/program_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <list>
#include <numeric>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>

namespace dollytrack::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kDataset = "dataset";
constexpr const char* kOutput = "metrics.json";
constexpr const char* kLog = "log.txt";
constexpr auto kLook = std::chrono::milliseconds(20);
// Time for an export to finish its current frames after a stop signal.
constexpr auto kGrace = std::chrono::seconds(10);

bool datasetsAreThere(const JobResult& result, const fs::path& folder) {
    return std::all_of(result.datasets.begin(), result.datasets.end(), [&](const auto& one) {
        std::error_code error;
        return fs::exists(folder / one.folder / "dataset.json", error);
    });
}

/// Whether the job's folder may contain finished frames for a resumed run. Runs refused for usage
/// or bad input would be refused again.
bool canGoOn(const JobResult& result) {
    if (result.state == JobState::NotRun) return false;
    return result.state != JobState::Failed ||
           (result.exit_code != cli::kUsage && result.exit_code != cli::kBadInput);
}

/// The last message of the program, from the end of its log.
std::string lastWords(const fs::path& log) {
    constexpr std::size_t kEnough = 4096;
    constexpr std::string_view kOurs = "dollytrack: ";
    std::istringstream file(endOf(log, kEnough));
    std::string line;
    std::string last;
    while (std::getline(file, line)) {
        if (line.starts_with(kOurs)) {
            last = line.substr(kOurs.size());
        } else if (!line.empty() && !line.starts_with("Run with --help")) {
            last = line;
        }
    }
    return cleanText(last);
}

std::string signalText(int signal) {
    const char* text = ::sigdescr_np(signal);
    return fmt::format("it was ended by signal {} ({}){}", signal, text != nullptr ? text : "?",
                       signal == SIGKILL ? ", as the system does when memory runs out" : "");
}

std::string resultText(const JobResult& result) {
    std::string text = name(result.state);
    if (result.state == JobState::Done) {
        const auto frames = result.metrics.find("exported_frames");
        if (frames != result.metrics.end()) text += fmt::format(", {} frames", frames->get<int>());
        const auto well = result.metrics.find("well_captured_rate");
        if (well != result.metrics.end()) {
            text += fmt::format(", {:.1f} % well captured", 100.0 * well->get<double>());
        }
    } else {
        text += ": " + result.message;
    }
    return fmt::format("{}, {:.1f} s", text, result.seconds);
}

struct Running {
    std::size_t index = 0;
    ChildProcess process;
    JobLock lock;
    JobResult result;
    double seconds_before = 0.0;  // time of the earlier runs that this one resumes
    Clock::time_point begin;
    std::optional<Clock::time_point> kill_at;
    JobState stopped_as = JobState::Crashed;
};

class Runner {
  public:
    Runner(const std::vector<Job>& jobs, const RunSettings& settings, const JobContext& job)
        : jobs_(jobs), settings_(settings), job_(job), results_(jobs.size()) {}

    std::vector<JobResult> run() {
        std::vector<std::size_t> all(jobs_.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        runThese(all);
        // Only after all own jobs have ended, so that two batches never wait for each other. Of
        // several batches on the same jobs, the last to end finds all of them done.
        looks_last_ = true;
        runThese(std::exchange(busy_, {}));
        return std::move(results_);
    }

  private:
    void runThese(const std::vector<std::size_t>& indices) {
        auto next = indices.begin();
        job_.reportItems(finished_, static_cast<int>(jobs_.size()));
        while (next != indices.end() || !running_.empty()) {
            const bool stop = job_.cancelled();
            if (stop && running_.empty()) break;
            while (!stop && next != indices.end() &&
                   static_cast<int>(running_.size()) < settings_.parallel) {
                begin(*next++);
            }
            for (auto it = running_.begin(); it != running_.end();) {
                it = look(*it, stop) ? running_.erase(it) : std::next(it);
            }
            // Reported in every round, because the progress display also shows the elapsed time.
            job_.reportItems(finished_, static_cast<int>(jobs_.size()));
            if (!running_.empty()) std::this_thread::sleep_for(kLook);
        }
        // After a cancellation, jobs that were not reached take their stored results.
        for (; next != indices.end(); ++next) {
            const auto resume = resumeStateOf(jobs_[*next], settings_);
            if (resume && resume->action == ResumeState::Action::None) {
                results_[*next] = resume->found;
            }
        }
    }

    [[nodiscard]] fs::path folderOf(std::size_t index) const {
        return settings_.folder / jobs_[index].name;
    }

    void begin(std::size_t index) {
        if (const Status status = tryToBegin(index); !status) {
            JobResult& result = results_[index];
            result.state = JobState::Failed;
            result.exit_code =
                status.error().code == ErrorCode::CannotWrite ? cli::kCannotWrite : cli::kBadInput;
            result.message = describe(status.error());
            keepRefusal(index);
            finish(index);
        }
    }

    /// Stores the refusal for merging elsewhere, unless an earlier run left a result.
    void keepRefusal(std::size_t index) {
        JobResult& result = results_[index];
        result.command = jobs_[index].command;
        result.arguments = jobs_[index].arguments;
        result.version = settings_.version;
        result.ran_now = true;
        if (readResult(folderOf(index)).state != JobState::NotRun || !batch_) return;
        const Result<GuardedFolder> folder = batch_->makeWithin(jobs_[index].name);
        const Status kept =
            folder ? writeResult(*folder, result) : Status(tl::unexpected(folder.error()));
        if (!kept) log::debug("batch", describe(kept.error()));
    }

    Status tryToBegin(std::size_t index) {
        const Job& job = jobs_[index];
        if (!batch_) return tl::unexpected(batch_.error());
        Result<JobLock> lock = JobLock::take(*batch_, job.name);
        if (!lock) return tl::unexpected(std::move(lock.error()));
        if (!lock->isOurs()) {
            if (!looks_last_) {
                busy_.push_back(index);
                return {};
            }
            results_[index].state = JobState::Busy;
            results_[index].message = "another batch is running this job";
            finish(index);
            return {};
        }
        Result<ResumeState> resume = resumeStateOf(job, settings_);
        if (!resume) return tl::unexpected(std::move(resume.error()));
        if (resume->action == ResumeState::Action::None) {
            results_[index] = std::move(resume->found);
            ++finished_;
            log::debug("batch", job.name + ": done before");
            return {};
        }
        if (!resume->why.empty()) log::info("batch", job.name + ": restarted, " + resume->why);
        const bool resumes =
            resume->action == ResumeState::Action::Resume && job.command == "export";
        JobResult result;
        result.state = JobState::Begun;
        result.message = "its last run did not finish";
        result.scene = std::move(resume->scene);
        result.command = job.command;
        result.arguments = job.arguments;
        result.version = settings_.version;
        result.ran_now = true;
        result.seconds = resumes ? resume->found.seconds : 0.0;
        // Written before the run, so that the next batch knows which settings the frames in the
        // folder belong to.
        if (Status status = writeResult(lock->folder(), result); !status) return status;
        const Result<FileDescriptor> output = lock->folder().openEmptied(kOutput);
        if (!output) return tl::unexpected(output.error());
        const Result<FileDescriptor> messages = lock->folder().openEmptied(kLog);
        if (!messages) return tl::unexpected(messages.error());
        ProcessSetup setup;
        setup.output = output->get();
        setup.messages = messages->get();
        setup.memory_bytes = settings_.memory_mb * 1'000'000;
        setup.expendable = true;
        Result<ChildProcess> process =
            ChildProcess::start(commandOf(job, settings_, resumes), setup);
        if (!process) return tl::unexpected(std::move(process.error()));
        const double before = result.seconds;
        running_.push_back({index, std::move(*process), std::move(*lock), std::move(result), before,
                            Clock::now(), std::nullopt, JobState::Crashed});
        return {};
    }

    /// Checks a job and applies its limits. Returns whether it has ended.
    bool look(Running& one, bool stop) {
        if (const auto end = one.process.end()) {
            conclude(one, *end);
            return true;
        }
        const auto now = Clock::now();
        const std::chrono::duration<double> spent = now - one.begin;
        if (one.kill_at) {
            if (now >= *one.kill_at) one.process.send(SIGKILL);
        } else if (stop) {
            ask(one, SIGINT, JobState::Interrupted);
        } else if (settings_.timeout_s > 0.0 && spent.count() > settings_.timeout_s) {
            ask(one, SIGTERM, JobState::TimedOut);
        }
        return false;
    }

    static void ask(Running& one, int signal, JobState as) {
        one.process.send(signal);
        one.process.send(SIGCONT);  // a suspended process would not handle the signal
        one.kill_at = Clock::now() + kGrace;
        one.stopped_as = as;
    }

    void conclude(Running& one, const ProcessEnd& end) {
        JobResult& result = one.result;
        const fs::path folder = folderOf(one.index);
        const std::chrono::duration<double> spent = Clock::now() - one.begin;
        result.seconds = one.seconds_before + spent.count();
        result.peak_bytes = end.peak_bytes;
        result.exit_code = std::max(end.exit_code, 0);
        result.signal = end.signal;
        result.message.clear();
        if (end.exit_code == 0) {
            result.state = JobState::Done;
            readOutput(folder / kOutput, folder, result);
            const bool lacks_datasets =
                jobs_[one.index].command == "export" &&
                (result.datasets.empty() || !datasetsAreThere(result, folder));
            if (result.metrics.empty() || lacks_datasets) {
                result.state = JobState::Failed;
                result.message = "it reported success, but its output is missing";
            }
        } else if (one.kill_at) {
            result.state = one.stopped_as;
            result.message =
                one.stopped_as == JobState::TimedOut
                    ? fmt::format("it took longer than {:g} s; the next run resumes it",
                                  settings_.timeout_s)
                    : "it was stopped with the batch; the next run resumes it";
        } else if (end.signal != 0) {
            result.state = JobState::Crashed;
            result.message = signalText(end.signal);
        } else {
            result.state = JobState::Failed;
            result.message = lastWords(folder / kLog);
            if (result.message.empty()) {
                result.message = fmt::format("it ended with code {}", end.exit_code);
            }
        }
        if (const Status status = writeResult(one.lock.folder(), result); !status) {
            result.state = JobState::Failed;
            result.message = describe(status.error());
        }
        results_[one.index] = std::move(result);
        finish(one.index);
    }

    void finish(std::size_t index) {
        ++finished_;
        const JobResult& result = results_[index];
        const std::string line = fmt::format("[{}/{}] {}: {}", finished_, jobs_.size(),
                                             jobs_[index].name, resultText(result));
        if (result.state == JobState::Done) {
            log::info("batch", line);
        } else {
            log::error("batch", line);
        }
    }

    const std::vector<Job>& jobs_;
    const RunSettings& settings_;
    const JobContext& job_;
    const Result<GuardedFolder> batch_ = GuardedFolder::make(settings_.folder);
    std::vector<JobResult> results_;
    std::list<Running> running_;
    std::vector<std::size_t> busy_;  // indices of jobs that another batch process holds
    bool looks_last_ = false;        // this is the second round, for the busy jobs
    int finished_ = 0;
};

}  // namespace

Result<fs::path> ownProgram() {
    std::error_code error;
    fs::path program = ownFile();
    if (fs::exists(program, error)) return program;
    return fail(ErrorCode::Failed, "the dollytrack program file cannot be found; install it again",
                program.string());
}

Result<ResumeState> resumeStateOf(const Job& job, const RunSettings& settings) {
    const fs::path folder = settings.folder / job.name;
    ResumeState resume;
    resume.found = readResult(folder);
    const JobResult& found = resume.found;
    Result<SceneStamp> scene = stampOf(job, found.scene);
    if (!scene) return tl::unexpected(std::move(scene.error()));
    resume.scene = std::move(*scene);
    if (found.state == JobState::NotRun) return resume;
    if (!isOf(found, job)) {
        resume.why = "its settings have changed";
    } else if (resume.scene.sha256 != found.scene.sha256) {
        resume.why = "its scene has changed";
    } else if (found.state == JobState::Done && datasetsAreThere(found, folder)) {
        resume.action = ResumeState::Action::None;
    } else if (found.version != settings.version) {
        resume.why = "another version of the program started it";
    } else if (canGoOn(found)) {
        resume.action = ResumeState::Action::Resume;
    }
    return resume;
}

std::vector<std::string> commandOf(const Job& job, const RunSettings& settings, bool resumes) {
    std::vector<std::string> command = {settings.program.string(), job.command, job.scene.string()};
    command.insert(command.end(), job.arguments.begin(), job.arguments.end());
    command.insert(command.end(), {"--json", "--threads", std::to_string(settings.threads)});
    if (job.command == "export") {
        const fs::path out = settings.folder / job.name / kDataset;
        // The job's folder is locked, so any dataset in it may be overwritten.
        command.insert(command.end(), {"--out", out.string(), "--within", settings.folder.string(),
                                       "--overwrite"});
        if (resumes) command.emplace_back("--resume");
    }
    return command;
}

std::vector<JobResult> runJobs(const std::vector<Job>& jobs, const RunSettings& settings,
                               const JobContext& job) {
    return Runner(jobs, settings, job).run();
}

}  // namespace dollytrack::batch
