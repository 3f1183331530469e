#include "app/editor/export/export_note.h"

#include "app/editor/files/folder_entries.h"
#include "app/editor/files/owner_mark.h"
#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>
#include <utility>

namespace dollytrack::editor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array<const char*, 3> kEnds = {"editor_died", "editor_left", "settled"};

constexpr std::string_view kDigits = "0123456789";

/// Removes a trailing "-17"; returns false if the text does not end so.
bool removeNumber(std::string_view& text) {
    const std::size_t last = text.find_last_not_of(kDigits);
    if (last == std::string_view::npos || last + 1 == text.size() || text[last] != '-') {
        return false;
    }
    text.remove_suffix(text.size() - last);
    return true;
}

bool removeEnding(std::string_view& text, std::string_view ending) {
    if (!text.ends_with(ending)) return false;
    text.remove_suffix(ending.size());
    return true;
}

/// The mark in a file name of exportFile(), [HOST-]NUMBER-NUMBER; empty for other files.
std::string markOf(const fs::path& file) {
    const std::string whole = file.filename().string();
    std::string_view name = completedName(whole);
    constexpr std::string_view kBegin = "export-";
    if (!name.starts_with(kBegin)) return {};
    name.remove_prefix(kBegin.size());
    if (!removeEnding(name, ".dolly") && !removeEnding(name, ".json")) return {};
    if (!removeNumber(name)) return {};
    const std::string mark(name);
    if (!removeNumber(name)) return {};
    if (name.find_first_not_of(kDigits) == std::string_view::npos) return name.empty() ? "" : mark;
    if (!removeNumber(name) || name.empty()) return {};
    const auto in_host = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; };
    return std::ranges::all_of(name, in_host) ? mark : "";
}

}  // namespace

fs::path exportFile(const fs::path& folder, const std::string& mark, int job, const char* ending) {
    return folder / fmt::format("export-{}-{}{}", mark, job, ending);
}

Status writeNote(const fs::path& file, const ExportNote& note) {
    const ui::ExportRequest& request = note.request;
    const json text = {
        {"name", request.name},           {"folder", request.folder.string()},
        {"range", request.range},         {"modalities", request.modalities},
        {"formats", request.formats},     {"flow_distances", request.flow_distances},
        {"rig", request.rig.string()},    {"still", request.still},
        {"overwrite", request.overwrite}, {"project", note.project_file.string()},
        {"snapshot", note.snapshot},      {"frames_done", note.frames_done},
        {"frames", note.frames},          {"end", kEnds[static_cast<std::size_t>(note.end)]}};
    try {
        return writeWhole(file, text.dump(1) + "\n");
    } catch (const json::exception&) {
        // A replaced character would name another folder.
        return fail(ErrorCode::CannotWrite,
                    "A path of this export is not UTF-8, so the export cannot be resumed later.",
                    file.string());
    }
}

Result<ExportNote> readNote(const fs::path& file) {
    ExportNote note;
    try {
        const json read = readBoundedJson(file).value_or(json());
        note.request.name = read.at("name").get<std::string>();
        note.request.folder = read.at("folder").get<std::string>();
        note.request.range = read.at("range").get<std::string>();
        note.request.modalities = read.at("modalities").get<std::vector<std::string>>();
        note.request.formats = read.at("formats").get<std::vector<std::string>>();
        note.request.flow_distances = read.at("flow_distances").get<std::string>();
        note.request.rig = read.value("rig", std::string());
        note.request.still = read.at("still").get<bool>();
        note.request.overwrite = read.at("overwrite").get<bool>();
        note.project_file = read.at("project").get<std::string>();
        note.snapshot = read.at("snapshot").get<bool>();
        note.frames_done = read.at("frames_done").get<int>();
        note.frames = read.at("frames").get<int>();
        // Older notes lack this field.
        const auto* end = std::ranges::find(kEnds, read.value("end", std::string(kEnds[0])));
        if (end != kEnds.end()) note.end = static_cast<ExportEnd>(end - kEnds.begin());
    } catch (const json::exception&) {
        return fail(
            ErrorCode::BadInput,
            "The progress file of an unfinished export cannot be read; start the export again.",
            file.string());
    }
    return note;
}

Result<ExportNote> takeOverNote(const fs::path& left, const fs::path& folder,
                                const std::string& mark, int job) {
    std::error_code error;
    Result<ExportNote> note = readNote(left);
    if (!note) {
        fs::remove(left, error);
        return note;
    }
    // Copies the snapshot first: after a crash in between, it has no note and is cleaned up.
    const fs::path old_snapshot = note->project_file;
    if (note->snapshot) {
        note->project_file = exportFile(folder, mark, job, ".dolly");
        fs::copy_file(old_snapshot, note->project_file, fs::copy_options::overwrite_existing,
                      error);
        if (error) {
            return fail(ErrorCode::CannotWrite,
                        "An unfinished export cannot be resumed: " + error.message() + ".",
                        old_snapshot.string());
        }
    }
    if (Status written = writeNote(exportFile(folder, mark, job, ".json"), *note); !written) {
        return tl::unexpected(written.error());
    }
    fs::remove(left, error);
    if (note->snapshot) fs::remove(old_snapshot, error);
    return note;
}

std::vector<fs::path> findLeftNotes(const fs::path& folder) {
    std::error_code error;
    std::vector<std::pair<fs::file_time_type, fs::path>> notes;
    std::vector<fs::path> left_over;
    for (const fs::directory_entry& entry : entriesOf(folder)) {
        const std::string mark = markOf(entry.path());
        if (mark.empty() || OwnerMark::isHeld(folder, mark)) continue;
        fs::path note = entry.path();
        std::error_code ignored;
        if (note.extension() == ".json") {
            notes.emplace_back(entry.last_write_time(ignored), std::move(note));
        } else if (!fs::exists(note.replace_extension(".json"), ignored)) {
            left_over.push_back(entry.path());
        }
    }
    for (const fs::path& file : left_over) fs::remove(file, error);
    if (!left_over.empty()) {
        log::info("export",
                  fmt::format("removed {} snapshots of interrupted exports", left_over.size()));
    }
    std::ranges::sort(notes);
    std::vector<fs::path> files;
    for (auto& [written, file] : notes) files.push_back(std::move(file));
    return files;
}

}  // namespace dollytrack::editor
