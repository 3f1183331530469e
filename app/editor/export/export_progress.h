#pragma once

#include "app/process/child_process.h"
#include "ui/export_job.h"

#include <string>
#include <string_view>

namespace dollytrack::editor {

/// Cuts what a program says into lines, however it arrives.
class LineCutter {
  public:
    /// The next whole line of what was added, if there is one. Lines too long for any message are
    /// cut short.
    void add(std::string_view text);
    [[nodiscard]] bool take(std::string& line);
    /// What is left without an end.
    [[nodiscard]] std::string rest() { return std::move(waiting_); }

  private:
    std::string waiting_;
};

/// Brings a job up to date with a line of `dollytrack export --progress json`. Log lines go to our
/// own log. A line that is no JSON is kept among the job's last words; values of a wrong kind are
/// passed over.
void readProgressLine(const std::string& line, ui::ExportJob& job);

/// What there is when the program has ended.
struct Outcome {
    ProcessEnd end;
    bool cancelled = false;  // somebody asked it to stop
    bool dataset = false;    // a finished dataset is in the folder
};
void concludeJob(const Outcome& outcome, ui::ExportJob& job);

}  // namespace dollytrack::editor
