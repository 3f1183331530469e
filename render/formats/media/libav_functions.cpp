#include "render/formats/media/libav_functions.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>

namespace dollytrack::render {
namespace {

template <class Symbol>
bool findSymbol(void* library, const char* name, Symbol*& symbol) {
    symbol = reinterpret_cast<Symbol*>(::dlsym(library, name));
    return symbol != nullptr;
}

std::optional<LibavFunctions> loadLibav() {
    // It depends on the two others, so that their symbols are found through it.
    void* library = ::dlopen(DOLLYTRACK_LIBAVFORMAT, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return std::nullopt;
    LibavFunctions functions;
    bool found = true;
#define DOLLYTRACK_FIND(name) found = found && findSymbol(library, #name, functions.name);
    DOLLYTRACK_LIBAV_FUNCTIONS(DOLLYTRACK_FIND)
#undef DOLLYTRACK_FIND
    if (!found) return std::nullopt;
    functions.av_log_set_level(AV_LOG_ERROR);
    return functions;
}

}  // namespace

const LibavFunctions* libavFunctions() {
    static const std::optional<LibavFunctions> functions = loadLibav();
    return functions ? &*functions : nullptr;
}

int MemoryFile::read(void* self, std::uint8_t* into, int size) {
    auto& file = *static_cast<MemoryFile*>(self);
    if (file.at >= file.bytes.size() || size <= 0) return AVERROR_EOF;
    const std::size_t count = std::min(static_cast<std::size_t>(size), file.bytes.size() - file.at);
    std::memcpy(into, file.bytes.data() + file.at, count);
    file.at += count;
    return static_cast<int>(count);
}

int MemoryFile::write(void* self, std::uint8_t* data, int size) {
    auto& file = *static_cast<MemoryFile*>(self);
    const auto count = static_cast<std::size_t>(size);
    if (file.bytes.size() < file.at + count) file.bytes.resize(file.at + count);
    std::memcpy(file.bytes.data() + file.at, data, count);
    file.at += count;
    return size;
}

std::int64_t MemoryFile::seek(void* self, std::int64_t offset, int whence) {
    auto& file = *static_cast<MemoryFile*>(self);
    const auto size = static_cast<std::int64_t>(file.bytes.size());
    if ((whence & AVSEEK_SIZE) != 0) return size;
    const std::int64_t from = whence == SEEK_CUR   ? static_cast<std::int64_t>(file.at)
                              : whence == SEEK_END ? size
                                                   : 0;
    if (from + offset < 0) return AVERROR(EINVAL);
    file.at = static_cast<std::size_t>(from + offset);
    return from + offset;
}

}  // namespace dollytrack::render
