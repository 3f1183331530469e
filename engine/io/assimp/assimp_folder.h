#pragma once

#include "engine/io/assimp/model_text_repair.h"
#include "engine/io/files/confined_folder.h"

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

#include <filesystem>

namespace dollytrack {

/// assimp's view of the file system: the model file itself and what lies beneath its folder, to be
/// read only.
class AssimpFolder : public Assimp::IOSystem {
  public:
    /// `repairs` has to outlive this object.
    AssimpFolder(std::filesystem::path scene, ModelTextRepairs& repairs);

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;
    bool CreateDirectory(const std::string&) override { return false; }
    bool ChangeDirectory(const std::string&) override { return false; }
    bool DeleteFile(const std::string&) override { return false; }

  private:
    std::filesystem::path scene_;
    ConfinedFolder folder_;
    ModelTextRepairs& repairs_;
};

}  // namespace dollytrack
