#include "engine/io/homes/home_reader.h"
#include "tests/fuzz/memory_file.h"

// Home.xml files, and archives: how libzip reads them and which entry names are refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const dollytrack::fuzz::MemoryFile file(data, size);
    (void)dollytrack::homes::readHome(file.path(), {}, {});
    return 0;
}
