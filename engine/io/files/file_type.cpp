#include "engine/io/files/file_type.h"

#include <cctype>

namespace dollytrack {

std::string_view withoutByteOrderMark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

std::string_view fromFirstLetter(std::string_view head) {
    head = withoutByteOrderMark(head);
    const auto at = head.find_first_not_of(" \t\r\n");
    return at == std::string_view::npos ? std::string_view() : head.substr(at);
}

char firstLetter(std::string_view head) {
    const std::string_view text = fromFirstLetter(head);
    return text.empty() ? '\0' : text.front();
}

std::string lowerExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace dollytrack
