#include "engine/io/sandbox/scene_reading.h"

#include "engine/io/files/sha256.h"
#include "engine/io/sandbox/importer_process.h"
#include "engine/io/sandbox/read_scene.h"
#include "engine/io/sandbox/scene_cache.h"
#include "engine/io/sandbox/scene_check.h"

#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace dollytrack {
namespace {

Result<DecodedScene> readHere(const SceneFormat& format, const std::filesystem::path& path,
                              const ImportOptions& options, const JobContext& job) {
    Result<DecodedScene> scene = readScene(format, path, options, job);
    if (!scene) return scene;
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", path.string());
    if (Status sound = checkScene(*scene); !sound) {
        return fail(ErrorCode::BadInput, sound.error().message, path.string());
    }
    return scene;
}

/// The cache entry of a scene: cache, key and inputs.
struct CachePlace {
    SceneCache cache;
    std::string key;
    std::string sha256;  // of the scene file
    InputRoots roots;
};

/// Writes cache entries in the background; the program waits for it at exit.
class Keeper {
  public:
    ~Keeper() {
        if (worker_.joinable()) worker_.join();
    }
    void keep(CachePlace place, std::filesystem::path scene, ImporterResult back) {
        const std::lock_guard lock(mutex_);
        if (worker_.joinable()) worker_.join();
        worker_ = std::thread(
            [place = std::move(place), scene = std::move(scene), back = std::move(back)] {
                try {
                    place.cache.keep(place.key, scene, place.sha256, place.roots, *back.inputs,
                                     back.serialized);
                } catch (const std::exception&) {
                    // A failed write is ignored: the file is read again next time.
                }
            });
    }

  private:
    std::mutex mutex_;
    std::thread worker_;
};

/// Files and folders that the reader opens outside the scene's folder.
std::vector<std::filesystem::path> moreInputs(const SceneFormat& format,
                                              const std::filesystem::path& path,
                                              const ImportOptions& options) {
    std::vector<std::filesystem::path> inputs;
    if (format.more_inputs != nullptr) inputs = format.more_inputs(path, options);
    if (options.labels) inputs.push_back(*options.labels);
    return inputs;
}

Result<DecodedScene> readApart(const std::filesystem::path& path, const ImportOptions& options,
                               const JobContext& job,
                               const std::vector<std::filesystem::path>& more_inputs, double work,
                               const std::optional<CachePlace>& place) {
    Result<ImporterResult> back = runImporterProcess(path, options, job, more_inputs, work);
    if (!back) return tl::unexpected(back.error());
    bool damaged = false;
    Result<DecodedScene> scene = deserializeScene(back->serialized, damaged);
    if (!scene && damaged) {
        return fail(ErrorCode::BadInput,
                    "the importer returned invalid data (" + scene.error().message +
                        "); the file is damaged: export it again, preferably as glTF",
                    path.string());
    }
    if (scene && place && back->inputs) {
        static Keeper keeper;
        keeper.keep(*place, path, std::move(*back));
    }
    return scene;
}

Result<SceneFileContent> readThroughCache(const std::filesystem::path& path,
                                          const ImportOptions& options, const JobContext& job,
                                          const std::vector<std::filesystem::path>& more_inputs,
                                          double work, SceneCache cache) {
    Result<std::string> digest = cache.digestOf(path, job);
    if (!digest) return tl::unexpected(digest.error());
    const InputRoots roots = inputRoots(path, more_inputs);
    const std::string key = SceneCache::keyOf(path, *digest, options, roots);
    if (std::optional<DecodedScene> kept = cache.find(key, roots)) {
        return SceneFileContent{std::move(*kept), std::move(*digest)};
    }
    Result<DecodedScene> scene = readApart(path, options, job, more_inputs, work,
                                           CachePlace{std::move(cache), key, *digest, roots});
    if (!scene) return tl::unexpected(scene.error());
    return SceneFileContent{std::move(*scene), std::move(*digest)};
}

}  // namespace

Result<SceneFileContent> readSceneFile(const SceneFormat& format, const std::filesystem::path& path,
                                       const ImportOptions& options, const JobContext& job) {
    const std::vector<std::filesystem::path> more_inputs = moreInputs(format, path, options);
    if (options.use_cache && !options.in_process) {
        if (std::optional<SceneCache> cache = SceneCache::ofUser()) {
            return readThroughCache(path, options, job, more_inputs, format.work,
                                    std::move(*cache));
        }
    }
    // The file is hashed while it is read.
    std::future<Result<std::string>> hash =
        std::async(std::launch::async, [path, job] { return sha256OfFile(path, job); });
    Result<DecodedScene> scene =
        options.in_process ? readHere(format, path, options, job)
                           : readApart(path, options, job, more_inputs, format.work, std::nullopt);
    if (!scene) return tl::unexpected(scene.error());
    Result<std::string> digest = hash.get();
    if (!digest) return tl::unexpected(digest.error());
    return SceneFileContent{std::move(*scene), std::move(*digest)};
}

}  // namespace dollytrack
