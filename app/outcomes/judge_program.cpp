#include "app/outcomes/judge_program.h"

#include "app/batch/batch_runner.h"
#include "app/batch/log_end.h"
#include "app/process/child_process.h"
#include "engine/core/clean_text.h"
#include "engine/core/field_list.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <map>

namespace dollytrack::outcomes {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, with Debian's libraries
constexpr int kMissingExit = 3;
constexpr double kCheckTimeout_s = 120.0;  // allows for loading large libraries from a slow disk
constexpr auto kLookInterval = std::chrono::milliseconds(50);
constexpr auto kEndGrace = std::chrono::seconds(5);
constexpr std::size_t kEnoughWords = 4096;

/// The first line of a Python file's docstring.
std::string docLine(const std::string& source) {
    const std::size_t begin = source.find("\"\"\"");
    if (begin == std::string::npos) return {};
    const std::size_t end = source.find_first_of("\n\"", begin + 3);
    return cleanText(source.substr(begin + 3, end == std::string::npos ? end : end - begin - 3));
}

std::string lastLine(const fs::path& file) {
    std::string text = batch::endOf(file, kEnoughWords);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    const std::size_t before = text.rfind('\n');
    return cleanText(before == std::string::npos ? text : text.substr(before + 1));
}

/// Runs a judge's process until it ends.
class WatchedProcess {
  public:
    WatchedProcess(const JudgeProgram& judge, const JudgeSettings& settings)
        : judge_(judge), settings_(settings) {}

    Result<JudgeEnd> run(const std::vector<std::string>& arguments, double timeout_s, int entries,
                         const JobContext& job) {
        const Result<GuardedFolder> folder = GuardedFolder::open(settings_.folder);
        if (!folder) return tl::unexpected(folder.error());
        const Result<FileDescriptor> said = folder->openEmptied("said.txt");
        if (!said) return tl::unexpected(said.error());
        const Result<FileDescriptor> log = folder->openEmptied("log.txt");
        if (!log) return tl::unexpected(log.error());
        // -B: no compiled files in the judges' folder, which may belong to the user.
        std::vector<std::string> command = {kPython, "-B", judge_.path.string()};
        command.insert(command.end(), arguments.begin(), arguments.end());
        ProcessSetup setup;
        setup.output = said->get();
        setup.messages = log->get();
        setup.expendable = true;
        Result<ChildProcess> process = ChildProcess::start(command, setup);
        if (!process) {
            return JudgeEnd{JudgeEnd::How::Missing,
                            "Python is missing; install Debian's python3, python3-numpy and "
                            "python3-opencv."};
        }
        return watch(*process, timeout_s, entries, job);
    }

  private:
    Result<JudgeEnd> watch(ChildProcess& process, double timeout_s, int entries,
                           const JobContext& job) {
        const auto begin = Clock::now();
        std::optional<Clock::time_point> kill_at;
        bool timed_out = false;
        std::optional<ProcessEnd> end;
        while (!(end = process.end())) {
            const auto now = Clock::now();
            const std::chrono::duration<double> spent = now - begin;
            if (kill_at) {
                if (now >= *kill_at) process.send(SIGKILL);
            } else if (job.cancelled()) {
                stop(process, SIGINT, kill_at);
            } else if (timeout_s > 0.0 && spent.count() > timeout_s) {
                timed_out = true;
                stop(process, SIGTERM, kill_at);
            }
            if (entries > 0) job.reportItems(std::min(finishedEntries(), entries), entries);
            [[maybe_unused]] const std::string nothing = process.read(kLookInterval);
        }
        if (job.cancelled()) {
            return fail(ErrorCode::Cancelled,
                        "The judges were stopped; the same command resumes them.");
        }
        if (timed_out) {
            return JudgeEnd{
                JudgeEnd::How::TimedOut,
                fmt::format("it took longer than {:g} s; run the command again to measure the rest",
                            timeout_s)};
        }
        return howItEnded(*end);
    }

    static void stop(const ChildProcess& process, int signal,
                     std::optional<Clock::time_point>& kill_at) {
        process.send(signal);
        process.send(SIGCONT);
        kill_at = Clock::now() + kEndGrace;
    }

    /// Judges print one line per finished entry.
    [[nodiscard]] int finishedEntries() const {
        const std::string text = batch::endOf(settings_.folder / "log.txt", std::size_t{1} << 20U);
        return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    }

    [[nodiscard]] JudgeEnd howItEnded(const ProcessEnd& end) const {
        const std::string said = lastLine(settings_.folder / "said.txt");
        if (end.exit_code == 0) return {JudgeEnd::How::Done, said};
        if (end.exit_code == kMissingExit) return {JudgeEnd::How::Missing, said};
        std::string why = lastLine(settings_.folder / "log.txt");
        if (end.signal != 0) why = fmt::format("it was ended by signal {}", end.signal);
        if (why.empty()) why = fmt::format("it ended with code {}", end.exit_code);
        return {JudgeEnd::How::Failed, why};
    }

    const JudgeProgram& judge_;
    const JudgeSettings& settings_;
};

}  // namespace

Result<fs::path> judgesFolder() {
    const Result<fs::path> program = batch::ownProgram();
    if (!program) return tl::unexpected(program.error());
    fs::path folder = (program->parent_path() / "../share/dollytrack/judges").lexically_normal();
    std::error_code error;
    if (fs::is_directory(folder, error)) return folder;
    return fail(ErrorCode::Failed,
                "The folder of the programs that judge outcomes is missing; build or install "
                "dollytrack again.",
                folder.string());
}

Result<std::vector<JudgeProgram>> findJudges(const std::vector<fs::path>& folders) {
    std::map<std::string, JudgeProgram> found;
    for (const fs::path& folder : folders) {
        std::error_code error;
        for (auto entry = fs::directory_iterator(folder, error);
             !error && entry != fs::directory_iterator(); entry.increment(error)) {
            const fs::path& path = entry->path();
            if (path.extension() != ".py") continue;
            const Result<std::string> source = readText(path);
            if (!source) return tl::unexpected(source.error());
            // Shared modules have no main program.
            if (source->find("__main__") == std::string::npos) continue;
            JudgeProgram judge{path.stem().string(), fs::absolute(path), docLine(*source),
                               source->find("\"tests\"") != std::string::npos,
                               source->find("\"references\"") != std::string::npos};
            found.insert_or_assign(judge.name, std::move(judge));
        }
        if (error) {
            return fail(ErrorCode::BadInput,
                        "The folder of judges cannot be read (" + error.message() + ").",
                        folder.string());
        }
    }
    std::vector<JudgeProgram> judges;
    for (auto& [name, judge] : found) judges.push_back(std::move(judge));
    return judges;
}

Result<std::vector<JudgeProgram>> chooseJudges(const std::vector<JudgeProgram>& all,
                                               const std::vector<std::string>& names) {
    std::vector<std::string> known = {"all"};
    for (const JudgeProgram& judge : all) known.push_back(judge.name);
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string closest = closestName(name, known);
        return fail(
            ErrorCode::Usage,
            closest.empty()
                ? fmt::format("The judge is unknown; the judges are {}.", fmt::join(known, ", "))
                : fmt::format("The judge is unknown; did you mean {}?", closest),
            "--outcomes " + name);
    }
    const auto asked = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    std::vector<JudgeProgram> chosen;
    for (const JudgeProgram& judge : all) {
        if (asked("all") || asked(judge.name)) chosen.push_back(judge);
    }
    return chosen;
}

Result<JudgeEnd> checkJudge(const JudgeProgram& judge, const JudgeSettings& settings,
                            const fs::path& request, const JobContext& job) {
    std::vector<std::string> arguments = {"--check"};
    if (!request.empty()) arguments.push_back(request.string());
    return WatchedProcess(judge, settings).run(arguments, kCheckTimeout_s, 0, job);
}

Result<JudgeEnd> runJudge(const JudgeProgram& judge, const JudgeSettings& settings, int entries,
                          const JobContext& job) {
    return WatchedProcess(judge, settings)
        .run({(settings.folder / "request.json").string(),
              (settings.folder / "result.json").string()},
             settings.timeout_s, entries, job);
}

}  // namespace dollytrack::outcomes
