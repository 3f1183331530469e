#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// The keys of one animated node, one after the other in time.
struct NodeKeys {
    std::vector<float> times_s;
    std::vector<Eigen::Vector3f> translations;
    std::vector<Eigen::Vector4f> rotations;  // x, y, z, w
};

/// A binary glTF 2.0 file, read without the code that wrote it.
class GlbFile {
  public:
    /// Error: BadInput, a sentence of what is wrong with it.
    static Result<GlbFile> read(const std::filesystem::path& path);

    [[nodiscard]] const nlohmann::json& json() const { return json_; }
    /// Of the first animation. Error: BadInput for keys that are missing, or not of one length.
    [[nodiscard]] Result<NodeKeys> keys(int node) const;

  private:
    /// The accessor's floats, so many a value.
    [[nodiscard]] std::vector<float> floats(std::size_t accessor, std::size_t components) const;
    [[nodiscard]] NodeKeys readKeys(int node) const;

    nlohmann::json json_;
    std::string binary_;
};

}  // namespace dollytrack::verify
