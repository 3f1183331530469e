#include "app/gather/output/output_folder.h"

#include "app/gather/files/hashing_file_writer.h"
#include "app/gather/sources/source_search.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/text_file.h"
#include "render/formats/tables/dataset_card.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <set>
#include <utility>

namespace dollytrack::gather {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Marker, lock file and journal of a run. The first line identifies the run, the other lines list
// finished shards.
constexpr const char* kGatherJournal = ".dollytrack-gather";
constexpr int kGatherJournalVersion = 1;
constexpr const char* kStagedFolder = ".dollytrack-new";
// Names of the old dataset's gather.json and list of files in the new dataset's folder while it is
// replaced. If the first exists, the new dataset is the valid one.
constexpr const char* kReplaced = "replaced.json";
constexpr const char* kReplacedSums = "replaced.sums";
constexpr int kMostFolderLevels = 16;
// All folders that layouts create.
constexpr std::array<const char*, 8> kLayoutFolders = {"images", "labels", "annotations", "data",
                                                       "tracks", "train",  "val",         "test"};
constexpr std::array<const char*, 7> kLayoutFiles = {
    "README.md", "data.yaml", "camera.json",        "index.json",
    kSumsFile,   kGatherCard, render::kLicensesFile};

std::string below(const std::string& folder, const std::string& name) {
    return folder.empty() ? name : folder + "/" + name;
}

/// Refuses symbolic links, which must not be in a published dataset or redirect its files.
Status checkNoLinks(const GuardedFolder& folder, const std::string& within, int levels) {
    const auto names = folder.list(within);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) {
        const std::string path = below(within, name);
        const auto found = folder.find(path);
        if (!found) continue;
        if (S_ISLNK(found->st_mode)) {
            return fail(ErrorCode::CannotWrite,
                        "a symbolic link is in its place and is not followed; remove it or choose "
                        "another folder",
                        (folder.path() / path).string());
        }
        if (!S_ISDIR(found->st_mode) || levels == 0) continue;
        if (Status status = checkNoLinks(folder, path, levels - 1); !status) return status;
    }
    return {};
}

Status removeAll(const GuardedFolder& folder, const std::string& within) {
    const auto names = folder.list(within);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) {
        if (within.empty() && name == kReplaced) continue;  // marks this dataset as the valid one
        const std::string path = below(within, name);
        const auto found = folder.find(path);
        const bool is_folder = found && S_ISDIR(found->st_mode);
        if (Status removed = is_folder ? removeAll(folder, path) : folder.remove(path); !removed) {
            return removed;
        }
    }
    if (!within.empty()) folder.removeEmpty(within);
    return {};
}

/// Moves all files except gather.json, replaced.json and their temporary files
/// (gather.json.tmp.123). Folders are moved as a whole if the destination has none of the same
/// name.
Status moveAll(const GuardedFolder& from, const GuardedFolder& to, const std::string& within) {
    const auto names = from.list(within);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) {
        const auto completed = completedName(name);
        if (within.empty() && (completed == kGatherCard || completed == kReplaced)) continue;
        const std::string path = below(within, name);
        const auto found = from.find(path);
        if (found && S_ISDIR(found->st_mode) && to.has(path)) {
            if (Status status = moveAll(from, to, path); !status) return status;
            continue;
        }
        if (const Result<bool> moved = from.move(path, to, path); !moved) {
            return tl::unexpected(moved.error());
        }
    }
    return {};
}

bool hasGatherCard(const GuardedFolder& folder) {
    if (!folder.has(kGatherCard)) return false;
    // A foreign file may be huge, so only its `format` is kept.
    const auto keep = [](int depth, json::parse_event_t event, json& parsed) {
        return depth != 1 || event != json::parse_event_t::key || parsed == "format";
    };
    const auto card = readBoundedJson<json>(folder, kGatherCard, keep);
    return card && card->is_object() && card->value("format", json()) == kGatherFormat;
}

struct GatherJournal {
    std::optional<render::DatasetIdentity> identity;
    std::vector<FinishedShard> shards;
    std::size_t whole_bytes = 0;  // up to the start of an incomplete last line
};

/// Whether a descriptor still refers to the file of this name.
bool isFile(int descriptor, const GuardedFolder& folder, const std::string& name) {
    struct stat held {};
    const auto named = folder.find(name);
    return named && ::fstat(descriptor, &held) == 0 && held.st_ino == named->st_ino;
}

GatherJournal readGatherJournal(const GuardedFolder& folder) {
    GatherJournal journal;
    const Result<InputFile> file = folder.openInput(kGatherJournal);
    if (!file) return journal;
    const std::string text = file->readAll(kMostTextBytes).value_or("");
    for (std::size_t end = text.find('\n'); end != std::string::npos;
         end = text.find('\n', journal.whole_bytes)) {
        const std::string_view line =
            std::string_view(text).substr(journal.whole_bytes, end - journal.whole_bytes);
        journal.whole_bytes = end + 1;
        const json value = parseBoundedJson(line, kGatherJournal).value_or(json());
        try {
            if (value.contains("identity")) {
                if (value.at("version").get<int>() != kGatherJournalVersion) return {};
                journal.identity = value.at("identity").get<render::DatasetIdentity>();
            } else {
                journal.shards.push_back({value.at("shard").get<std::string>(),
                                          value.at("frames").get<std::size_t>(),
                                          value.at("sha256").get<std::string>()});
            }
        } catch (const json::exception&) {
            continue;  // a damaged line: the shard is written again
        }
    }
    return journal;
}

}  // namespace

Status forEachSum(const GuardedFolder& folder, const std::string& list,
                  const std::function<Status(std::string_view, const std::string&)>& take) {
    constexpr std::size_t kPortion = std::size_t{1} << 20U;  // bytes
    constexpr std::size_t kHash = 64;
    const Result<InputFile> file = folder.openInput(list);
    if (!file) return tl::unexpected(file.error());
    std::string text;
    for (std::uint64_t at = 0;;) {
        const std::size_t kept = text.size();
        text.resize(kept + kPortion);
        const std::size_t got = file->read(at, text.data() + kept, kPortion);
        text.resize(kept + got);
        at += got;
        std::size_t begin = 0;
        for (std::size_t end = text.find('\n'); end != std::string::npos;
             end = text.find('\n', begin)) {
            const std::string_view line = std::string_view(text).substr(begin, end - begin);
            begin = end + 1;
            if (line.size() < kHash + 3 || line.substr(kHash, 2) != "  ") continue;
            const Status taken = take(line.substr(0, kHash), std::string(line.substr(kHash + 2)));
            if (!taken) return taken;
        }
        text.erase(0, begin);
        if (got == 0 || text.size() > kPortion) return {};
    }
}

OutputFolder::~OutputFolder() {
    if (!lock_.valid() || is_marked_) return;
    (void)folder_.remove(kGatherJournal);
    if (made_) ::rmdir(path().c_str());
}

Status OutputFolder::checkContents(bool overwrite) const {
    const Result<bool> exported = render::hasOurCard(folder_);
    if (!exported) return tl::unexpected(exported.error());
    if (*exported || folder_.has(render::kJournalFile)) {
        return fail(ErrorCode::CannotWrite,
                    "the folder contains an exported dataset; choose another folder for --out",
                    path().string());
    }
    if (!overwrite && !is_marked_ && !complete_) {
        const auto names = folder_.list("");
        if (!names) return tl::unexpected(names.error());
        if (std::ranges::any_of(*names, [](const auto& name) { return name != kGatherJournal; })) {
            return fail(ErrorCode::CannotWrite,
                        "the folder contains files that are not a gathered dataset; choose an "
                        "empty folder, or give --overwrite",
                        path().string());
        }
    }
    if (Status status = checkNoLinks(folder_, "", kMostFolderLevels); !status) return status;
    for (const char* name : kLayoutFolders) {
        if (Status status = folder_.checkFolder(name); !status) return status;
    }
    for (const char* name : kLayoutFiles) {
        if (Status status = folder_.checkFile(name); !status) return status;
    }
    return {};
}

Result<OutputFolder> OutputFolder::claim(const fs::path& folder, bool overwrite) {
    std::error_code error;
    const bool existed = fs::exists(folder, error);
    Result<GuardedFolder> opened = GuardedFolder::make(folder);
    if (!opened) return tl::unexpected(opened.error());
    OutputFolder claimed(std::move(*opened));
    claimed.made_ = !existed;
    const GuardedFolder& own = claimed.folder_;
    const auto journal = own.find(kGatherJournal);
    claimed.is_marked_ = journal && journal->st_size > 0;
    claimed.complete_ = hasGatherCard(own);
    if (Status status = claimed.checkContents(overwrite); !status) {
        if (!existed) ::rmdir(folder.c_str());
        return tl::unexpected(status.error());
    }
    Result<FileDescriptor> lock = own.openFile(kGatherJournal, O_RDWR | O_CREAT | O_APPEND);
    if (!lock) return tl::unexpected(lock.error());
    // Some file systems have no locks; there the user must keep programs apart. A program that just
    // ended may have removed the file.
    const bool is_taken = ::flock(lock->get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (is_taken || !isFile(lock->get(), own, kGatherJournal)) {
        return fail(ErrorCode::CannotWrite,
                    "another program is gathering into this folder; wait for it, stop it, or "
                    "choose another folder",
                    folder.string());
    }
    claimed.lock_ = std::move(*lock);
    if (own.has(kStagedFolder)) {
        Result<GuardedFolder> staged = own.openWithin(kStagedFolder);
        if (!staged) return tl::unexpected(staged.error());
        claimed.staged_ = std::move(*staged);
        if (claimed.staged_->has(kReplaced)) {
            if (Status status = claimed.moveIntoPlace(); !status) {
                return tl::unexpected(status.error());
            }
            if (::ftruncate(claimed.lock_.get(), 0) != 0) {
                return tl::unexpected(writeError(errno, folder / kGatherJournal));
            }
            claimed.is_marked_ = false;
        }
    }
    claimed.complete_ = hasGatherCard(own);
    return claimed;
}

Result<std::vector<FinishedShard>> OutputFolder::begin(const render::DatasetIdentity& identity,
                                                       bool resume) {
    GatherJournal earlier = readGatherJournal(folder_);
    const bool goes_on = resume && earlier.identity && staged_;
    if (goes_on) {
        const std::string differing = render::differences(*earlier.identity, identity);
        if (!differing.empty()) {
            return fail(
                ErrorCode::Usage,
                fmt::format("the folder contains another unfinished result (different: {}); "
                            "gather without --resume, or into another folder",
                            differing),
                path().string());
        }
    } else if (staged_) {
        if (Status removed = removeStaged(); !removed) return tl::unexpected(removed.error());
    }
    if (!goes_on) earlier = {};
    if (!staged_) {
        Result<GuardedFolder> staged = folder_.makeWithin(kStagedFolder);
        if (!staged) return tl::unexpected(staged.error());
        staged_ = std::move(*staged);
    }
    if (::ftruncate(lock_.get(), static_cast<off_t>(earlier.whole_bytes)) != 0) {
        return tl::unexpected(writeError(errno, path() / kGatherJournal));
    }
    is_marked_ = true;
    if (!goes_on) {
        const json header = {{"version", kGatherJournalVersion}, {"identity", identity}};
        if (Status status = appendLine(header.dump()); !status) {
            return tl::unexpected(status.error());
        }
    }
    return std::move(earlier.shards);
}

Status OutputFolder::appendLine(const std::string& json) {
    int error = writeAll(lock_.get(), json + "\n");
    if (error == 0 && ::fdatasync(lock_.get()) != 0 && errno != EINVAL) error = errno;
    if (error == 0) return {};
    return tl::unexpected(writeError(error, path() / kGatherJournal));
}

Status OutputFolder::note(const FinishedShard& shard) {
    const json line = {{"shard", shard.name}, {"frames", shard.frames}, {"sha256", shard.sha256}};
    return appendLine(line.dump());
}

Status OutputFolder::removeListed() {
    std::set<std::string> folders;
    const Status removed =
        forEachSum(*staged_, kReplacedSums, [&](std::string_view, const std::string& name) {
            if (!GuardedFolder::isPlain(name)) return Status();
            const std::size_t slash = name.rfind('/');
            if (slash != std::string::npos) folders.insert(name.substr(0, slash));
            return folder_.remove(name);
        });
    if (!removed) return removed;
    for (const std::string& folder : folders) folder_.removeEmpty(folder);
    // Synced first, because the new files may have the same names.
    if (Status synced = folder_.syncAll(); !synced) return synced;
    return staged_->remove(kReplacedSums);
}

Status OutputFolder::moveIntoPlace() {
    if (staged_->has(kGatherCard)) {
        if (staged_->has(kReplacedSums)) {
            if (Status status = removeListed(); !status) return status;
        }
        if (Status status = moveAll(*staged_, folder_, ""); !status) return status;
        if (Status status = folder_.syncAll(); !status) return status;
        const Result<bool> moved = staged_->move(kGatherCard, folder_, kGatherCard);
        if (!moved) return tl::unexpected(moved.error());
        if (Status status = folder_.syncNames(); !status) return status;
    }
    return removeStaged();
}

Status OutputFolder::removeStaged() {
    if (Status status = removeAll(*staged_, ""); !status) return status;
    if (Status status = staged_->remove(kReplaced); !status) return status;
    staged_.reset();
    folder_.removeEmpty(kStagedFolder);
    return {};
}

Status OutputFolder::finish() {
    if (complete_ && folder_.has(kSumsFile)) {
        if (Status status = folder_.link(kSumsFile, below(kStagedFolder, kReplacedSums)); !status) {
            return status;
        }
    }
    // This rename makes the new dataset the valid one.
    const Result<bool> moved = folder_.move(kGatherCard, *staged_, kReplaced);
    if (!moved) return tl::unexpected(moved.error());
    Status status;
    if (!*moved) status = staged_->write(kReplaced, std::string_view("{}\n"));
    if (status) status = folder_.syncNames();
    if (status) status = staged_->syncNames();
    if (status) status = moveIntoPlace();
    if (status) status = folder_.remove(kGatherJournal);
    if (!status) return status;
    (void)lock_.close();
    return folder_.syncNames();  // files and gather.json are already synced
}

}  // namespace dollytrack::gather
