#include "engine/io/gltf/gltf_reader.h"

#include <new>

// Everything a glTF file packs: its container and JSON, accessors, Draco, meshoptimizer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const gltf::ReadBeside nothing = [](const std::string& name) -> Result<std::string> {
        return fail(ErrorCode::BadInput, "there is no such file", name);
    };
    try {
        (void)gltf::readGltf(std::string(reinterpret_cast<const char*>(data), size), nothing,
                             "fuzz.glb", {});
    } catch (const std::bad_alloc&) {
        // The importer says so; here it is the fuzzer's own limit.
    }
    return 0;
}
