#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::test {

/// Puts a glTF 2.0 file together by hand, so that a test knows every number in it.
class GlbWriter {
  public:
    GlbWriter();

    /// The JSON, to be changed at will before it is written.
    nlohmann::json json;

    /// Adds bytes to the buffer, at a multiple of four; returns their buffer view's index.
    std::size_t addView(std::string_view bytes, std::size_t stride = 0);

    template <class T>
    std::size_t addView(const std::vector<T>& values, std::size_t stride = 0) {
        return addView(std::string_view(reinterpret_cast<const char*>(values.data()),
                                        values.size() * sizeof(T)),
                       stride);
    }

    /// Adds an accessor of a whole view; returns its index.
    std::size_t addAccessor(std::size_t view, int component_type, const char* type,
                            std::size_t count, bool normalized = false);

    /// Adds a mesh of one primitive and a node that has it, and puts the node into the scene.
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
