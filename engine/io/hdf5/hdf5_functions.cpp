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
    const hid_t* native_double = nullptr;
    const hid_t* file_access = nullptr;
    found = found && find(library, "H5T_NATIVE_DOUBLE_g", native_double) &&
            find(library, "H5P_CLS_FILE_ACCESS_ID_g", file_access);
    // H5open() initializes the library's global ids.
    if (!found || functions.H5open() < 0) return std::nullopt;
    functions.native_double = *native_double;
    functions.file_access = *file_access;
    return functions;
}

}  // namespace

const Hdf5Functions* hdf5Functions() {
    static const std::optional<Hdf5Functions> functions = load();
    return functions ? &*functions : nullptr;
}

}  // namespace dollytrack
