#include "engine/io/hdf5/hdf5_functions.h"

#include "engine/core/shared_library.h"

#include <optional>

namespace dollytrack {
namespace {

std::optional<Hdf5Functions> load() {
    void* library = openSharedLibrary(DOLLYTRACK_HDF5_LIBRARY);
    if (library == nullptr) return std::nullopt;
    Hdf5Functions functions;
    bool found = true;
#define DOLLYTRACK_FIND(name) found = found && findSymbol(library, #name, functions.name);
    DOLLYTRACK_HDF5_FUNCTIONS(DOLLYTRACK_FIND)
#undef DOLLYTRACK_FIND
    // H5open() initializes the library's ids.
    if (!found || functions.H5open() < 0) return std::nullopt;
#define DOLLYTRACK_FIND(name, symbol)                      \
    {                                                      \
        const hid_t* id = nullptr;                         \
        found = found && findSymbol(library, #symbol, id); \
        if (found) functions.name = *id;                   \
    }
    DOLLYTRACK_HDF5_IDS(DOLLYTRACK_FIND)
#undef DOLLYTRACK_FIND
    if (!found) return std::nullopt;
    return functions;
}

}  // namespace

const Hdf5Functions* hdf5Functions() {
    static const std::optional<Hdf5Functions> functions = load();
    return functions ? &*functions : nullptr;
}

}  // namespace dollytrack
