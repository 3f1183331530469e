#include "app/batch/log_end.h"

#include "engine/io/files/input_file.h"

#include <algorithm>
#include <cstdint>

namespace dollytrack::batch {

std::string endOf(const std::filesystem::path& log, std::size_t bytes) {
    const Result<InputFile> file = openNamedFile(log);
    if (!file) return {};
    const bool cut = file->size() > bytes;
    std::string end(std::min<std::uint64_t>(bytes, file->size()), '\0');
    end.resize(file->read(file->size() - end.size(), end.data(), end.size()));
    // Removes an incomplete first line, unless it is the only one.
    const std::size_t line_end = end.find('\n');
    if (cut && line_end + 1 < end.size()) end.erase(0, line_end + 1);
    return end;
}

}  // namespace dollytrack::batch
