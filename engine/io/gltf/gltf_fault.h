#pragma once

#include <stdexcept>
#include <string>

namespace dollytrack::gltf {

/// Thrown when a glTF file cannot be read; the text is one sentence that says what to do. It does
/// not leave this folder: readGltf() turns it into an Error.
class Fault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The fault of a file that contradicts itself or the specification: "accessors[3] has no data".
[[nodiscard]] inline Fault damaged(const std::string& what) {
    return Fault("the file cannot be read as glTF (" + what +
                 "); it is damaged or truncated, export it again");
}

}  // namespace dollytrack::gltf
