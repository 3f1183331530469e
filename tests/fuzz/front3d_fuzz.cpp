#include "engine/io/datasets/front3d_reader.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const dollytrack::fuzz::MemoryFile file(data, size);
    (void)dollytrack::readFront3dScene(file.path(), {}, {});
    return 0;
}
