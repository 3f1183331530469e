#include "engine/io/gltf/gltf_reader.h"

#include <new>

// All parts of a glTF file: container, JSON, accessors, Draco and meshoptimizer compression.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const gltf::ReadBeside nothing = [](const std::string& name) -> Result<std::string> {
        return fail(ErrorCode::BadInput, "there is no such file", name);
    };
    try {
        (void)gltf::readGltf(std::string(reinterpret_cast<const char*>(data), size), nothing,
                             "fuzz.glb", {});
    } catch (const std::bad_alloc&) {
        // The importer reports this as an error; here it is only the fuzzer's memory limit.
    }
    return 0;
}
