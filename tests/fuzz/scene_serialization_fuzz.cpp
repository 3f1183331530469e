#include "engine/io/sandbox/cached_inputs.h"
#include "engine/io/sandbox/input_list.h"
#include "engine/io/sandbox/scene_serialization.h"

#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

namespace {

/// Prepends a valid header, so that the data behind it is read.
std::vector<std::uint8_t> withHeader(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const Result<DecodedScene> empty = DecodedScene{};
    std::vector<std::uint8_t> bytes(serializedSize(empty));
    serializeScene(empty, bytes);
    constexpr std::size_t kHeaderBytes = 32;
    bytes.resize(kHeaderBytes);
    bytes.insert(bytes.end(), data, data + size);
    const std::uint64_t length = bytes.size();
    std::memcpy(bytes.data() + 16, &length, sizeof(length));
    updateChecksum(bytes);
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    (void)parseInputList(text);
    (void)parseCachedInputs(text);
    bool damaged = false;
    const auto scene = deserializeScene(withHeader(data, size), damaged);
    if (!scene) return 0;
    // A scene that was accepted can be written, and is then accepted again.
    std::vector<std::uint8_t> again(serializedSize(scene));
    serializeScene(scene, again);
    if (!deserializeScene(again, damaged)) std::abort();
    return 0;
}
