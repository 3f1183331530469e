#pragma once

#include <dlfcn.h>

namespace dollytrack {

/// Loads a library by the name that the linker knows it by; null if it is not installed. It stays
/// loaded until the program ends.
inline void* openSharedLibrary(const char* name) {
    return ::dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

/// Sets `symbol` to the function or variable of this name in the library, or in one that the
/// library depends on. False if there is none.
template <class Symbol>
bool findSymbol(void* library, const char* name, Symbol*& symbol) {
    symbol = reinterpret_cast<Symbol*>(::dlsym(library, name));
    return symbol != nullptr;
}

}  // namespace dollytrack
