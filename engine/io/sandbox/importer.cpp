#include "engine/io/sandbox/importer.h"

#include "engine/core/result.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/input_record.h"
#include "engine/io/format_table/input_check.h"
#include "engine/io/format_table/scene_format.h"
#include "engine/io/sandbox/importer_protocol.h"
#include "engine/io/sandbox/input_list.h"
#include "engine/io/sandbox/isolation.h"
#include "engine/io/sandbox/read_scene.h"
#include "engine/io/sandbox/scene_serialization.h"
#include "engine/io/settings/import_settings.h"
#include "engine/jobs/parallel.h"

#include <nlohmann/json.hpp>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace dollytrack {
namespace {

void tell(ImporterMessage::Kind kind, std::uint64_t value) {
    const ImporterMessage message{kind, 1, value};
    while (::write(kMessageDescriptor, &message, sizeof(message)) < 0 && errno == EINTR) {
    }
}

/// The scene to read, its options, and further readable files and folders.
struct Task {
    std::filesystem::path scene;
    ImportOptions options;
    std::vector<std::filesystem::path> readable;
};

std::optional<Task> taskOf(int count, char** arguments) {
    constexpr int kFewest = 6;
    if (count < kFewest || arguments[1] != std::to_string(kSerializationVersion))
        return std::nullopt;
    const std::string parent = arguments[2];
    pid_t id = 0;
    std::from_chars(parent.data(), parent.data() + parent.size(), id);
    // The parent may have died before PR_SET_PDEATHSIG was set.
    if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || ::getppid() != id) return std::nullopt;
    struct stat status {};
    if (::fstat(kMemoryDescriptor, &status) != 0 || ::fstat(kMessageDescriptor, &status) != 0) {
        return std::nullopt;
    }
    const nlohmann::json settings =
        parseBoundedJson(arguments[4], "settings").value_or(nlohmann::json());
    Result<ImportOptions> options = importOptionsFromJson(settings);
    if (!options) return std::nullopt;
    Task task{arguments[5], std::move(*options), {}};
    task.options.read_textures = std::string(arguments[3]) == "1";
    const std::filesystem::path folder = task.scene.parent_path();
    task.readable = {task.scene, folder.empty() ? std::filesystem::path(".") : folder};
    for (int i = kFewest; i < count; ++i) task.readable.emplace_back(arguments[i]);
    return task;
}

void noteRefused(const InputRecord& record, std::vector<std::string>& notes) {
    constexpr std::size_t kMostNamed = 10;
    std::string names;
    std::size_t count = 0;
    for (const InputUse& use : record.uses()) {
        if (use.kind != InputUse::Refused || ++count > kMostNamed) continue;
        names += (names.empty() ? "" : ", ") + use.path.string();
    }
    if (count == 0) return;
    if (count > kMostNamed) names += " and " + std::to_string(count - kMostNamed) + " more";
    notes.push_back("the scene names files outside its folder, which were not opened: " + names);
}

/// Memory limit of this process, and whether it is inherited from the parent and lower than the
/// default.
struct MemoryLimit {
    std::uint64_t bytes = kMostAddressSpace;
    bool inherited = false;
};

MemoryLimit memoryLimit() {
    MemoryLimit limit;
    for (const auto resource : {RLIMIT_DATA, RLIMIT_AS}) {
        rlimit found{};
        if (::getrlimit(resource, &found) != 0 || found.rlim_cur >= limit.bytes) continue;
        limit = {found.rlim_cur, true};
    }
    return limit;
}

Error outOfMemory(const std::string& where) {
    const MemoryLimit limit = memoryLimit();
    const std::string size = std::to_string(limit.bytes >> 20U) + " MiB";
    if (limit.inherited) {
        return {ErrorCode::Failed,
                "out of memory: reading it needs more than the limit of " + size +
                    " for this program; raise it (ulimit, memory_mb)",
                where};
    }
    return {ErrorCode::BadInput,
            "reading it needs more than " + size +
                " of memory; if it is not damaged, make it smaller or split it",
            where};
}

Result<DecodedScene> readGuarded(const Task& task, const InputRecord& record,
                                 const JobContext& job) {
    const std::string where = task.scene.string();
    try {
        const Result<const SceneFormat*> format = checkSceneFile(task.scene);
        if (!format) return tl::unexpected(format.error());
        Result<DecodedScene> scene = readScene(**format, task.scene, task.options, job);
        std::vector<std::string> refused;
        noteRefused(record, refused);
        if (!scene) {
            for (const std::string& note : refused) scene.error().message += "; " + note;
            return scene;
        }
        scene->raw.notes.insert(scene->raw.notes.end(), refused.begin(), refused.end());
        for (TextureRequest& request : scene->raw.textures) request.embedded = {};
        job.report(1.0);
        return scene;
    } catch (const std::bad_alloc&) {
        return tl::unexpected(outOfMemory(where));
    } catch (const std::system_error& error) {
        // Threads cannot be started if there is no memory for their stacks.
        if (error.code() == std::errc::resource_unavailable_try_again) {
            return tl::unexpected(outOfMemory(where));
        }
        return fail(ErrorCode::Failed, std::string("it cannot be read (") + error.what() + ")",
                    where);
    } catch (const std::exception& error) {
        return fail(ErrorCode::BadInput,
                    std::string("the file cannot be read as a 3D scene (") + error.what() + ")",
                    where);
    }
}

/// Writes the serialized scene, followed by the list of inputs, into the memory from the parent.
/// Returns false if they do not fit.
bool handBack(const Result<DecodedScene>& outcome, const std::vector<InputUse>& uses) {
    struct stat status {};
    if (::fstat(kMemoryDescriptor, &status) != 0) return false;
    const std::size_t scene_bytes = serializedSize(outcome);
    const std::string list = inputListText(uses);
    const std::size_t size = scene_bytes + list.size();
    if (size > static_cast<std::size_t>(status.st_size)) return false;
    void* memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, kMemoryDescriptor, 0);
    if (memory == MAP_FAILED) return false;
    const std::span out(static_cast<std::uint8_t*>(memory), size);
    serializeScene(outcome, out.first(scene_bytes));
    std::copy(list.begin(), list.end(), out.begin() + static_cast<std::ptrdiff_t>(scene_bytes));
    ::munmap(memory, size);
    tell(ImporterMessage::Depends, list.size());
    tell(ImporterMessage::Done, scene_bytes);
    return true;
}

/// Largest size of a serialized scene; the rest of the memory is for the list of inputs.
std::uint64_t mostSerializedBytes() {
    struct stat status {};
    const auto all = ::fstat(kMemoryDescriptor, &status) == 0
                         ? static_cast<std::uint64_t>(status.st_size)
                         : std::uint64_t{0};
    return all - all / 12;
}

tl::unexpected<Error> tooLarge(const std::string& where) {
    const std::string size = std::to_string(mostSerializedBytes() >> 20U) + " MiB";
    if (mostSerializedBytes() < kMostSerializedBytes / 2) {
        return fail(ErrorCode::Failed,
                    "its contents need more than the " + size +
                        " that the file size limit allows; raise it (ulimit -f)",
                    where);
    }
    return fail(ErrorCode::BadInput,
                "its contents need more than " + size + "; make its meshes or textures smaller",
                where);
}

}  // namespace

int runImporter(int count, char** arguments) {
    std::optional<Task> task = taskOf(count, arguments);
    if (!task) return 2;
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    setThreadCount(std::clamp(cores, 1, kMostThreads));
    loadLibrariesFor(task->scene, task->options);
    tell(ImporterMessage::Isolated, isolateProcess(task->readable));
    InputRecord record([](const FileIdentity& file) { tell(ImporterMessage::Opened, file.size); });
    const JobContext job(nullptr, [](double fraction, std::string_view) {
        tell(ImporterMessage::Progress,
             static_cast<std::uint64_t>(std::clamp(fraction, 0.0, 1.0) * 1e6));
    });
    Result<DecodedScene> outcome = readGuarded(*task, record, job);
    if (outcome && serializedSize(outcome) > mostSerializedBytes())
        outcome = tooLarge(task->scene.string());
    // Without cleanup: the memory ends with the process.
    ::_exit(handBack(outcome, record.uses()) ? 0 : 1);
}

}  // namespace dollytrack
