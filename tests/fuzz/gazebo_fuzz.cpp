#include "engine/io/gazebo/sdf_reader.h"
#include "engine/io/gazebo/urdf_reader.h"
#include "tests/fuzz/memory_file.h"

// Worlds and robots; the first byte chooses which of the two readers gets the rest.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    if (size == 0) return 0;
    const fuzz::MemoryFile file(data + 1, size - 1);
    if (data[0] % 2 == 0) {
        (void)gazebo::readSdf(file.path(), {}, {});
    } else {
        (void)gazebo::readUrdf(file.path(), {}, {});
    }
    return 0;
}
