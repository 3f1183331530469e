#include "engine/io/files/text_file.h"

#include "engine/io/files/input_file.h"

namespace dollytrack {

Result<std::string> readText(const std::filesystem::path& path, std::size_t most_mebibytes) {
    return readNamedFile(path, std::uint64_t{most_mebibytes} << 20U);
}

}  // namespace dollytrack
