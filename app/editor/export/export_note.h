#pragma once

#include "engine/core/result.h"
#include "ui/export_job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Why an export of an earlier editor is unfinished.
enum class ExportEnd {
    EditorDied,  // the editor crashed while the export ran or waited
    EditorLeft,  // the editor was closed and stopped the export
    Settled,     // cancelled by the user, or failed with a message to the user
};

/// The record of an export on the disk, from which the next editor can offer to resume it.
struct ExportNote {
    ui::ExportRequest request;
    std::filesystem::path project_file;
    bool snapshot = false;  // the project file is a snapshot, deleted together with the note
    int frames_done = 0;
    int frames = 0;                         // 0: not known yet
    ExportEnd end = ExportEnd::EditorDied;  // value that stays if the editor crashes

    bool operator==(const ExportNote&) const = default;
};

/// Path of a job's snapshot (.dolly) or note (.json): "export-<mark>-<job><ending>".
[[nodiscard]] std::filesystem::path exportFile(const std::filesystem::path& folder,
                                               const std::string& mark, int job,
                                               const char* ending);

/// Writes the note atomically. Error: CannotWrite.
Status writeNote(const std::filesystem::path& file, const ExportNote& note);
/// Reads a note. Error: BadInput.
Result<ExportNote> readNote(const std::filesystem::path& file);

/// Renames another editor's note and snapshot to a job of this editor and returns the note. An
/// unreadable note is removed; on other errors it stays. Errors: BadInput, CannotWrite.
Result<ExportNote> takeOverNote(const std::filesystem::path& left,
                                const std::filesystem::path& folder, const std::string& mark,
                                int job);

/// Notes of editors that no longer run, oldest first. Removes snapshots without a note.
[[nodiscard]] std::vector<std::filesystem::path> findLeftNotes(const std::filesystem::path& folder);

}  // namespace dollytrack::editor
