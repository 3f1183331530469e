#include "app/cli/command_line.h"
#include "engine/core/log.h"
#include "engine/jobs/parallel.h"

#include <CLI/CLI.hpp>

#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

namespace {

std::atomic<bool>* cancel_flag = nullptr;
volatile std::sig_atomic_t caught_signal = 0;

/// The first signal asks the work to stop cleanly; a second one no longer waits for it.
void onSignal(int signal) {
    if (caught_signal != 0) _exit(128 + signal);
    caught_signal = signal;
    cancel_flag->store(true);
}

int runAction(const dollytrack::cli::Session& session) {
    using namespace dollytrack;
    const Result<cli::ExitCode> result = session.action();
    log::flush();
    // What was printed may still be in the buffer of a full disk.
    if (result && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) {
        std::cerr << "dollytrack: the results cannot be written to the standard output.\n";
        return cli::kCannotWrite;
    }
    if (result) return *result;
    if (caught_signal != 0) {
        std::cerr << "dollytrack: stopped.\n";
        return 128 + caught_signal;
    }
    std::cerr << "dollytrack: " << describe(result.error()) << "\n";
    return cli::exitCodeFor(result.error().code);
}

}  // namespace

int main(int argc, char** argv) {
    using namespace dollytrack;
    cli::Session session;
    cancel_flag = session.cancelled.get();
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);

    CLI::App app(
        "Plans where a camera should go inside an indoor 3D scene so that every object is "
        "seen well,\nand renders the trajectory as a labelled dataset.");
    app.name("dollytrack");
    app.set_version_flag("--version", std::string("dollytrack ") + DOLLYTRACK_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  dollytrack info room.glb\n"
        "  dollytrack plan room.glb -o room.dolly --set fill=0.5\n"
        "  dollytrack export room.dolly --out dataset\n"
        "\nExit codes: 0 done, 1 failed, 2 usage, 3 partial or a --require not met, 4 bad input,\n"
        "5 no OpenGL, 6 cannot write, 130/143 interrupted.");
    bool verbose = false;
    int threads = 0;
    app.add_flag("-q,--quiet", session.quiet,
                 "No progress and no notes on stderr, only warnings and errors");
    app.add_flag("-v,--verbose", verbose, "Say more on stderr");
    app.add_option("--threads", threads, "Worker threads; 0: one per core")
        ->check(CLI::Range(0, 1024));
    app.fallthrough();

    cli::addInfoCommand(app, session);
    cli::addPlanCommand(app, session);
    cli::addEditCommand(app, session);
    cli::addExportCommand(app, session);
    cli::addParamsCommand(app, session);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked_for_help = error.get_exit_code() == 0;
        if (!asked_for_help) std::cerr << "dollytrack: ";
        app.exit(error);
        return asked_for_help ? cli::kDone : cli::kUsage;
    }
    log::setLevel(session.quiet ? log::Level::Warning
                  : verbose     ? log::Level::Debug
                                : log::Level::Info);
    setThreadCount(threads);
    try {
        return runAction(session);
    } catch (const std::bad_alloc&) {
        std::cerr << "dollytrack: out of memory; try a larger octree_resolution_m or a smaller "
                     "image.\n";
    } catch (const std::exception& error) {
        std::cerr << "dollytrack: unexpected failure: " << error.what() << "\n";
    }
    return cli::kFailed;
}
