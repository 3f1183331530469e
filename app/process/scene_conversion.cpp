#include "app/process/scene_conversion.h"

#include "app/process/child_process.h"
#include "app/process/find_program.h"
#include "engine/core/clean_text.h"
#include "engine/core/log.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/sandbox/confined_program.h"
#include "engine/io/sandbox/importer_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes kLongest{30};
// Its messages begin with this word, and a second one that says what they are.
constexpr std::string_view kMessage = "dollytrack:";
// Runs before the file is loaded, which may end Blender.
constexpr const char* kSayVersion =
    "import bpy, sys; print('dollytrack: version', *bpy.app.version[:2], file=sys.stderr, "
    "flush=True)";
// Blender continues with an empty scene if it cannot read the file. Files that the sandbox hides
// are like files that are missing.
constexpr const char* kScript = R"(
import bpy, os, sys

def say(kind, text):
    print("dollytrack:", kind, text, file=sys.stderr)

def is_readable(path):
    try:
        open(path, "rb").close()
        return True
    except OSError:
        return False

if not bpy.data.filepath:
    say("reason", "it cannot read the file")
    sys.exit(7)
shapes = [one for one in bpy.context.scene.objects
          if one.type in {"MESH", "CURVE", "SURFACE", "FONT", "META"} or one.instance_collection]
if not shapes:
    say("reason", "its scene has no objects with a surface")
    sys.exit(7)
images = [one for one in bpy.data.images if one.source == "FILE" and not one.packed_file]
for one in [*bpy.data.libraries, *images]:
    if one.filepath and not is_readable(bpy.path.abspath(one.filepath, library=one.library)):
        say("missing", one.filepath)
for one in shapes:
    if one.hide_render:
        say("hidden", one.name)
bpy.ops.export_scene.gltf(filepath=os.path.join(os.environ["HOME"], "scene.glb"),
                          export_apply=True, use_renderable=True)
)";

/// A new folder for Blender's files, removed at the end.
class WorkFolder {
  public:
    static Result<WorkFolder> in(const fs::path& folder) {
        std::string path = (folder / ".dollytrack-convert-XXXXXX").string();
        if (::mkdtemp(path.data()) == nullptr) return tl::unexpected(writeError(errno, folder));
        return WorkFolder(path);
    }
    ~WorkFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    WorkFolder(WorkFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    WorkFolder& operator=(WorkFolder&&) = delete;
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    explicit WorkFolder(fs::path path) : path_(std::move(path)) {}
    fs::path path_;
};

/// How Blender ended, and what it wrote to standard error.
struct BlenderRun {
    ProcessEnd end;
    std::string messages;
};

/// Runs Blender in confinement. Errors: Cancelled, Failed.
Result<BlenderRun> runBlender(const fs::path& blender, const fs::path& scene, const fs::path& work,
                              const JobContext& job) {
    ProcessSetup setup;
    setup.expendable = true;
    Result<ChildProcess> process = ChildProcess::start(
        {importerProgram().string(), kConfine, std::to_string(::getpid()), work.string(),
         scene.parent_path().string(), blender.string(), "--background", "--factory-startup",
         "--disable-autoexec", "-noaudio", "--python-exit-code", "8", "--python-expr", kSayVersion,
         scene.string(), "--python-expr", kScript},
        setup);
    if (!process) return tl::unexpected(process.error());
    const auto begin = std::chrono::steady_clock::now();
    BlenderRun run;
    constexpr std::size_t kMostKept = std::size_t{1} << 20U;
    while (true) {
        const std::string heard = process->read(std::chrono::milliseconds(50));
        if (run.messages.size() < kMostKept) run.messages += heard;
        if (const std::optional<ProcessEnd> end = process->end()) {
            run.end = *end;
            run.messages += process->read(std::chrono::milliseconds(0));
            return run;
        }
        if (job.cancelled()) {
            return fail(ErrorCode::Cancelled, "conversion was cancelled", scene.string());
        }
        if (std::chrono::steady_clock::now() - begin > kLongest) {
            return fail(ErrorCode::Failed,
                        "Blender did not convert it within 30 minutes and was stopped",
                        scene.string());
        }
    }
}

/// The messages of one kind of kScript, without control characters.
std::vector<std::string> messagesOf(const BlenderRun& run, std::string_view kind) {
    std::vector<std::string> found;
    const std::string begin = fmt::format("{} {} ", kMessage, kind);
    std::istringstream lines(run.messages);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(begin)) found.push_back(cleanText(line.substr(begin.size())));
    }
    return found;
}

/// The version of Blender that saved a file, times 100: 403 for 4.3; 0 if it is compressed.
int savedBy(const std::filesystem::path& scene) {
    const Result<InputFile> input = openNamedFile(scene);
    std::string header(17, '\0');
    if (!input || input->read(0, header.data(), header.size()) == 0) return 0;
    // "BLENDER-v403", or "BLENDER17-01v0500" since Blender 5.
    const std::size_t v = header.find_first_of("vV", 7);
    if (!header.starts_with("BLENDER") || v == std::string::npos) return 0;
    int version = 0;
    std::from_chars(header.data() + v + 1, header.data() + header.size(), version);
    return version;
}

/// The version of the Blender that ran, times 100; 0 if it did not start.
int ranVersion(const BlenderRun& run) {
    const std::vector<std::string> said = messagesOf(run, "version");
    int major = 0;
    int minor = 0;
    if (!said.empty()) std::istringstream(said.front()) >> major >> minor;
    return 100 * std::clamp(major, 0, 99) + std::clamp(minor, 0, 99);
}

/// The error for a run that made nothing.
tl::unexpected<Error> whyNot(const BlenderRun& run, const fs::path& blender,
                             const fs::path& scene) {
    constexpr const char* kYourself = "; export glTF in Blender yourself";
    const std::string where = scene.string();
    if (run.end.exit_code == kCannotConfine) {
        return fail(ErrorCode::Failed,
                    std::string("this system cannot confine Blender (Landlock or seccomp is "
                                "missing)") +
                        kYourself,
                    where);
    }
    if (run.end.exit_code == kCannotStart) {
        return fail(ErrorCode::Failed,
                    blender.string() +
                        " cannot be run in the sandbox; install Blender in /usr or "
                        "/opt (sudo apt install blender)",
                    where);
    }
    const int saved = savedBy(scene);
    const int ran = ranVersion(run);
    if (ran > 0 && saved / 100 > ran / 100) {
        const auto text = [](int version) {
            return fmt::format("Blender {}.{}", version / 100, version % 100);
        };
        return fail(ErrorCode::BadInput,
                    text(saved) + " saved the file and " + text(ran) +
                        ", which is installed, cannot convert it; install " + text(saved) +
                        " or newer (blender.org), or export glTF with it",
                    where);
    }
    if (run.end.signal != 0) {
        return fail(
            ErrorCode::BadInput,
            fmt::format("Blender was ended by signal {}, perhaps for lack of memory (limit: "
                        "{} GiB){}",
                        run.end.signal, kMostConfinedData >> 30U, kYourself),
            where);
    }
    const std::vector<std::string> reasons = messagesOf(run, "reason");
    std::string reason = reasons.empty() ? "" : reasons.front();
    if (reason.empty()) {
        std::istringstream lines(run.messages);
        for (std::string line; std::getline(lines, line);) {
            const std::string_view text = trimmed(line);
            if (!text.empty() && !text.starts_with(kMessage)) reason = cleanText(std::string(text));
        }
    }
    if (reason.empty()) {
        reason = run.end.exit_code == 1 ? "it cannot read the file"
                                        : fmt::format("exit code {}", run.end.exit_code);
    }
    return fail(ErrorCode::BadInput, "Blender cannot convert it: " + reason, where);
}

void warnOfLosses(const BlenderRun& run) {
    const auto list = [](const std::vector<std::string>& names) {
        constexpr std::size_t kMostNamed = 5;
        std::string text;
        for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) {
            text += (i > 0 ? ", " : "") + names[i];
        }
        if (names.size() > kMostNamed)
            text += fmt::format(" and {} more", names.size() - kMostNamed);
        return text;
    };
    if (const auto missing = messagesOf(run, "missing"); !missing.empty()) {
        log::warn(
            "convert",
            fmt::format("Blender could not read {} {} of the scene, missing or outside of its "
                        "folder: {}; pack them into the file (File > External Data), or move "
                        "them into its folder",
                        missing.size(), missing.size() == 1 ? "file" : "files", list(missing)));
    }
    if (const auto hidden = messagesOf(run, "hidden"); !hidden.empty()) {
        log::info("convert",
                  fmt::format("{} {} hidden in renders and left out: {}", hidden.size(),
                              hidden.size() == 1 ? "object is" : "objects are", list(hidden)));
    }
}

/// Converted files have the time of the Blender file that they were made from.
bool isUpToDate(const fs::path& converted, fs::file_time_type scene_time) {
    std::error_code error;
    const auto made = fs::last_write_time(converted, error);
    return !error && made == scene_time;
}

/// Whether Blender wrote this glTF file.
bool isBlendersExport(const fs::path& file) {
    const Result<InputFile> input = openNamedFile(file);
    std::string head(1000, '\0');
    if (!input || input->read(0, head.data(), head.size()) == 0) return false;
    return head.find("Khronos glTF Blender") != std::string::npos;
}

}  // namespace

bool isBlenderFile(const fs::path& scene) {
    return lowerExtension(scene) == ".blend";
}

Result<fs::path> convertScene(const fs::path& scene, const JobContext& job) {
    std::error_code error;
    const fs::path from = fs::canonical(scene, error);
    if (error || !fs::is_regular_file(from, error)) {
        return fail(ErrorCode::BadInput, "there is no such file; check the path", scene.string());
    }
    // Read before Blender reads the file, in case that changes meanwhile.
    const auto scene_time = fs::last_write_time(from, error);
    const fs::path to = fs::path(scene).concat(".glb");
    if (!error && isUpToDate(to, scene_time)) {
        log::debug("convert", to.string() + " is up to date");
        return to;
    }
    if (fs::exists(to, error) && !isBlendersExport(to)) {
        return fail(ErrorCode::BadInput,
                    "it was not made from the Blender file; move it away, or open it instead",
                    to.string());
    }
    const std::optional<fs::path> blender = findProgram("blender");
    if (!blender) {
        return fail(ErrorCode::BadInput,
                    "converting a Blender file needs Blender: sudo apt install blender",
                    scene.string());
    }
    job.report(0.0);
    Result<WorkFolder> work = WorkFolder::in(fs::absolute(to, error).parent_path());
    if (!work) return tl::unexpected(work.error());
    const Result<BlenderRun> run = runBlender(*blender, from, work->path(), job);
    if (!run) return tl::unexpected(run.error());
    const fs::path made = work->path() / "scene.glb";
    if (run->end.exit_code != 0 || !fs::is_regular_file(fs::symlink_status(made, error))) {
        return whyNot(*run, *blender, scene);
    }
    warnOfLosses(*run);
    fs::last_write_time(made, scene_time, error);
    // Another process may have converted the same scene meanwhile, and uses the result.
    if (isUpToDate(to, scene_time)) return to;
    fs::rename(made, to, error);
    if (error) return tl::unexpected(writeError(error.value(), to));
    log::info("convert", "converted to " + to.string());
    return to;
}

}  // namespace dollytrack
