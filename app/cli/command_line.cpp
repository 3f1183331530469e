#include "app/cli/command_line.h"

#include "app/cli/terminal/progress_bar.h"
#include "app/cli/terminal/progress_lines.h"

namespace dollytrack::cli {

int exitCodeFor(ErrorCode code) {
    switch (code) {
        case ErrorCode::Usage:
            return kUsage;
        case ErrorCode::BadInput:
            return kBadInput;
        case ErrorCode::NoOpenGl:
            return kNoOpenGl;
        case ErrorCode::CannotWrite:
            return kCannotWrite;
        case ErrorCode::Cancelled:
        case ErrorCode::Failed:
            break;
    }
    return kFailed;
}

JobContext Session::job() const {
    if (lines) return lines->context(cancelled);
    return {cancelled, quiet ? JobContext::Progress{} : ProgressBar().callback()};
}

}  // namespace dollytrack::cli
