#include "engine/io/hdf5/hdf5_functions.h"

#include <dlfcn.h>

#include <optional>

namespace dollytrack {
namespace {

template <class Symbol>
bool find(void* library, const char* name, Symbol*& symbol) {
    symbol = reinterpret_cast<Symbol*>(::dlsym(library, name));
    return symbol != nullptr;
}

std::optional<Hdf5Functions> load() {
    void* library = ::dlopen(DOLLYTRACK_HDF5_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return std::nullopt;
    Hdf5Functions functions;
    bool found = true;
#define DOLLYTRACK_FIND(name) found = found && find(library, #name, functions.name);
    DOLLYTRACK_HDF5_FUNCTIONS(DOLLYTRACK_FIND)
#undef DOLLYTRACK_FIND
    // It initializes the library's ids.
    if (!found || functions.H5open() < 0) return std::nullopt;
#define DOLLYTRACK_FIND(name, symbol)                \
    {                                                \
        const hid_t* id = nullptr;                   \
        found = found && find(library, #symbol, id); \
        if (found) functions.name = *id;             \
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
