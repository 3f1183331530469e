#include "render/dataset/folder/dataset_folder.h"

#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "render/dataset/folder/dataset_journal.h"
#include "render/formats/tables/fold_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ranges>
#include <thread>
#include <utility>

namespace dollytrack::render {
namespace {

namespace fs = std::filesystem;

// Inside the dataset's folder, so that both are on one disk and nothing outside is written.
constexpr const char* kNewFolder = ".dollytrack-new";
// Name of the old dataset.json in the new dataset's folder while the new one takes its place. If
// this file exists, the new dataset is the valid one.
constexpr const char* kReplacedCard = "replaced.json";
constexpr int kMostLevels = 8;

/// Whether a descriptor still refers to the file at `path`; another export may just have ended and
/// removed its journal.
bool isAt(int descriptor, const fs::path& path) {
    struct stat held {};
    struct stat named {};
    return ::fstat(descriptor, &held) == 0 && ::lstat(path.c_str(), &named) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

/// The folder and its missing parents, innermost first.
std::vector<fs::path> missingFolders(const fs::path& folder) {
    std::vector<fs::path> missing;
    std::error_code error;
    fs::path at = folder.has_filename() ? folder : folder.parent_path();
    for (; !at.empty() && !fs::exists(fs::symlink_status(at, error)); at = at.parent_path()) {
        missing.push_back(at);
    }
    return missing;
}

/// Whether another export keeps the lock for two seconds. An export that was just killed may hold
/// it until the system has freed its memory.
bool isTaken(int lock) {
    constexpr int kTries = 40;
    for (int i = 0; i < kTries; ++i) {
        // Some file systems have no locks; there the user must keep exports apart.
        if (::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
}

std::string folderOf(const std::string& file) {
    const std::size_t slash = file.rfind('/');
    return slash == std::string::npos ? std::string() : file.substr(0, slash);
}

/// Relative paths of everything in a folder that only this program writes to.
Status listAll(const GuardedFolder& folder, const std::string& within, int levels,
               std::vector<std::string>& files, std::vector<std::string>& folders) {
    const Result<std::vector<std::string>> names = folder.list(within);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) {
        const std::string path = within.empty() ? name : within + "/" + name;
        const auto found = folder.find(path);
        if (!found) continue;
        if (!S_ISDIR(found->st_mode)) {
            files.push_back(path);
            continue;
        }
        folders.push_back(path);
        if (levels == 0) continue;
        Status status = listAll(folder, path, levels - 1, files, folders);
        if (!status) return status;
    }
    return {};
}

}  // namespace

DatasetFolder::~DatasetFolder() {
    if (begun_) return;
    if (lock_.valid() && marked_) {
        for (const std::string& folder : std::views::reverse(made_within_)) {
            unfinished().removeEmpty(folder);
        }
        if (made_staged_) folder_.removeEmpty(kNewFolder);
        // Before the lock is released: another export may create its own mark at once.
        (void)folder_.remove(kJournalFile);
    }
    for (const fs::path& folder : made_around_) ::rmdir(folder.c_str());
}

Result<DatasetFolder> DatasetFolder::claim(const fs::path& folder, bool overwrite,
                                           const fs::path& root) {
    std::vector<fs::path> made_around = missingFolders(folder);
    Result<GuardedFolder> opened = GuardedFolder::makeBelow(folder, root);
    // Another refused export may be removing a parent folder right now.
    for (int i = 0; !opened && i < 3; ++i) opened = GuardedFolder::makeBelow(folder, root);
    if (!opened) return tl::unexpected(opened.error());
    DatasetFolder claimed(std::move(*opened));
    claimed.made_around_ = std::move(made_around);
    const GuardedFolder& own = claimed.folder_;
    // An empty journal was left by an export that was killed before it began.
    const auto journal = own.find(kJournalFile);
    const bool was_marked = journal && journal->st_size > 0;
    const Result<bool> complete = hasOurCard(own);
    if (!complete) return tl::unexpected(complete.error());
    if (!overwrite && !was_marked && !*complete) {
        const Result<std::vector<std::string>> names = own.list("");
        if (!names) return tl::unexpected(names.error());
        const auto other = std::ranges::find_if(
            *names, [](const std::string& name) { return name != kJournalFile; });
        if (other != names->end()) {
            return fail(ErrorCode::CannotWrite,
                        fmt::format("the folder contains '{}' but is not a Dollytrack dataset; "
                                    "choose an empty folder, or pass --overwrite",
                                    *other),
                        folder.string());
        }
    }
    Result<FileDescriptor> lock = own.openFile(kJournalFile, O_RDWR | O_CREAT);
    if (!lock) return tl::unexpected(lock.error());
    if (isTaken(lock->get()) || !isAt(lock->get(), folder / kJournalFile)) {
        return fail(ErrorCode::CannotWrite,
                    "another export is writing into this folder; wait for it, stop it, or choose "
                    "another folder",
                    folder.string());
    }
    claimed.lock_ = std::move(*lock);
    claimed.marked_ = !was_marked;
    if (own.has(kNewFolder)) {
        Result<GuardedFolder> staged = own.openWithin(kNewFolder);
        if (!staged) return tl::unexpected(staged.error());
        const Result<std::vector<std::string>> names = staged->list("");
        if (!names) return tl::unexpected(names.error());
        if (names->empty()) {
            own.removeEmpty(kNewFolder);
        } else {
            claimed.staged_ = std::move(*staged);
        }
    }
    if (claimed.isMoving()) {
        if (Status status = claimed.moveIntoPlace(); !status) {
            return tl::unexpected(status.error());
        }
    }
    // Another export may have finished before this one got the lock.
    const Result<bool> complete_now = hasOurCard(own);
    if (!complete_now) return tl::unexpected(complete_now.error());
    claimed.complete_ = *complete_now;
    return claimed;
}

Status DatasetFolder::checkNotComplete() const {
    if (!isComplete()) return {};
    const std::size_t frames = framesListed(folder_);
    return fail(ErrorCode::Usage,
                "the folder already holds a complete dataset of " + std::to_string(frames) +
                    " frame" + (frames == 1 ? "" : "s") +
                    "; choose another folder, or pass --overwrite to replace it, or --resume to "
                    "check that it is the requested one",
                path().string());
}

bool DatasetFolder::isThere() const {
    return lock_.valid() && isAt(lock_.get(), path() / kJournalFile);
}

Result<std::vector<std::string>> DatasetFolder::leftFiles(const std::set<std::string>& keep) const {
    std::vector<std::string> files;
    if (staged_) {
        std::vector<std::string> folders;
        if (Status status = listAll(*staged_, "", kMostLevels, files, folders); !status) {
            return tl::unexpected(status.error());
        }
    } else if (!isComplete()) {
        const JournalContents journal = readJournal(folder_);
        Result<std::vector<std::string>> named = filesNamed(folder_, journal.names);
        if (!named) return named;
        files = std::move(*named);
        for (const auto& [index, entry] : journal.entries) {
            for (const auto& [file, hash] : entry.sha256s) {
                if (GuardedFolder::isPlain(file) && folder_.has(file)) files.push_back(file);
            }
        }
    }
    std::erase_if(files, [&](const std::string& file) { return keep.contains(file); });
    return files;
}

Status DatasetFolder::checkSpace(std::uint64_t bytes, const std::set<std::string>& keep) const {
    const std::optional<std::uint64_t> now = folder_.freeBytes();
    const Result<std::vector<std::string>> left = leftFiles(keep);
    if (!now || !left) return {};  // begin() will report the problem
    std::uint64_t free = *now;
    for (const std::string& file : std::set<std::string>(left->begin(), left->end())) {
        const auto held = unfinished().find(file);
        // Only files without further hard links free their disk space.
        if (held && held->st_nlink == 1) free += static_cast<std::uint64_t>(held->st_blocks) * 512U;
    }
    if (bytes <= free) return {};
    return fail(ErrorCode::CannotWrite,
                "about " + std::to_string(bytes / 1'000'000 + 1) + " MB are needed" +
                    (isComplete() ? " beside the old dataset" : "") + " and " +
                    std::to_string(free / 1'000'000) +
                    " MB are free; free some space or choose another folder",
                path().string());
}

Status DatasetFolder::begin(const DatasetNames& names, const std::set<std::string>& keep) {
    // Checked before drawing: nothing may be in the way of the new dataset's files.
    std::set<std::string> wanted = names.folders;
    for (const std::string& file : names.files) wanted.insert(folderOf(file));
    wanted.erase("");
    for (const std::string& folder : wanted) {
        if (Status status = folder_.checkFolder(folder); !status) return status;
    }
    const Result<std::vector<std::string>> in_the_way = filesNamed(folder_, names);
    if (!in_the_way) return tl::unexpected(in_the_way.error());
    for (const std::string& file : *in_the_way) {
        if (Status status = folder_.checkFile(file); !status) return status;
        // A damaged journal does not name the files of a killed run. Its frames are replaced, but
        // its temporary files would stay.
        if (completedName(file) == file) continue;
        if (Status status = folder_.remove(file); !status) return status;
    }
    if (isComplete()) {
        const Result<std::set<std::string>> old = filesListed(folder_, kCardFile);
        if (!old) return tl::unexpected(old.error());
        for (const std::string& file : *old) {
            const std::string folder = folderOf(file);
            if (folder.empty()) continue;
            if (Status status = folder_.checkFolder(folder); !status) return status;
        }
    }
    const Result<std::vector<std::string>> left = leftFiles(keep);
    if (!left) return tl::unexpected(left.error());
    std::set<std::string> emptied;
    for (const std::string& file : *left) {
        if (Status status = unfinished().remove(file); !status) return status;
        emptied.insert(folderOf(file));
    }
    if (!staged_ && !isComplete()) emptied.merge(readJournal(folder_).names.folders);
    emptied.erase("");
    for (const std::string& folder : emptied) unfinished().removeEmpty(folder);
    if (staged_ && !isComplete() && keep.empty()) {  // the old dataset was deleted
        staged_.reset();
        folder_.removeEmpty(kNewFolder);
    } else if (!staged_ && isComplete()) {
        Result<GuardedFolder> staged = folder_.makeWithin(kNewFolder);
        if (!staged) return tl::unexpected(staged.error());
        staged_ = std::move(*staged);
        made_staged_ = true;
    }
    return {};
}

Status DatasetFolder::makeFolders(const DatasetNames& names) {
    struct stat journal {};
    if (::fstat(lock_.get(), &journal) != 0 || journal.st_size == 0) {
        return fail(ErrorCode::Failed, "the journal is empty", path().string());
    }
    for (const std::string& folder : names.folders) {
        if (folder == kFoldFolder) continue;  // created with the first list, if any
        for (std::size_t end = 0; end != std::string::npos;) {
            end = folder.find('/', end + 1);
            const std::string around = folder.substr(0, end);
            if (!unfinished().has(around)) made_within_.push_back(around);
        }
        if (const auto made = unfinished().makeWithin(folder); !made) {
            return tl::unexpected(made.error());
        }
    }
    begun_ = true;
    return {};
}

bool DatasetFolder::isMoving() const {
    return staged_ && staged_->has(kReplacedCard);
}

Status DatasetFolder::moveIntoPlace() {
    if (staged_->has(kCardFile)) {
        const Result<std::set<std::string>> files = filesListed(*staged_, kCardFile);
        if (!files) return tl::unexpected(files.error());
        const Result<std::set<std::string>> old = filesListed(*staged_, kReplacedCard);
        if (!old) return tl::unexpected(old.error());
        std::set<std::string> emptied;
        for (const std::string& file : *old) {
            if (files->contains(file)) continue;
            if (Status status = folder_.remove(file); !status) return status;
            emptied.insert(folderOf(file));
        }
        emptied.erase("");
        for (const std::string& folder : emptied) folder_.removeEmpty(folder);
        for (const std::string& file : *files) {  // missing ones were moved already
            const Result<bool> moved = staged_->move(file, folder_, file);
            if (!moved) return tl::unexpected(moved.error());
        }
        if (Status status = folder_.syncAll(); !status) return status;
        const Result<bool> moved = staged_->move(kCardFile, folder_, kCardFile);
        if (!moved) return tl::unexpected(moved.error());
        if (Status status = folder_.syncNames(); !status) return status;
    }
    return removeStaged();
}

Status DatasetFolder::removeStaged() {
    std::vector<std::string> files;
    std::vector<std::string> folders;
    if (Status status = listAll(*staged_, "", kMostLevels, files, folders); !status) return status;
    // The file that marks the new dataset as the valid one is removed last.
    std::ranges::stable_partition(files,
                                  [](const std::string& file) { return file != kReplacedCard; });
    for (const std::string& file : files) {
        if (Status status = staged_->remove(file); !status) return status;
    }
    std::ranges::reverse(folders);  // innermost first
    for (const std::string& folder : folders) staged_->removeEmpty(folder);
    staged_.reset();
    folder_.removeEmpty(kNewFolder);
    return {};
}

Status DatasetFolder::finish() {
    if (staged_) {
        // This rename makes the new dataset the valid one.
        const Result<bool> moved = folder_.move(kCardFile, *staged_, kReplacedCard);
        if (!moved) return tl::unexpected(moved.error());
        Status status;
        if (!*moved) status = staged_->write(kReplacedCard, std::string_view("{}\n"));
        if (status) status = folder_.syncNames();
        if (status) status = staged_->syncNames();
        if (status) status = moveIntoPlace();
        if (!status) return status;
    }
    return release();
}

Status DatasetFolder::release() {
    if (staged_) {
        if (Status status = removeStaged(); !status) return status;
    }
    if (Status status = folder_.remove(kJournalFile); !status) return status;
    (void)lock_.close();
    made_around_.clear();
    return folder_.syncAll();
}

}  // namespace dollytrack::render
