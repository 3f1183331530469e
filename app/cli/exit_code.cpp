#include "app/cli/exit_code.h"

#include <new>
#include <string>
#include <string_view>
#include <system_error>

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

Error errorOf(const std::exception& exception) {
    if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr) {
        return {ErrorCode::Failed,
                "out of memory; plan with a larger octree_resolution_m, export smaller images, or "
                "raise the memory limit.",
                {}};
    }
    const auto* system = dynamic_cast<const std::system_error*>(&exception);
    const bool no_thread = system != nullptr
                               ? system->code() == std::errc::resource_unavailable_try_again
                               // TBB's error message.
                               : std::string_view(exception.what()).starts_with("pthread_create");
    if (no_thread) {
        return {ErrorCode::Failed,
                "no more threads can be started; set fewer with --threads, or raise the limits on "
                "memory and processes.",
                {}};
    }
    return {ErrorCode::Failed, std::string("unexpected failure: ") + exception.what(), {}};
}

}  // namespace dollytrack::cli
