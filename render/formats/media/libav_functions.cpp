#include "render/formats/media/libav_functions.h"

#include "engine/core/shared_library.h"
#include "render/formats/media/video_encoder.h"

#include <cerrno>
#include <cstdio>
#include <optional>

namespace dollytrack::render {
namespace {

std::optional<LibavFunctions> loadLibav() {
    // It depends on the two others, so that their symbols are found through it.
    void* library = openSharedLibrary(DOLLYTRACK_LIBAVFORMAT);
    if (library == nullptr) return std::nullopt;
    LibavFunctions functions;
    bool found = true;
#define DOLLYTRACK_FIND(name) found = found && findSymbol(library, #name, functions.name);
    DOLLYTRACK_LIBAV_FUNCTIONS(DOLLYTRACK_FIND)
#undef DOLLYTRACK_FIND
    if (!found) return std::nullopt;
    functions.av_log_set_level(AV_LOG_QUIET);  // messages may quote a hostile file
    return functions;
}

}  // namespace

const LibavFunctions* libavFunctions() {
    static const std::optional<LibavFunctions> functions = loadLibav();
    return functions ? &*functions : nullptr;
}

std::int64_t seekInFile(std::uint64_t& at, std::uint64_t size, std::int64_t offset, int whence) {
    if ((whence & AVSEEK_SIZE) != 0) return static_cast<std::int64_t>(size);
    const std::uint64_t from = whence == SEEK_CUR ? at : whence == SEEK_END ? size : 0;
    const std::int64_t to = static_cast<std::int64_t>(from) + offset;
    if (to < 0) return AVERROR(EINVAL);
    at = static_cast<std::uint64_t>(to);
    return to;
}

const char* missingVideoLibrary() {
    return libavFunctions() != nullptr
               ? nullptr
               : "the library for videos is missing (" DOLLYTRACK_LIBAVFORMAT
                 "); on Debian, install libavformat59";
}

}  // namespace dollytrack::render
