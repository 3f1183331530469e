#include "render/dataset_folder.h"

#include "engine/io/bounded_json.h"
#include "engine/io/durable_file.h"
#include "render/formats/dataset_card.h"
#include "render/formats/fold_files.h"
#include "render/formats/formats.h"
#include "render/rig_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <chrono>
#include <functional>
#include <map>
#include <system_error>
#include <thread>
#include <utility>

namespace dollytrack::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJournal = ".dollytrack-export";

Error asError(const std::error_code& error, const fs::path& path) {
    return io::writeError(error.value(), path);
}

/// 000000.png, 000000_000001.flo, and what a killed run left of them (000000.png.tmp.123).
bool isFrameFile(const std::string& name) {
    const std::size_t digits = name.find_first_not_of("0123456789");
    return digits != std::string::npos && digits >= 6 &&
           (name[digits] == '.' || name[digits] == '_');
}

/// The folders that hold a file for each frame, whichever are written.
std::set<std::string> frameFolders(const ModalitySet& modalities, const FormatSet& formats) {
    std::set<std::string> folders;
    for (const Modality* modality : modalities) folders.insert(modality->name);
    for (const Format* format : formats) {
        folders.insert(format->folders.begin(), format->folders.end());
    }
    return folders;
}

std::set<std::string> allFrameFolders() {
    ModalitySet all_modalities;
    for (const Modality& modality : modalities()) all_modalities.push_back(&modality);
    FormatSet all_formats;
    for (const Format& format : formats()) all_formats.push_back(&format);
    return frameFolders(all_modalities, all_formats);
}

/// The files beside the images, dataset.json first: it says that the others are complete.
std::vector<std::string> fixedFiles() {
    std::vector<std::string> names = {"dataset.json", "contact_sheet.jpg"};
    for (const Format& format : formats()) {
        names.insert(names.end(), format.files.begin(), format.files.end());
    }
    return names;
}

/// Names in a folder; none when there is no such folder. A loop over the iterator itself would
/// throw where reading the folder fails half-way.
std::vector<std::string> namesIn(const fs::path& folder, std::error_code& error) {
    std::vector<std::string> names;
    fs::directory_iterator at(folder, error);
    if (error == std::errc::no_such_file_or_directory) error.clear();
    while (!error && at != fs::directory_iterator()) {
        names.push_back(at->path().filename().string());
        at.increment(error);
    }
    return names;
}

/// Those that the cameras of any rig have.
std::set<std::string> rigFoldersIn(const fs::path& folder, std::error_code& error) {
    std::set<std::string> folders;
    for (const std::string& name : namesIn(folder / kRigModality, error)) {
        std::error_code unknown;
        if (!fs::is_directory(folder / kRigModality / name, unknown)) continue;
        for (const std::string& one : rigFoldersOf(name)) folders.insert(one);
    }
    return folders;
}

/// Relative paths of all files of a dataset and of what a killed run left of them, in the order in
/// which they are to be removed.
std::vector<std::string> datasetFiles(const fs::path& folder, std::error_code& error) {
    std::vector<std::string> files;
    for (const std::string& fixed : fixedFiles()) {
        if (error) break;
        const fs::path within = fs::path(fixed).parent_path();
        const std::string wanted = fs::path(fixed).filename().string();
        for (const std::string& name : namesIn(folder / within, error)) {
            if (name == wanted || name.starts_with(wanted + ".tmp.")) {
                files.push_back((within / name).string());
            }
        }
    }
    for (const std::string& name : namesIn(folder / kFoldFolder, error)) {
        if (isFoldFile(name)) files.push_back(std::string(kFoldFolder) + "/" + name);
    }
    std::set<std::string> subfolders = allFrameFolders();
    subfolders.merge(rigFoldersIn(folder, error));
    for (const std::string& subfolder : subfolders) {
        if (error) break;
        for (const std::string& name : namesIn(folder / subfolder, error)) {
            if (isFrameFile(name)) files.push_back(subfolder + "/" + name);
        }
    }
    return files;
}

/// The folders of files beside the images, the innermost first.
std::set<fs::path, std::greater<>> fixedFolders() {
    std::set<fs::path, std::greater<>> folders = {kFoldFolder};
    for (const std::string& fixed : fixedFiles()) {
        for (fs::path at = fs::path(fixed).parent_path(); !at.empty(); at = at.parent_path()) {
            folders.insert(at);
        }
    }
    return folders;
}

/// Many datasets have a dataset.json; ours says so in it.
bool isOurCard(const fs::path& path) {
    using Json = nlohmann::json;
    // Somebody else's may be huge: nothing but its `format` is kept.
    const auto keep = [](int depth, Json::parse_event_t event, Json& parsed) {
        return depth != 1 || event != Json::parse_event_t::key || parsed == "format";
    };
    const Json card = io::readBoundedJson<Json>(path, keep).value_or(Json());
    return card.is_object() && card.contains("format") && card["format"] == kDatasetFormat;
}

/// How many frames a dataset.json of ours lists.
std::size_t framesListed(const fs::path& path) {
    using Json = nlohmann::json;
    std::size_t count = 0;
    std::string section;
    const auto count_only = [&](int depth, Json::parse_event_t event, Json& parsed) {
        if (depth == 1 && event == Json::parse_event_t::key) section = parsed.get<std::string>();
        const bool begins = event == Json::parse_event_t::object_start;
        if (begins && depth == 2 && section == "frames") ++count;
        return depth < 2;
    };
    return io::readBoundedJson<Json>(path, count_only) ? count : 0;
}

Status makeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return tl::unexpected<Error>(asError(error, folder));
    // create_directories is content with a file in the folder's place.
    if (!fs::is_directory(folder, error)) {
        return tl::unexpected<Error>(io::writeError(ENOTDIR, folder));
    }
    return {};
}

/// Whether a descriptor still is what its path names: the export before may just have ended and
/// removed its journal.
bool isAt(int descriptor, const fs::path& path) {
    struct stat held {};
    struct stat named {};
    return ::fstat(descriptor, &held) == 0 && ::stat(path.c_str(), &named) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

/// Whether another export holds the lock, and keeps it. One that was just killed may hold it until
/// the system has taken its memory back.
bool isTaken(int lock) {
    constexpr int kTries = 40;
    for (int i = 0; i < kTries; ++i) {
        // Some file systems know no locks: there, two exports are the user's to keep apart.
        if (::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
}

}  // namespace

DatasetFolder::~DatasetFolder() {
    if (!lock_.valid()) return;
    // Before the lock goes: another export may mark it as its own at once.
    if (marked_) ::unlink(journal().c_str());
    if (made_) ::rmdir(folder_.c_str());
}

fs::path DatasetFolder::journal() const {
    return folder_ / kJournal;
}

Result<DatasetFolder> DatasetFolder::claim(const fs::path& folder, bool overwrite) {
    std::error_code error;
    DatasetFolder claimed;
    claimed.folder_ = folder;
    claimed.made_ = !fs::exists(folder, error);
    if (Status status = makeFolder(folder); !status) return tl::unexpected(status.error());
    const fs::path journal = claimed.journal();
    const bool was_marked = fs::exists(journal, error);
    if (!overwrite && !was_marked && !isOurCard(folder / "dataset.json") &&
        !fs::is_empty(folder, error)) {
        return fail(ErrorCode::CannotWrite,
                    "the folder holds files that are not a Dollytrack dataset; choose an empty "
                    "folder, or give --overwrite",
                    folder.string());
    }
    if (error) return tl::unexpected<Error>(asError(error, folder));
    io::FileDescriptor lock(::open(journal.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (!lock.valid()) return tl::unexpected<Error>(io::writeError(errno, folder));
    if (isTaken(lock.get()) || !isAt(lock.get(), journal)) {
        return fail(ErrorCode::CannotWrite,
                    "another export is writing into this folder; wait for it, stop it, or choose "
                    "another folder",
                    folder.string());
    }
    claimed.lock_ = std::move(lock);
    claimed.marked_ = !was_marked;
    return claimed;
}

bool DatasetFolder::isComplete() const {
    return isOurCard(folder_ / "dataset.json");
}

Status DatasetFolder::checkNotComplete() const {
    if (!isComplete()) return {};
    const std::size_t frames = framesListed(folder_ / "dataset.json");
    return fail(ErrorCode::Usage,
                "the folder holds a complete dataset of " + std::to_string(frames) + " frame" +
                    (frames == 1 ? "" : "s") +
                    "; choose another folder, give --overwrite to replace it, or --resume to check "
                    "that it is the one wanted",
                folder_.string());
}

bool DatasetFolder::isThere() const {
    return lock_.valid() && isAt(lock_.get(), journal());
}

Status DatasetFolder::checkSpace(std::uint64_t bytes, const std::set<std::string>& keep) const {
    struct statvfs space {};
    if (::statvfs(folder_.c_str(), &space) != 0 || space.f_blocks == 0) return {};
    std::uint64_t free = std::uint64_t{space.f_bavail} * space.f_frsize;
    std::error_code ignored;
    for (const std::string& file : datasetFiles(folder_, ignored)) {
        struct stat held {};
        // What it takes on the disk, and only when no other name keeps it there.
        if (keep.count(file) == 0 && ::lstat((folder_ / file).c_str(), &held) == 0 &&
            held.st_nlink == 1) {
            free += static_cast<std::uint64_t>(held.st_blocks) * 512U;
        }
    }
    if (bytes <= free) return {};
    return fail(ErrorCode::CannotWrite,
                "about " + std::to_string(bytes / 1'000'000 + 1) + " MB are needed and " +
                    std::to_string(free / 1'000'000) +
                    " MB are free; free some space or choose another folder",
                folder_.string());
}

Status DatasetFolder::begin(const ModalitySet& modalities, const FormatSet& formats,
                            const std::set<std::string>& keep,
                            const std::vector<std::string>& more) {
    made_ = false;
    marked_ = false;
    std::error_code error;
    for (const std::string& file : datasetFiles(folder_, error)) {
        if (keep.count(file) != 0) continue;
        fs::remove(folder_ / file, error);
        if (error) return tl::unexpected<Error>(asError(error, folder_ / file));
    }
    if (error) return tl::unexpected<Error>(asError(error, folder_));
    std::set<std::string> wanted = frameFolders(modalities, formats);
    wanted.insert(more.begin(), more.end());
    std::set<std::string> subfolders = allFrameFolders();
    subfolders.merge(rigFoldersIn(folder_, error));
    if (error) return tl::unexpected<Error>(asError(error, folder_));
    // Only empty ones go, the innermost first; the formats' files make theirs.
    for (const fs::path& subfolder : fixedFolders()) ::rmdir((folder_ / subfolder).c_str());
    for (const std::string& subfolder : subfolders) {
        if (wanted.contains(subfolder)) continue;
        for (fs::path at = subfolder; !at.empty(); at = at.parent_path()) {
            ::rmdir((folder_ / at).c_str());
        }
    }
    for (const Format* format : formats) {
        for (const char* file : format->files) {
            const fs::path within = fs::path(file).parent_path();
            if (!within.empty()) wanted.insert(within.string());
        }
    }
    for (const std::string& subfolder : wanted) {
        if (Status status = makeFolder(folder_ / subfolder); !status) return status;
    }
    return {};
}

Status DatasetFolder::release() {
    if (::unlink(journal().c_str()) != 0) {
        return tl::unexpected<Error>(io::writeError(errno, journal()));
    }
    (void)lock_.close();
    return io::syncFolder(folder_);
}

}  // namespace dollytrack::render
