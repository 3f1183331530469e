#include "engine/io/text_file.h"

#include <array>
#include <fstream>

namespace dollytrack::io {

Result<std::string> readText(const std::filesystem::path& path, std::size_t most_mebibytes) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        return fail(ErrorCode::BadInput, "There is no such file.", path.string());
    }
    std::ifstream file(path, std::ios::binary);
    if (std::filesystem::is_directory(path, error) || !file) {
        return fail(ErrorCode::BadInput, "The file cannot be read.", path.string());
    }
    // A pipe has no size to ask for, so the bytes are counted as they come.
    std::string text;
    std::array<char, 1U << 16U> part{};
    while (file.read(part.data(), part.size()) || file.gcount() > 0) {
        text.append(part.data(), static_cast<std::size_t>(file.gcount()));
        if (text.size() > most_mebibytes << 20U) {
            return fail(ErrorCode::BadInput,
                        "It is larger than " + std::to_string(most_mebibytes) + " MiB.",
                        path.string());
        }
    }
    if (file.bad()) {
        return fail(ErrorCode::BadInput, "The file cannot be read.", path.string());
    }
    return text;
}

}  // namespace dollytrack::io
