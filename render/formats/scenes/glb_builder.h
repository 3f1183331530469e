#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Collects the binary data of a glTF 2.0 file and packs it with its JSON into a .glb file.
class GlbBuilder {
  public:
    /// Add vertex attributes or indices and return the index of their accessor.
    int addVertices(const std::vector<Eigen::Vector2f>& values);
    int addVertices(const std::vector<Eigen::Vector3f>& values);
    int addIndices(const std::vector<std::uint32_t>& values);
    /// Add animation data and return the index of its accessor.
    int addKeys(const std::vector<float>& values);
    int addKeys(const std::vector<Eigen::Vector3f>& values);
    int addKeys(const std::vector<Eigen::Vector4f>& values);
    /// Adds an encoded image and returns its index.
    int addImage(const std::string& name, const char* mime_type,
                 std::span<const std::uint8_t> bytes);

    /// The file: `root` with all added data. Returns Failed if it exceeds the 4 GB limit of .glb.
    [[nodiscard]] Result<std::string> pack(nlohmann::ordered_json root) const;

  private:
    int addView(const void* data, std::size_t bytes, int target);
    int addFloats(const float* values, std::size_t count, int components, const char* type,
                  int target);

    std::string binary_;
    nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json images_ = nlohmann::ordered_json::array();
};

}  // namespace dollytrack::render
