#include "app/editor/files/known_files.h"

#include "engine/io/files/sha256.h"

namespace dollytrack::editor {

void KnownFiles::remember(const std::filesystem::path& file, const std::string& sha256) {
    const std::lock_guard lock(mutex_);
    contents_[file] = sha256;
}

std::string KnownFiles::contentOf(const std::filesystem::path& file) const {
    const std::lock_guard lock(mutex_);
    const auto at = contents_.find(file);
    return at == contents_.end() ? std::string() : at->second;
}

bool KnownFiles::changedElsewhere(const std::filesystem::path& file) const {
    const std::string known = contentOf(file);
    std::error_code error;
    if (known.empty() || !std::filesystem::exists(file, error)) return false;
    // Size and time are not reliable: programs restore times, and copies keep them.
    const Result<std::string> now = sha256OfFile(file);
    return !now || *now != known;
}

}  // namespace dollytrack::editor
