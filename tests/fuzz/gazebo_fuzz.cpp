#include "engine/io/gazebo/material_script.h"
#include "engine/io/gazebo/sdf_reader.h"
#include "engine/io/gazebo/urdf_reader.h"
#include "tests/fuzz/memory_file.h"

// Worlds, robots and material scripts; the first byte chooses which reader gets the rest.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    if (size == 0) return 0;
    const fuzz::MemoryFile file(data + 1, size - 1);
    if (data[0] % 3 == 2) {
        (void)gazebo::parseMaterialScript({reinterpret_cast<const char*>(data) + 1, size - 1});
    } else if (data[0] % 3 == 1) {
        (void)gazebo::readUrdf(file.path(), {}, {});
    } else {
        (void)gazebo::readSdf(file.path(), {}, {});
    }
    return 0;
}
