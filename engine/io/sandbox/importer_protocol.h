#pragma once

#include <cstdint>

namespace dollytrack::io {

// How `dollytrack-import` is called: <frame version> <parent's process id> <textures: 0|1>
// <options as JSON> <scene file> [more folders and files...], with these two descriptors open.
inline constexpr int kFrameDescriptor = 3;    // memory of fixed size that takes the frame
inline constexpr int kMessageDescriptor = 4;  // a pipe that takes messages

/// One message; shorter than a pipe's atomic write.
struct ImporterMessage {
    enum Kind : std::uint32_t {
        Isolated = 1,  // value: the layers that could not be had
        Opened = 2,    // value: bytes of a file that is opened
        Progress = 3,  // value: millionths
        Depends = 4,   // value: bytes of the list of inputs behind the frame
        Done = 5,      // value: bytes of the frame
    };
    std::uint32_t kind = 0;
    std::uint32_t version = 1;
    std::uint64_t value = 0;
};

}  // namespace dollytrack::io
