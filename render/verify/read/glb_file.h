#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Animation keys of one node, in order of time.
struct NodeKeys {
    std::vector<float> times_s;
    std::vector<Eigen::Vector3f> translations;
    std::vector<Eigen::Vector4f> rotations;  // x, y, z, w
};

/// Reader of binary glTF 2.0 files, independent of the writer's code.
class GlbFile {
  public:
    /// Reads a file. Returns BadInput, describing the problem, if it is invalid.
    static Result<GlbFile> read(const std::filesystem::path& path);

    [[nodiscard]] const nlohmann::json& json() const { return json_; }
    /// Keys of the first animation. Returns BadInput if keys are missing or their counts differ.
    [[nodiscard]] Result<NodeKeys> keys(int node) const;

  private:
    /// The accessor's floats, `components` per value.
    [[nodiscard]] std::vector<float> floats(std::size_t accessor, std::size_t components) const;
    [[nodiscard]] NodeKeys readKeys(int node) const;

    nlohmann::json json_;
    std::string binary_;
};

}  // namespace dollytrack::verify
