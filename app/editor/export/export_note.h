#pragma once

#include "engine/core/result.h"
#include "ui/export_job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Why an export that an editor left is not done.
enum class ExportEnd {
    EditorDied,  // while the export ran or waited
    EditorLeft,  // likewise, and the editor stopped it
    Settled,     // it was cancelled by the user or failed, who was told
};

/// What an editor leaves of an export on the disk, so that the next one can offer to go on with it.
struct ExportNote {
    ui::ExportRequest request;
    std::filesystem::path project_file;
    bool snapshot = false;  // the project file is ours, and goes with the note
    int frames_done = 0;
    int frames = 0;                         // 0: not known yet
    ExportEnd end = ExportEnd::EditorDied;  // as it is if the editor ends without another word

    bool operator==(const ExportNote&) const = default;
};

/// "export-<mark>-<job>", of the snapshot (.dolly) and of the note (.json).
[[nodiscard]] std::filesystem::path exportFile(const std::filesystem::path& folder,
                                               const std::string& mark, int job,
                                               const char* ending);

/// Written whole or not at all. Error: CannotWrite.
Status writeNote(const std::filesystem::path& file, const ExportNote& note);
/// Error: BadInput.
Result<ExportNote> readNote(const std::filesystem::path& file);

/// Makes the note that another editor left, and its snapshot, those of a job of one's own. A note
/// that cannot be read is removed; otherwise an error leaves it. Errors: BadInput, CannotWrite.
Result<ExportNote> takeOverNote(const std::filesystem::path& left,
                                const std::filesystem::path& folder, const std::string& mark,
                                int job);

/// Notes of editors that no longer run, oldest first. Snapshots without a note are removed.
[[nodiscard]] std::vector<std::filesystem::path> findLeftNotes(const std::filesystem::path& folder);

}  // namespace dollytrack::editor
