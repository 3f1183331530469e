#pragma once

#include "app/process/child_process.h"
#include "ui/export_job.h"

#include <string>
#include <string_view>

namespace dollytrack::editor {

/// Splits a program's output into lines.
class LineSplitter {
  public:
    /// Appends output of the program.
    void add(std::string_view text);
    /// Takes the next whole line; returns false if there is none. Lines longer than 64 KiB are
    /// split.
    [[nodiscard]] bool take(std::string& line);
    /// Takes the incomplete last line; empty if there is none.
    [[nodiscard]] std::string rest() { return std::move(waiting_); }

  private:
    std::string waiting_;
};

/// Updates a job from a line of `dollytrack export --progress json`. Its log records are passed to
/// our log. Lines that are not JSON are stored in the job's last_words; values of a wrong type are
/// ignored.
void readProgressLine(const std::string& line, ui::ExportJob& job);

/// State at the end of the export program.
struct Outcome {
    ProcessEnd end;
    bool cancelled = false;  // it was asked to stop
    bool dataset = false;    // a complete dataset is in the folder
};
void concludeJob(const Outcome& outcome, ui::ExportJob& job);

}  // namespace dollytrack::editor
