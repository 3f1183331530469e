#pragma once

#include "engine/io/assimp/model_text_repair.h"
#include "engine/io/files/file_source.h"

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// assimp gives up the whole model when its MTL file has fewer bytes, an empty line of some
/// exporter's; without the file it goes on.
constexpr std::size_t kLeastMaterialBytes = 8;

/// A stream of these bytes, for assimp to read and to delete.
[[nodiscard]] Assimp::IOStream* openBytes(std::vector<std::uint8_t> bytes);

/// Shows assimp the files of a FileSource and nothing else of the machine. A file that is damaged
/// is not there.
class AssimpFiles : public Assimp::IOSystem {
  public:
    /// `files` and `repairs` have to outlive this object.
    AssimpFiles(const FileSource& files, ModelTextRepairs& repairs)
        : files_(files), repairs_(repairs) {}

    bool Exists(const char* name) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override;
    void Close(Assimp::IOStream* stream) override { delete stream; }

  private:
    const FileSource& files_;
    ModelTextRepairs& repairs_;
};

}  // namespace dollytrack
