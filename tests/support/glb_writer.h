#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::test {

/// Composes a glTF 2.0 file from given values, so that tests know every number in it.
class GlbWriter {
  public:
    GlbWriter();

    /// The JSON; may be changed before writing.
    nlohmann::json json;

    /// Adds bytes to the buffer, aligned to four; returns the index of their buffer view.
    std::size_t addView(std::string_view bytes, std::size_t stride = 0);

    template <class T>
    std::size_t addView(const std::vector<T>& values, std::size_t stride = 0) {
        return addView(std::string_view(reinterpret_cast<const char*>(values.data()),
                                        values.size() * sizeof(T)),
                       stride);
    }

    /// Adds an accessor for a whole buffer view; returns its index.
    std::size_t addAccessor(std::size_t view, int component_type, const char* type,
                            std::size_t count, bool normalized = false);

    /// Adds a mesh with one primitive and a node for it to the scene; returns the node.
    nlohmann::json& addMesh(const char* node_name, nlohmann::json primitive);

    /// The file as .glb.
    [[nodiscard]] std::string glb() const;

    /// The file as .gltf, with its buffer as a data URI.
    [[nodiscard]] std::string gltf() const;

    [[nodiscard]] const std::string& buffer() const { return buffer_; }

  private:
    [[nodiscard]] nlohmann::json finished() const;

    std::string buffer_;
};

}  // namespace dollytrack::test
