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

/// Reads a whole file that the glTF file refers to, by the name used there.
using ReadBeside = std::function<Result<std::string>(const std::string& name)>;

/// A glTF 2.0 file, .gltf or .glb: its JSON and the bytes of its buffer views. A buffer is read,
/// and a view decompressed, when it is first asked for. Throws Fault.
class Document {
  public:
    /// Checks that the version and all required extensions are supported.
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

/// The decoded bytes of a "data:" URI; empty if it is no such URI. Fault: it cannot be decoded.
[[nodiscard]] std::optional<std::string> decodeDataUri(std::string_view uri);

}  // namespace dollytrack::gltf
