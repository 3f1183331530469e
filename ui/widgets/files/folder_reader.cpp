#include "ui/widgets/files/folder_reader.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <memory>
#include <numeric>
#include <string_view>
#include <system_error>

namespace dollytrack::ui {
namespace {

namespace fs = std::filesystem;

std::string errorText(int code) {
    return std::error_code(code, std::generic_category()).message();
}

/// Returns null if the job was cancelled.
std::shared_ptr<const FolderListing> readFolder(const fs::path& folder, const JobContext& job) {
    auto listing = std::make_shared<FolderListing>();
    listing->folder = folder;
    const std::unique_ptr<DIR, int (*)(DIR*)> stream(::opendir(folder.c_str()), &::closedir);
    if (!stream) {
        listing->problem = "This folder cannot be read (" + errorText(errno) + "). Choose another.";
        return listing;
    }
    // readdir() also reports the entry type; std::filesystem would need an extra call per entry.
    for (std::size_t count = 0;; ++count) {
        if (count % 64 == 0 && job.cancelled()) return nullptr;
        errno = 0;
        const dirent* entry = ::readdir(stream.get());
        if (entry == nullptr) {
            if (errno != 0) {
                listing->problem =
                    "Not all of this folder could be read (" + errorText(errno) + ").";
            }
            return listing;
        }
        const std::string_view name = entry->d_name;
        if (name == "." || name == "..") continue;
        FolderEntry found;
        found.name = name;
        found.is_folder = entry->d_type == DT_DIR;
        struct stat info = {};
        // A dangling link is listed as a file; opening it reports the error.
        if (::fstatat(::dirfd(stream.get()), entry->d_name, &info, 0) == 0) {
            found.is_folder = S_ISDIR(info.st_mode);
            found.bytes = found.is_folder ? 0 : static_cast<std::uint64_t>(info.st_size);
            found.modified_s = info.st_mtime;
        }
        listing->entries.push_back(std::move(found));
    }
}

fs::path nearestFolder(fs::path path) {
    std::error_code error;
    while (!fs::exists(path, error) && path.has_relative_path()) path = path.parent_path();
    return path;
}

std::optional<PathAnswer> lookAtPath(fs::path path, bool nearest, const JobContext& job) {
    std::error_code error;
    path = fs::absolute(path, error).lexically_normal();
    if (!path.has_filename() && path.has_relative_path()) path = path.parent_path();
    if (nearest) path = nearestFolder(path);
    PathAnswer answer;
    answer.path = path;
    answer.parent_is_folder = fs::is_directory(path.parent_path(), error);
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return answer;
    if (!fs::is_directory(status)) {
        answer.found = PathAnswer::Found::File;
        return answer;
    }
    answer.found = PathAnswer::Found::Folder;
    answer.listing = readFolder(path, job);
    if (!answer.listing) return std::nullopt;
    return answer;
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Natural order: "room_9" before "Room_10"; names that differ only in case have a fixed order.
int compareNames(std::string_view a, std::string_view b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (isDigit(a[i]) && isDigit(b[j])) {
            while (i < a.size() && a[i] == '0') ++i;
            while (j < b.size() && b[j] == '0') ++j;
            const std::size_t begin_a = i;
            const std::size_t begin_b = j;
            while (i < a.size() && isDigit(a[i])) ++i;
            while (j < b.size() && isDigit(b[j])) ++j;
            if (i - begin_a != j - begin_b) return i - begin_a < j - begin_b ? -1 : 1;
            const int digits =
                a.substr(begin_a, i - begin_a).compare(b.substr(begin_b, j - begin_b));
            if (digits != 0) return digits;
            continue;
        }
        const int x = std::tolower(static_cast<unsigned char>(a[i++]));
        const int y = std::tolower(static_cast<unsigned char>(b[j++]));
        if (x != y) return x < y ? -1 : 1;
    }
    if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j ? -1 : 1;
    return a.compare(b);
}

int compareEntries(const FolderEntry& a, const FolderEntry& b, FolderOrder::Key key) {
    if (key == FolderOrder::Key::Date && a.modified_s != b.modified_s) {
        return a.modified_s < b.modified_s ? -1 : 1;
    }
    if (key == FolderOrder::Key::Size && a.bytes != b.bytes) return a.bytes < b.bytes ? -1 : 1;
    return compareNames(a.name, b.name);
}

bool isShown(const FolderEntry& entry, const FolderOrder& order) {
    if (!order.hidden && entry.name.starts_with('.')) return false;
    if (entry.is_folder) return true;
    if (order.folders_only) return false;
    if (order.extensions.empty()) return true;
    std::string extension = fs::path(entry.name).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::ranges::find(order.extensions, extension) != order.extensions.end();
}

}  // namespace

std::vector<std::uint32_t> arrange(const FolderListing& listing, const FolderOrder& order) {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < listing.entries.size(); ++i) {
        if (isShown(listing.entries[i], order)) rows.push_back(i);
    }
    std::ranges::sort(rows, [&](std::uint32_t i, std::uint32_t j) {
        const FolderEntry& a = listing.entries[i];
        const FolderEntry& b = listing.entries[j];
        if (a.is_folder != b.is_folder) return a.is_folder;
        const int comparison = compareEntries(a, b, order.key);
        return order.descending ? comparison > 0 : comparison < 0;
    });
    return rows;
}

void FolderReader::look(const fs::path& path, bool nearest) {
    worker_.start([answer = answer_, path, nearest](const JobContext& job) {
        auto found = lookAtPath(path, nearest, job);
        if (found && !job.cancelled()) answer->put(std::move(*found));
    });
}

void FolderReader::makeFolder(const fs::path& path) {
    worker_.start([answer = answer_, path](const JobContext& job) {
        if (::mkdir(path.c_str(), 0777) != 0) {
            PathAnswer failed;
            failed.path = path;
            failed.problem = errno == EEXIST
                                 ? "A file or folder '" + path.filename().string() +
                                       "' already exists. Choose another name."
                                 : "The folder cannot be created here (" + errorText(errno) + ").";
            answer->put(std::move(failed));
            return;
        }
        if (auto found = lookAtPath(path, false, job)) answer->put(std::move(*found));
    });
}

void FolderSorter::arrange(std::shared_ptr<const FolderListing> listing, const FolderOrder& order) {
    worker_.start([answer = answer_, listing = std::move(listing), order](const JobContext& job) {
        Answer sorted{listing, ui::arrange(*listing, order)};
        if (!job.cancelled()) answer->put(std::move(sorted));
    });
}

}  // namespace dollytrack::ui
