#include "app/cli/command_line.h"

#include "app/cli/terminal/progress_bar.h"
#include "app/cli/terminal/progress_lines.h"

namespace dollytrack::cli {

JobContext Session::job() const {
    if (lines) return lines->context(cancelled);
    return {cancelled, quiet ? JobContext::Progress{} : ProgressBar().callback()};
}

}  // namespace dollytrack::cli
