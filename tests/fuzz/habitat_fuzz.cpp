#include "engine/io/habitat/habitat_reader.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const dollytrack::fuzz::MemoryFile file(data, size);
    (void)dollytrack::habitat::readHabitat(file.path(), {}, {});
    (void)dollytrack::habitat::scenesOfDataset(file.path());
    return 0;
}
