#include "app/editor/export/export_progress.h"

#include "app/editor/shell/menu_names.h"
#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>

namespace dollytrack::editor {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestLine = 1 << 16;
constexpr std::size_t kWordsKept = 20;

double numberIn(const json& object, const char* key, double otherwise) {
    const auto at = object.find(key);
    if (at == object.end() || !at->is_number()) return otherwise;
    const double value = at->get<double>();
    return std::isfinite(value) ? value : otherwise;
}

int countIn(const json& object, const char* key, int otherwise) {
    return static_cast<int>(std::clamp(numberIn(object, key, otherwise), 0.0, 1e9));
}

std::string textIn(const json& object, const char* key) {
    const auto at = object.find(key);
    return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

void remember(const std::string& words, ui::ExportJob& job) {
    job.last_words.push_back(words);
    if (job.last_words.size() > kWordsKept) job.last_words.erase(job.last_words.begin());
}

void passOn(const json& record, ui::ExportJob& job) {
    const std::string level = textIn(record, "level");
    const std::string message = withMenuNames(textIn(record, "message"));
    if (message.empty()) return;
    const std::string text = job.request.name + ": " + message;
    if (level == log::name(log::Level::Error)) {
        log::error("export", text);
    } else if (level == log::name(log::Level::Warning)) {
        log::warn("export", text);
    } else {
        log::info("export", text);
    }
    if (level == log::name(log::Level::Error) || level == log::name(log::Level::Warning)) {
        remember(message, job);
    }
}

ErrorCode codeNamed(const std::string& name) {
    if (name == "usage") return ErrorCode::Usage;
    if (name == "bad_input") return ErrorCode::BadInput;
    if (name == "no_opengl") return ErrorCode::NoOpenGl;
    if (name == "cannot_write") return ErrorCode::CannotWrite;
    if (name == "cancelled") return ErrorCode::Cancelled;
    return ErrorCode::Failed;
}

/// Appends the program's last message, if there is one.
std::string withLastWords(std::string sentence, const ui::ExportJob& job) {
    if (!job.last_words.empty()) sentence += " Its last message: " + job.last_words.back();
    return sentence;
}

}  // namespace

void LineSplitter::add(std::string_view text) {
    waiting_ += text;
}

bool LineSplitter::take(std::string& line) {
    const std::size_t end = waiting_.find('\n');
    if (end == std::string::npos) {
        if (waiting_.size() <= kLongestLine) return false;
        // Cuts overlong lines; the rest counts as a new line.
        line = waiting_.substr(0, kLongestLine);
        waiting_.clear();
        return true;
    }
    line = waiting_.substr(0, end);
    waiting_.erase(0, end + 1);
    return true;
}

void readProgressLine(const std::string& line, ui::ExportJob& job) {
    if (line.empty()) return;
    const json told = parseBoundedJson(line, "").value_or(json());
    if (!told.is_object()) {
        remember(line.substr(0, 500), job);
        return;
    }
    if (const auto record = told.find("log"); record != told.end()) {
        if (record->is_object()) passOn(*record, job);
        return;
    }
    if (const auto error = told.find("error"); error != told.end()) {
        if (!error->is_object()) return;
        job.error = {codeNamed(textIn(*error, "code")), textIn(*error, "message"),
                     textIn(*error, "where")};
        return;
    }
    job.frames_done = countIn(told, "frames_done", job.frames_done);
    job.frames = countIn(told, "frames", job.frames);
    if (told.contains("done")) {
        job.reported_end = true;
        return;
    }
    if (const std::string stage = textIn(told, "stage"); !stage.empty()) job.stage = stage;
    job.fraction = std::clamp(numberIn(told, "fraction", job.fraction), 0.0, 1.0);
    job.frames_per_s = std::max(0.0, numberIn(told, "frames_per_s", job.frames_per_s));
    job.seconds_left = std::max(0.0, numberIn(told, "seconds_left", 0.0));
}

void concludeJob(const Outcome& outcome, ui::ExportJob& job) {
    const ProcessEnd& end = outcome.end;
    using ui::ExportState;
    job.seconds_left = 0.0;
    if (end.exit_code == 0 && outcome.dataset && job.reported_end) {
        job.state = ExportState::Done;
        job.fraction = 1.0;
        job.error = {};
        return;
    }
    const bool stopped = job.error.code == ErrorCode::Cancelled || end.exit_code == 130 ||
                         end.exit_code == 143 || end.signal == SIGTERM || end.signal == SIGINT;
    if (outcome.cancelled || stopped) {
        job.state = ExportState::Cancelled;
        job.error = {};
        return;
    }
    job.state = ExportState::Failed;
    if (end.exit_code > 0 && !job.error.message.empty()) return;
    job.error.code = ErrorCode::Failed;
    job.error.where = job.request.folder.string();
    if (end.signal != 0) {
        job.error.message =
            withLastWords(fmt::format("The export program was ended by the system ({}); its "
                                      "finished frames are kept: press Continue to resume.",
                                      strsignal(end.signal)),
                          job);
    } else if (end.exit_code == 0) {
        job.error.message = withLastWords(
            "The export program ended without finishing a dataset; check that it has the editor's "
            "version.",
            job);
    } else {
        job.error.message = withLastWords(
            fmt::format("The export program failed with exit code {} and gave no reason; run it "
                        "in a terminal to see more.",
                        end.exit_code),
            job);
    }
}

}  // namespace dollytrack::editor
