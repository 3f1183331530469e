#include "engine/io/sandbox/importer_process.h"

#include "engine/core/log.h"
#include "engine/core/program_file.h"
#include "engine/io/sandbox/input_list.h"
#include "engine/io/sandbox/isolation.h"
#include "engine/io/sandbox/processor_wait.h"
#include "engine/io/sandbox/reading_clock.h"
#include "engine/io/sandbox/scene_serialization.h"
#include "engine/io/sandbox/spawned_importer.h"
#include "engine/io/settings/import_settings.h"

#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kStep{40};

constexpr const char* kExportAgain =
    "; the file is damaged or not supported: export it again, preferably as glTF";

std::vector<std::string> commandFor(const fs::path& scene, const ImportOptions& options,
                                    const std::vector<fs::path>& more_inputs) {
    using Json = nlohmann::json;
    std::vector<std::string> command = {
        importerProgram().string(),
        std::to_string(kSerializationVersion),
        std::to_string(::getpid()),
        options.read_textures ? "1" : "0",
        importOptionsToJson(options).dump(-1, ' ', false, Json::error_handler_t::replace),
        scene.string()};
    for (const fs::path& input : more_inputs) command.push_back(input.string());
    return command;
}

void tellMissingLayers(std::uint64_t layers) {
    static std::atomic<bool> told = false;
    const std::string names = layerNames(static_cast<std::uint32_t>(layers));
    if (names.empty() || told.exchange(true)) return;
    log::warn("import", "scene files are read without the protection of " + names +
                            ", which this system does not offer");
}

/// State from the messages received so far.
struct Heard {
    std::optional<std::uint64_t> scene_bytes;
    std::uint64_t list_bytes = 0;
    bool sound = true;
};

void hear(const ImporterMessage& message, const JobContext& job, ReadingClock& clock,
          Heard& heard) {
    switch (message.kind) {
        case ImporterMessage::Isolated:
            tellMissingLayers(message.value);
            return;
        case ImporterMessage::Opened:
            clock.opened(message.value);
            return;
        case ImporterMessage::Progress:
            if (message.value <= 1'000'000) job.report(static_cast<double>(message.value) * 1e-6);
            return;
        case ImporterMessage::Depends:
            heard.list_bytes = message.value;
            return;
        case ImporterMessage::Done:
            heard.scene_bytes = message.value;
            return;
        default:
            heard.sound = false;
    }
}

tl::unexpected<Error> tookTooLong(const ReadingClock& clock, const std::string& where) {
    if (!clock.reads()) {
        return fail(ErrorCode::Failed,
                    "the program that reads scene files did not start within " +
                        std::to_string(std::lround(clock.allowed().count())) +
                        " s; try again when the machine is less busy",
                    where);
    }
    return fail(ErrorCode::BadInput,
                "reading it took longer than the " +
                    std::to_string(std::lround(clock.allowed().count())) +
                    " s allowed for its size, and was stopped" + kExportAgain,
                where);
}

tl::unexpected<Error> damagedResult(const std::string& reason, const std::string& where) {
    return fail(ErrorCode::BadInput,
                "the importer returned invalid data (" + reason + ")" + kExportAgain, where);
}

/// The error for the importer's exit status; nullopt for success.
std::optional<Error> whyItEnded(int status, const ReadingClock& clock, const fs::path& scene) {
    const std::string where = scene.string();
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        if (signal == SIGXCPU) return tookTooLong(clock, where).value();
        const std::string how = signal == SIGKILL ? "was killed" : "crashed";
        return Error{
            ErrorCode::BadInput,
            "the importer " + how + " (signal " + std::to_string(signal) + ")" + kExportAgain,
            where};
    }
    if (WEXITSTATUS(status) == 0) return std::nullopt;
    if (WEXITSTATUS(status) == 2) {
        return Error{ErrorCode::Failed,
                     "the program that reads scene files has another version; build or install "
                     "both together",
                     importerProgram().string()};
    }
    return Error{ErrorCode::BadInput,
                 "the importer returned nothing (exit code " + std::to_string(WEXITSTATUS(status)) +
                     ")" + kExportAgain,
                 where};
}

Result<ImporterResult> takeResult(SharedMemory memory, const Heard& heard,
                                  const std::string& where) {
    const std::uint64_t scene_bytes = heard.scene_bytes.value_or(0);
    const bool fits = scene_bytes > 0 && scene_bytes <= kMostSerializedBytes &&
                      heard.list_bytes <= kMostSerializedBytes;
    if (!heard.sound || !fits) return damagedResult("its messages", where);
    const auto bytes = memory.close(scene_bytes + heard.list_bytes);
    if (!bytes && bytes.error().code == ErrorCode::Failed) return tl::unexpected(bytes.error());
    if (!bytes) return damagedResult(bytes.error().message, where);
    const auto list = bytes->subspan(scene_bytes);
    ImporterResult back{std::move(memory), bytes->first(scene_bytes), std::nullopt};
    if (!list.empty()) {
        back.inputs = parseInputList({reinterpret_cast<const char*>(list.data()), list.size()});
        if (!back.inputs) return damagedResult("its list of files", where);
    }
    return back;
}

}  // namespace

fs::path importerProgram() {
    return siblingProgram("dollytrack-import");
}

Result<ImporterResult> runImporterProcess(const fs::path& scene, const ImportOptions& options,
                                          const JobContext& job,
                                          const std::vector<fs::path>& more_inputs, double work) {
    const std::string where = scene.string();
    Result<SharedMemory> memory = SharedMemory::make(kMostSerializedBytes);
    if (!memory) return tl::unexpected(memory.error());
    Result<SpawnedImporter> importer =
        SpawnedImporter::start(commandFor(scene, options, more_inputs), memory->descriptor());
    if (!importer) return tl::unexpected(importer.error());
    ReadingClock clock(work);
    ProcessorWait processor_wait(importer->process());
    Heard heard;
    bool talks = true;
    double limited = 0.0;
    while (true) {
        // All its threads may use the processor for the allowed time.
        if (clock.allowed().count() > limited) {
            limited = clock.allowed().count();
            importer->limitProcessorTime(
                static_cast<std::uint64_t>(std::ceil(limited * kMostThreads)) + 1);
        }
        std::vector<ImporterMessage> messages;
        if (talks) {
            talks = importer->receive(kStep, messages);
        } else {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        for (const ImporterMessage& message : messages) hear(message, job, clock, heard);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", where);
        if (!talks && importer->end()) break;
        clock.waited(processor_wait.update());
        if (clock.left().count() <= 0.0) return tookTooLong(clock, where);
    }
    if (std::optional<Error> why = whyItEnded(*importer->end(), clock, scene)) {
        return tl::unexpected(std::move(*why));
    }
    return takeResult(std::move(*memory), heard, where);
}

}  // namespace dollytrack
