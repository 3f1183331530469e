#include "engine/io/datasets/scenenet_description.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    (void)dollytrack::parseSceneNet(text, "scene.txt");
    return 0;
}
