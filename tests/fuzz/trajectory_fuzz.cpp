#include "engine/io/trajectories/trajectory_file.h"
#include "tests/fuzz/memory_file.h"

#include <string_view>

/// The first byte chooses the format. HDF5 is left out: another library reads those files.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    if (size < 1) return 0;
    const auto formats = trajectoryFormats();
    TrajectoryReading reading;
    reading.format = formats[data[0] % formats.size()].name;
    if (std::string_view(reading.format) == "hypersim") return 0;
    const fuzz::MemoryFile file(data + 1, size - 1);
    (void)loadTrajectory(file.path(), reading);
    return 0;
}
