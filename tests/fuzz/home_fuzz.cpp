#include "engine/io/homes/home_reader.h"
#include "tests/fuzz/memory_file.h"

// Home.xml, and archives: what libzip makes of them, and which names are refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const dollytrack::fuzz::MemoryFile file(data, size);
    (void)dollytrack::homes::readHome(file.path(), {}, {});
    return 0;
}
