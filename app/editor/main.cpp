#include "app/cli/exit_code.h"
#include "app/cli/terminal/standard_streams.h"
#include "app/editor/editor.h"
#include "app/editor/shell/inspector.h"
#include "app/manual/manual_files.h"
#include "app/project/read_project.h"
#include "app/version.h"
#include "engine/core/log.h"
#include "ui/widgets/cut_lines.h"
#include "ui/widgets/item_map.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace {

/// Redirects the log to the window during its lifetime, then back to stderr.
class LogToWindow {
  public:
    explicit LogToWindow(dollytrack::ui::LogBuffer& buffer) {
        dollytrack::log::setSink([&buffer](const dollytrack::log::Record& record) {
            buffer.add(record);
            dollytrack::editor::Window::wake();
        });
    }
    ~LogToWindow() { dollytrack::log::setSink({}); }
    LogToWindow(const LogToWindow&) = delete;
    LogToWindow& operator=(const LogToWindow&) = delete;
};

int run(const std::string& path, const std::string& socket,
        dollytrack::editor::EditorSettings settings) {
    using namespace dollytrack;
    ui::LogBuffer log_buffer;
    std::optional<LogToWindow> log_to_window(std::in_place, log_buffer);
    auto window = editor::Window::open(settings.window);
    if (!window) {
        std::cerr << "dollytrack-editor: " << describe(window.error()) << "\n";
        return cli::kNoOpenGl;
    }
    auto drawing = (*window)->drawingContext();
    if (!drawing) {
        std::cerr << "dollytrack-editor: " << describe(drawing.error()) << "\n";
        return cli::kNoOpenGl;
    }
    editor::Editor shell(**window, std::move(*drawing), log_buffer, std::move(settings));
    std::unique_ptr<editor::Inspector> inspector;
    if (!socket.empty()) {
        ui::item_map::want(true);
        inspector = std::make_unique<editor::Inspector>(socket, &editor::Window::wake);
    }
    if (!path.empty()) shell.open(path);
    shell.offerRecoveredWork();
    int frames_until_answer = 0;
    (*window)->run([&] {
        // The first frame after a request may still change the state; the second one shows it.
        // Queued input events may need a frame each.
        if (inspector && inspector->asked()) {
            if (!(*window)->hasInput() && ++frames_until_answer > 2) {
                inspector->answer(shell.stateJson());
                frames_until_answer = 0;
            } else if (frames_until_answer == 2) {
                ui::requestCutLines();
            }
            (*window)->animate();
        }
        return shell.frame();
    });
    inspector.reset();
    log_to_window.reset();  // later messages would not be seen in the window
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace dollytrack;
    // Exceeding the file size limit then is a write error, which is reported.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app("Plan a camera trajectory through an indoor scene, inspect and tune it.");
    app.name("dollytrack-editor");
    app.set_version_flag("--version", std::string("dollytrack-editor ") + versionText());
    std::string path;
    std::string socket;
    std::string size;
    app.add_option("file", path, std::string("Scene (") + kSceneFormats + ") or .dolly project")
        ->type_name("FILE");
    app.add_option("--size", size,
                   "Size of the window for a screen of 96 dots per inch, such as 1280x720")
        ->type_name("WxH");
    app.add_option("--inspect", socket,
                   "Unix socket that answers the line 'state' with the editor's state, as JSON")
        ->type_name("PATH");
    if (argc == 3 && std::string_view(argv[1]) == manual::kManualOption) {
        const Status written = manual::writeManual(app, {DOLLYTRACK_VERSION, {}, {}}, argv[2]);
        if (!written) std::cerr << "dollytrack-editor: " << describe(written.error()) << "\n";
        return written ? cli::kDone : cli::kCannotWrite;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            cli::printToStandardError(std::string("dollytrack-editor: ") + error.what() +
                                      "\nRun with --help for more information.");
            return cli::kUsage;
        }
        std::ostringstream text;
        app.exit(error, text, text);
        (void)std::fputs(text.str().c_str(), stdout);
        const Status printed = cli::finishStandardOutput();
        if (printed) return cli::kDone;
        cli::printToStandardError("dollytrack-editor: " + describe(printed.error()));
        return cli::kCannotWrite;
    }
    editor::EditorSettings settings = editor::loadSettings();
    if (!size.empty()) {
        int width = 0;
        int height = 0;
        if (std::sscanf(size.c_str(), "%dx%d", &width, &height) != 2 || width < 320 ||
            height < 240 || width > 16384 || height > 16384) {
            std::cerr << "dollytrack-editor: --size needs WIDTHxHEIGHT, like 1280x720.\n";
            return cli::kUsage;
        }
        settings.window = {width, height, false};
    }
    return run(path, socket, std::move(settings));
}
