#pragma once

#include "engine/core/result.h"
#include "engine/io/gltf/json_fields.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gltf {

using Bytes = std::span<const std::uint8_t>;

/// All of a file that lies beside the glTF file, by the name that the glTF file gives it.
using ReadBeside = std::function<Result<std::string>(const std::string& name)>;

/// A glTF 2.0 file, .gltf or .glb: its JSON, and the bytes of its buffer views, which are read and
/// decompressed when they are first asked for. Throws Fault.
class Document {
  public:
    /// Checks the version and that everything the file requires can be read.
    Document(std::string file, ReadBeside read_beside);

    [[nodiscard]] const Json& json() const { return json_; }

    /// One entry of a list at the top of the JSON: entry("meshes", 3).
    [[nodiscard]] const Json& entry(const char* list, std::size_t index) const;

    /// How many entries such a list has.
    [[nodiscard]] std::size_t size(const char* list) const;

    /// The bytes of a buffer view. May be called from several threads.
    [[nodiscard]] Bytes view(std::size_t index) const;

  private:
    [[nodiscard]] Bytes buffer(std::size_t index) const;
    [[nodiscard]] Bytes slice(const Json& place) const;

    std::string file_;
    std::string_view binary_;  // the BIN chunk, within file_
    Json json_;
    ReadBeside read_beside_;
    mutable std::mutex mutex_;
    mutable std::map<std::size_t, std::string> buffers_;  // read or decoded, by index
    mutable std::map<std::size_t, std::vector<std::uint8_t>> unpacked_;  // views, by index
};

/// The bytes of a "data:" URI; nothing where it is none. Fault: it is one that cannot be decoded.
[[nodiscard]] std::optional<std::string> decodeDataUri(std::string_view uri);

}  // namespace dollytrack::gltf
