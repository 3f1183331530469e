#include "app/cli/command_line.h"
#include "app/cli/manual_settings.h"
#include "app/cli/terminal/help_formatter.h"
#include "app/cli/terminal/progress_lines.h"
#include "app/cli/terminal/standard_streams.h"
#include "app/cli/terminal/suggestion.h"
#include "app/version.h"
#include "engine/core/log.h"
#include "engine/jobs/parallel.h"

#include <CLI/CLI.hpp>

#include <sys/resource.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

std::atomic<bool>* cancel_flag = nullptr;
volatile std::sig_atomic_t caught_signal = 0;

/// The first signal requests a clean stop; a second one ends the program at once. If the work does
/// not stop within 20 s, for example because it writes to a blocked pipe, an alarm ends the
/// program.
void onSignal(int signal) {
    constexpr unsigned kLongestEnd_s = 20;
    if (caught_signal != 0) _exit(128 + signal);
    caught_signal = signal;
    cancel_flag->store(true);
    alarm(kLongestEnd_s);
}

void onOverdueEnd(int) {
    _exit(128 + caught_signal);
}

void onCrash(int) {
    constexpr std::string_view kWords =
        "dollytrack: the program crashed, probably because its address space is limited; raise the "
        "limit (ulimit -v)\n";
    static_cast<void>(!write(STDERR_FILENO, kWords.data(), kWords.size()));
    _exit(dollytrack::cli::kFailed);
}

/// Where the address space is limited, LLVM and OpenGL drivers crash if an allocation fails.
void explainCrashesOfLimitedMemory() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    std::signal(SIGSEGV, onCrash);
    std::signal(SIGABRT, onCrash);
}

/// Reports the final error as text, or as JSON line for --progress json.
int endWith(const dollytrack::cli::Session& session, const dollytrack::Error& error, int code) {
    dollytrack::log::flush();
    if (session.lines) {
        dollytrack::cli::ProgressLines::fail(error, code);
    } else {
        dollytrack::cli::printToStandardError("dollytrack: " + describe(error));
    }
    return code;
}

/// Runs the action and flushes standard output.
dollytrack::Result<dollytrack::cli::ExitCode> act(const dollytrack::cli::Session& session) {
    using namespace dollytrack;
    Result<cli::ExitCode> result = session.action();
    const Status printed = cli::finishStandardOutput();
    if (result && !printed) return tl::unexpected(printed.error());
    return result;
}

int runAction(const dollytrack::cli::Session& session) {
    using namespace dollytrack;
    const Result<cli::ExitCode> result = act(session);
    if (!result) {
        const bool stopped = caught_signal != 0 && result.error().code == ErrorCode::Cancelled;
        return endWith(session, result.error(),
                       stopped ? 128 + caught_signal : cli::exitCodeFor(result.error().code));
    }
    log::flush();
    if (session.lines) session.lines->finish(*result);
    return *result;
}

/// Prints help, version or lists, which replace the action.
int printInstead(const dollytrack::cli::Session& session, const CLI::App& app,
                 const CLI::ParseError& asked) {
    using namespace dollytrack;
    std::ostringstream text;
    app.exit(asked, text, text);
    (void)std::fputs(text.str().c_str(), stdout);
    const Status printed = cli::finishStandardOutput();
    return printed ? cli::kDone : endWith(session, printed.error(), cli::kCannotWrite);
}

/// Checked before parsing, so that parsing errors are reported as JSON lines, too.
bool wantsLines(const std::vector<std::string>& arguments) {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == "--progress=json") return true;
        if (arguments[i] == "--progress" && i + 1 < arguments.size() &&
            arguments[i + 1] == "json") {
            return true;
        }
    }
    return false;
}

int runProgram(dollytrack::cli::Session& session, int argc, char** argv) {
    using namespace dollytrack;
    const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
    if (wantsLines(arguments)) {
        session.lines = std::make_shared<cli::ProgressLines>();
        log::setSink(cli::ProgressLines::logSink());
    }
    CLI::App app(
        "Plans a camera trajectory through an indoor 3D scene that captures every object well,\n"
        "and renders it as a labelled dataset.");
    app.name("dollytrack");
    app.formatter(std::make_shared<cli::HelpFormatter>());
    app.set_version_flag("--version", std::string("dollytrack ") + versionText());
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  dollytrack info room.glb\n"
        "  dollytrack plan room.glb -o room.dolly --set fill=0.5\n"
        "  dollytrack export room.dolly --out dataset\n"
        "\nExit codes: 0 done, 1 failed, 2 usage, 3 partial or a --require not met, 4 bad input,\n"
        "5 no OpenGL, 6 cannot write, 130/143 interrupted.");
    bool verbose = false;
    app.add_flag("-q,--quiet", session.quiet, "Only warnings and errors on stderr");
    app.add_flag("-v,--verbose", verbose, "Verbose messages on stderr");
    bool no_cache = false;
    app.add_flag("--no-cache", no_cache, "Bypass the scene cache; same as DOLLYTRACK_NO_CACHE=1");
    app.add_option("--threads", session.threads, "Worker threads; 0: one per core")
        ->check(CLI::Range(0, 1024));
    std::string progress = "bar";
    app.add_option("--progress", progress, "Progress on stderr: a bar, or one JSON object per line")
        ->check(CLI::IsMember({"bar", "json"}))
        ->type_name("bar|json");
    app.fallthrough();

    cli::addInfoCommand(app, session);
    cli::addPlanCommand(app, session);
    cli::addEditCommand(app, session);
    cli::addRepairCommand(app, session);
    cli::addExportCommand(app, session);
    cli::addVerifyCommand(app, session);
    cli::addViewCommand(app, session);
    cli::addStatisticsCommand(app, session);
    cli::addEvaluateCommand(app, session);
    cli::addCompareCommand(app, session);
    cli::addSweepCommand(app, session);
    cli::addBatchCommand(app, session);
    cli::addGatherCommand(app, session);
    cli::addGenerateCommand(app, session);
    cli::addParamsCommand(app, session);

    if (arguments.size() == 2 && arguments[0] == manual::kManualOption) {
        const Status written = manual::writeManual(app, cli::manualSettings(), arguments[1]);
        return written ? cli::kDone : endWith(session, written.error(), cli::kCannotWrite);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::string message = cli::explainUnknownName(app, arguments);
        if (error.get_exit_code() == 0 && message.empty()) return printInstead(session, app, error);
        if (message.empty()) message = cli::explainRefusal(app, error);
        if (!session.lines) message += "\nRun with --help for more information.";
        return endWith(session, {ErrorCode::Usage, message, {}}, cli::kUsage);
    }
    log::setLevel(session.quiet ? log::Level::Warning
                  : verbose     ? log::Level::Debug
                                : log::Level::Info);
    setThreadCount(session.threads);
    // Child processes inherit the setting.
    if (no_cache) setenv("DOLLYTRACK_NO_CACHE", "1", 1);
    return runAction(session);
}

}  // namespace

int main(int argc, char** argv) {
    using namespace dollytrack;
    cli::Session session;
    cancel_flag = session.cancelled.get();
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
    std::signal(SIGALRM, onOverdueEnd);
    // Exceeding the file size limit then is a write error, which is reported.
    std::signal(SIGXFSZ, SIG_IGN);
    explainCrashesOfLimitedMemory();
    cli::cleanStandardOutput();
    try {
        return runProgram(session, argc, argv);
    } catch (const std::exception& exception) {
        // fmt throws if a long print fails on a full disk.
        const Status printed = cli::finishStandardOutput();
        const Error error = printed ? cli::errorOf(exception) : printed.error();
        return endWith(session, error, cli::exitCodeFor(error.code));
    }
}
