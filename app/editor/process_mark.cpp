#include "app/editor/process_mark.h"

#include <unistd.h>

#include <charconv>
#include <fstream>

namespace dollytrack::editor {
namespace {

/// When the process began, in clock ticks since boot. Empty when there is no such process.
std::string startOf(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t end_of_name = text.rfind(')');
    if (end_of_name == std::string::npos) return {};
    std::size_t at = end_of_name + 2;
    for (int field = 3; field < 22; ++field) at = text.find(' ', at) + 1;
    return text.substr(at, text.find(' ', at) - at);
}

}  // namespace

std::string processMark() {
    return std::to_string(getpid()) + "-" + startOf(getpid());
}

bool processRuns(std::string_view mark) {
    const std::size_t dash = mark.find('-');
    if (dash == std::string_view::npos) return false;
    int process = 0;
    const auto parsed = std::from_chars(mark.data(), mark.data() + dash, process);
    if (parsed.ec != std::errc() || parsed.ptr != mark.data() + dash || process <= 0) return false;
    return startOf(process) == mark.substr(dash + 1);
}

}  // namespace dollytrack::editor
