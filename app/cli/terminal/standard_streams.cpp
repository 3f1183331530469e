#include "app/cli/terminal/standard_streams.h"

#include "engine/core/clean_lines.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

namespace dollytrack::cli {
namespace {

/// Write function of the stdio stream. Returns 0 on error, with errno set.
ssize_t writeClean(void* cleaner, const char* text, std::size_t size) {
    const std::string clean = static_cast<LineCleaner*>(cleaner)->add({text, size});
    std::string_view rest = clean;
    while (!rest.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return 0;
        rest.remove_prefix(written);
    }
    return static_cast<ssize_t>(size);
}

}  // namespace

void cleanStandardOutput() {
    // Never destroyed: stdio flushes its streams at the very end of the program.
    static LineCleaner* const cleaner = new LineCleaner;
    std::FILE* clean = ::fopencookie(cleaner, "w", {nullptr, writeClean, nullptr, nullptr});
    if (clean == nullptr) return;
    (void)std::setvbuf(clean, nullptr, isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF, BUFSIZ);
    (void)std::fflush(stdout);
    stdout = clean;
}

Status finishStandardOutput() {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
    return fail(ErrorCode::CannotWrite, "the results cannot be written to standard output.");
}

void printToStandardError(std::string_view message) {
    const std::string line = cleanLines(message) + "\n";
    (void)std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace dollytrack::cli
