#include "engine/io/sandbox/cached_inputs.h"
#include "engine/io/sandbox/input_list.h"
#include "engine/io/sandbox/scene_frame.h"

#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

namespace {

/// Prepends a valid header, so that the data behind it is read.
std::vector<std::uint8_t> withHeader(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const Result<io::ReadScene> empty = io::ReadScene{};
    std::vector<std::uint8_t> frame(io::frameSize(empty));
    io::writeFrame(empty, frame);
    constexpr std::size_t kHeaderBytes = 32;
    frame.resize(kHeaderBytes);
    frame.insert(frame.end(), data, data + size);
    const std::uint64_t length = frame.size();
    std::memcpy(frame.data() + 16, &length, sizeof(length));
    io::sealFrame(frame);
    return frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    (void)io::parseInputList(text);
    (void)io::parseCachedInputs(text);
    bool damaged = false;
    const auto scene = io::readFrame(withHeader(data, size), damaged);
    if (!scene) return 0;
    // A frame that was accepted can be written, and is then accepted again.
    std::vector<std::uint8_t> again(io::frameSize(scene));
    io::writeFrame(scene, again);
    if (!io::readFrame(again, damaged)) std::abort();
    return 0;
}
