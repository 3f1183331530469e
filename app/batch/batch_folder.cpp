#include "app/batch/batch_folder.h"

#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/text_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <utility>

namespace dollytrack::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kList = "jobs.json";
constexpr const char* kFormat = "dollytrack-batch";
constexpr const char* kLock = ".lock";

std::string textOf(const BatchList& list) {
    Json jobs = Json::array();
    for (const Job& job : list.jobs) jobs.push_back(toJson(job));
    const Json json = {
        {"format", kFormat}, {"version", 1}, {"require", list.require}, {"jobs", std::move(jobs)}};
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool isOurs(const std::string& list) {
    const Json json = parseBoundedJson<Json>(list, kList).value_or(Json());
    return json.is_object() && json.contains("format") && json["format"] == kFormat;
}

/// Whether the folder is empty but for jobs.json and its temporary files, which concurrent shards
/// write.
bool isFree(const fs::path& folder) {
    std::error_code error;
    for (auto entry = fs::directory_iterator(folder, error);
         !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (completedName(name) != kList) return false;
    }
    return !error;
}

}  // namespace

Status claimBatchFolder(const fs::path& folder, const BatchList& list) {
    std::error_code error;
    const Result<GuardedFolder> own = GuardedFolder::make(folder);
    if (!own) return tl::unexpected(own.error());
    if (Status plain = own->checkFile(kList); !plain) return plain;
    const fs::path path = folder / kList;
    const std::string wanted = textOf(list);
    const Result<std::string> list_text = readText(path);
    const std::string found = list_text.value_or("");
    if (found == wanted) return {};
    // An empty list may have just been created by another shard; an unreadable one belongs to
    // someone else.
    const bool unread = !list_text && fs::exists(path, error);
    if (!isOurs(found) && (!found.empty() || unread || !isFree(folder))) {
        // Another shard may have written the list just now.
        if (readText(path).value_or("") == wanted) return {};
        return fail(ErrorCode::CannotWrite,
                    "the folder contains files that are not from a Dollytrack batch; choose an "
                    "empty folder with 'out' or --out",
                    folder.string());
    }
    Status written = own->write(kList, wanted);
    if (!written && readText(path).value_or("") == wanted) return {};
    return written;
}

Result<BatchList> readBatchList(const fs::path& folder) {
    const fs::path path = folder / kList;
    const std::string text = readText(path).value_or("");
    if (!isOurs(text)) {
        return fail(ErrorCode::BadInput,
                    "this is not the folder of a batch: its jobs.json is missing or damaged",
                    folder.string());
    }
    BatchList list;
    try {
        const Json json = parseBoundedJson<Json>(text, path.string()).value_or(Json());
        list.require = json.at("require").get<std::vector<std::string>>();
        for (const Json& job : json.at("jobs")) {
            list.jobs.push_back(jobFromJson(job));
            const std::string& name = list.jobs.back().name;
            if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) {
                return fail(ErrorCode::BadInput, "'" + name + "' cannot be a job's folder.",
                            path.string());
            }
        }
    } catch (const Json::exception& e) {
        return fail(ErrorCode::BadInput,
                    "a field is missing or of the wrong type (" + plainReason(e) + ")",
                    path.string());
    }
    return list;
}

Result<JobLock> JobLock::take(const GuardedFolder& batch, const std::string& job) {
    Result<GuardedFolder> folder = batch.makeWithin(job);
    if (!folder) return tl::unexpected(folder.error());
    Result<FileDescriptor> file = folder->openFile(kLock, O_RDWR | O_CREAT);
    if (!file) return tl::unexpected(file.error());
    JobLock lock(std::move(*folder), std::move(*file));
    lock.ours_ = ::flock(lock.file_.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    return lock;
}

}  // namespace dollytrack::batch
