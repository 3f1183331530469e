#pragma once

#include <cstdint>

namespace dollytrack {

// Command line of `dollytrack-import`: <serialization version> <parent's process id>
// <textures: 0|1> <options as JSON> <scene file> [more folders and files...]. These two descriptors
// must be open.
inline constexpr int kMemoryDescriptor = 3;   // memory of fixed size for the serialized scene
inline constexpr int kMessageDescriptor = 4;  // a pipe for messages

/// A message. It is short enough for a write to the pipe to be atomic.
struct ImporterMessage {
    enum Kind : std::uint32_t {
        Isolated = 1,  // value: the layers that are not available
        Opened = 2,    // value: size of the opened file
        Progress = 3,  // value: millionths done
        Depends = 4,   // value: size of the list of inputs, which follows the scene
        Done = 5,      // value: size of the serialized scene
    };
    std::uint32_t kind = 0;
    std::uint32_t version = 1;
    std::uint64_t value = 0;
};

}  // namespace dollytrack
