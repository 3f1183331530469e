#include "engine/io/semantics/labelled_reader.h"
#include "tests/fuzz/memory_file.h"

// Meshes whose faces or vertices have the numbers of objects.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const dollytrack::fuzz::MemoryFile file(data, size);
    (void)dollytrack::semantics::readPly(file.path(), {});
    return 0;
}
