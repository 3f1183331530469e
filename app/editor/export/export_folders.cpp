#include "app/editor/export/export_folders.h"

#include "app/process/find_program.h"
#include "engine/io/files/bounded_json.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace dollytrack::editor {

namespace fs = std::filesystem;

namespace {

/// Normalizes a path, so that folders can be compared without disk access.
fs::path plainly(const fs::path& folder) {
    const fs::path normal = folder.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

fs::path folderBeside(const fs::path& folder, const fs::path& project,
                      const std::vector<ui::ExportJob>& jobs) {
    const fs::path parent = plainly(folder).parent_path();
    const std::string stem = project.stem().string();
    const auto taken = [&](const fs::path& place) {
        return place == plainly(folder) || std::ranges::any_of(jobs, [&](const ui::ExportJob& job) {
                   return plainly(job.request.folder) == place;
               });
    };
    fs::path place = parent / stem;
    for (int i = 2; taken(place); ++i) place = parent / (stem + "_" + std::to_string(i));
    return place;
}

fs::path freeFolderBeside(const fs::path& folder, const std::vector<ui::ExportJob>& jobs) {
    const fs::path parent = plainly(folder).parent_path();
    std::string name = plainly(folder).filename().string();
    int number = 2;
    const std::size_t bar = name.rfind('_');
    int counted = 0;
    if (bar != std::string::npos && bar > 0) {
        const char* const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + bar + 1, end, counted);
        if (read.ec == std::errc() && read.ptr == end && counted >= 2 && counted < 1'000'000) {
            name.resize(bar);
            number = counted + 1;
        }
    }
    const auto taken = [&](const fs::path& place) {
        std::error_code error;
        return fs::symlink_status(place, error).type() != fs::file_type::not_found ||
               std::ranges::any_of(jobs, [&](const ui::ExportJob& job) {
                   return plainly(job.request.folder) == place;
               });
    };
    fs::path place;
    do {
        place = parent / (name + "_" + std::to_string(number++));
    } while (taken(place));
    return place;
}

const ui::ExportJob* jobThatWillWrite(const fs::path& folder,
                                      const std::vector<ui::ExportJob>& jobs) {
    const auto found = std::ranges::find_if(jobs, [&](const ui::ExportJob& job) {
        const bool will = job.active() || job.state == ui::ExportState::Waiting;
        return will && plainly(job.request.folder) == plainly(folder);
    });
    return found != jobs.end() ? &*found : nullptr;
}

fs::path contactSheetIn(const fs::path& folder) {
    std::vector<fs::path> sheets = {folder / "contact_sheet.jpg"};
    const auto rooms = readBoundedJson(folder / "rooms.json").value_or(nlohmann::json());
    if (rooms.is_object() && rooms.contains("rooms")) {
        for (const auto& room : rooms["rooms"]) {
            if (room.is_object())
                sheets.push_back(folder / room.value("name", "") / sheets[0].filename());
        }
    }
    std::error_code error;
    const auto found = std::find_if(sheets.begin(), sheets.end(), [&](const fs::path& sheet) {
        return fs::exists(sheet, error);
    });
    return found != sheets.end() ? *found : fs::path();
}

std::string whyNoFolders() {
    static const bool there = findProgram("xdg-open").has_value();
    return there ? "" : "Install xdg-utils to open folders from here.";
}

Status openFolder(const fs::path& folder) {
    if (const std::string why = whyNoFolders(); !why.empty()) {
        return fail(ErrorCode::Failed, why, folder.string());
    }
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        return fail(ErrorCode::Failed, "The folder no longer exists.", folder.string());
    }
    // Started through a shell that exits at once, so that no zombie process remains. The folder is
    // passed as $0, so it is never interpreted as a command.
    std::string shell = "sh";
    std::string flag = "-c";
    std::string script = "xdg-open \"$0\" >/dev/null 2>&1 &";
    std::string argument = folder.string();
    char* const arguments[] = {shell.data(), flag.data(), script.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    posix_spawnattr_t how;
    posix_spawnattr_init(&how);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSID);
    pid_t process = 0;
    const int failed = posix_spawn(&process, "/bin/sh", &files, &how, arguments, environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0) {
        return fail(
            ErrorCode::Failed,
            std::string("The file manager cannot be started: ") + std::strerror(failed) + ".",
            folder.string());
    }
    while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
    }
    return {};
}

}  // namespace dollytrack::editor
