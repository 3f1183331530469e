#include "app/process/scene_conversion.h"

#include "app/process/child_process.h"
#include "engine/core/log.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/sandbox/confined_program.h"
#include "engine/io/sandbox/importer_process.h"

#include <unistd.h>

#include <cerrno>
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
// Blender continues with an empty scene if it cannot read the file.
constexpr const char* kScript =
    "import bpy, os, sys\n"
    "if not bpy.data.filepath: sys.exit(7)\n"
    "bpy.ops.export_scene.gltf(filepath=os.path.join(os.environ['HOME'], 'scene.glb'), "
    "export_apply=True)\n";

std::optional<fs::path> findProgram(const char* name) {
    const char* folders = std::getenv("PATH");
    std::istringstream list(folders != nullptr ? folders : "/usr/bin:/bin");
    for (std::string folder; std::getline(list, folder, ':');) {
        const fs::path program = fs::path(folder) / name;
        std::error_code error;
        if (!folder.empty() && ::access(program.c_str(), X_OK) == 0 &&
            fs::is_regular_file(program, error)) {
            return fs::canonical(program, error);
        }
    }
    return std::nullopt;
}

/// A new folder for Blender's files, removed at the end.
class WorkFolder {
  public:
    static Result<WorkFolder> beside(const fs::path& scene) {
        std::string path = (scene.parent_path() / ".dollytrack-convert-XXXXXX").string();
        if (::mkdtemp(path.data()) == nullptr) {
            return tl::unexpected(writeError(errno, scene.parent_path()));
        }
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

/// Its exit code; -1 after a signal. Errors: Cancelled, Failed.
Result<int> runBlender(const fs::path& blender, const fs::path& scene, const fs::path& work,
                       const JobContext& job) {
    Result<ChildProcess> process =
        ChildProcess::start({importerProgram().string(), kConfine, std::to_string(::getpid()),
                             work.string(), scene.parent_path().string(), blender.string(),
                             "--background", "--factory-startup", "--disable-autoexec", "-noaudio",
                             "--python-exit-code", "8", scene.string(), "--python-expr", kScript});
    if (!process) return tl::unexpected(process.error());
    const auto begin = std::chrono::steady_clock::now();
    while (true) {
        const std::string messages = process->read(std::chrono::milliseconds(50));
        if (!messages.empty()) log::debug("convert", messages);
        if (const std::optional<ProcessEnd> end = process->end()) return end->exit_code;
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

bool isUpToDate(const fs::path& converted, const fs::path& scene) {
    std::error_code error;
    const auto made = fs::last_write_time(converted, error);
    if (error) return false;
    const auto changed = fs::last_write_time(scene, error);
    return !error && made >= changed;
}

}  // namespace

bool needsConversion(const fs::path& scene) {
    return scene.extension() == ".blend";
}

Result<fs::path> convertScene(const fs::path& scene, const JobContext& job) {
    std::error_code error;
    const fs::path from = fs::canonical(scene, error);
    if (error) return fail(ErrorCode::BadInput, "the file cannot be opened", scene.string());
    fs::path to = scene;
    to += ".glb";
    if (isUpToDate(to, scene)) {
        log::info("convert", "using " + to.string() +
                                 ", converted earlier; remove it to convert the scene again");
        return to;
    }
    const std::optional<fs::path> blender = findProgram("blender");
    if (!blender) {
        return fail(ErrorCode::BadInput,
                    "converting a Blender file needs Blender: sudo apt install blender",
                    scene.string());
    }
    job.report(0.0);
    Result<WorkFolder> work = WorkFolder::beside(from);
    if (!work) return tl::unexpected(work.error());
    const Result<int> code = runBlender(*blender, from, work->path(), job);
    if (!code) return tl::unexpected(code.error());
    const fs::path made = work->path() / "scene.glb";
    if (*code == 3) {
        return fail(ErrorCode::Failed,
                    "Blender was not started, because this system cannot confine it (Landlock and "
                    "seccomp are missing); convert the file yourself: open it in Blender and "
                    "export glTF",
                    scene.string());
    }
    if (*code != 0 || !fs::is_regular_file(fs::symlink_status(made, error))) {
        return fail(ErrorCode::BadInput,
                    "Blender cannot convert it (" +
                        (*code == 7   ? std::string("it cannot read the file")
                         : *code == 0 ? std::string("it wrote nothing")
                                      : "exit code " + std::to_string(*code)) +
                        "); open it in Blender to see why",
                    scene.string());
    }
    fs::rename(made, to, error);
    if (error) return tl::unexpected(writeError(error.value(), to));
    log::info("convert", "converted to " + to.string());
    return to;
}

}  // namespace dollytrack
