#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// Whether a number or name from a file can be a folder's name: letters, digits, '-', '_', '.', no
/// more than 128 of them, and no "..".
bool isPlainName(const std::string& text);

/// The folders that may hold a data set's models: those given, then `usual` names beside the scene
/// and beside its folder. Each is tried as it is and with the usual names below it.
std::vector<std::filesystem::path> foldersFor(const std::filesystem::path& scene,
                                              const std::vector<std::filesystem::path>& given,
                                              const std::vector<std::string>& usual);

/// The file of this relative path in the first folder that has it. A path that is absolute or
/// leaves the folder, by dots or by links, is not found.
std::optional<std::filesystem::path> findBelow(const std::vector<std::filesystem::path>& folders,
                                               const std::filesystem::path& relative);

/// Where the textures of a library's models are looked up. ShapeNet and 3D-FUTURE have folders
/// "models" with the textures in a folder beside.
enum class TexturePlace { BesideModel, AroundModelsFolder };

/// Models read once each, however often they are placed.
class ModelLibrary {
  public:
    explicit ModelLibrary(TexturePlace textures = TexturePlace::BesideModel)
        : textures_(textures) {}

    /// Notes that a model will be needed; the same number for the same path.
    std::size_t add(const std::filesystem::path& path);
    /// Reads all that were added, in parallel. Error: Cancelled.
    Status read(const JobContext& job);
    /// Null, with a reason, for one that cannot be read or is empty.
    [[nodiscard]] RawScene* model(std::size_t index);
    [[nodiscard]] const std::string& reason(std::size_t index) const;
    [[nodiscard]] const std::filesystem::path& path(std::size_t index) const {
        return paths_[index];
    }

  private:
    TexturePlace textures_;
    std::map<std::filesystem::path, std::size_t> numbers_;
    std::vector<std::filesystem::path> paths_;
    std::vector<RawScene> models_;
    std::vector<std::string> reasons_;
};

/// Warnings and notes of models, each once with the names of the models that have it.
class ModelRemarks {
  public:
    void add(const RawScene& model, const std::string& name);
    /// Adds at most 20 warnings and 20 notes to the scene's, and how many more there are.
    void addTo(RawScene& scene) const;

  private:
    struct Remark {
        std::string text;
        std::vector<std::string> models;  // clean text, in order of appearance
    };
    class List {
      public:
        void add(const std::vector<std::string>& texts, const std::string& name);
        void addTo(std::vector<std::string>& lines, const char* one, const char* many) const;

      private:
        std::vector<Remark> remarks_;
        std::map<std::string, std::size_t> numbers_;  // by text
    };
    List warnings_;
    List notes_;
};

/// Counts triangles as models are placed, so that few bytes cannot ask for endless memory or work:
/// each part counts at least as one, and three vertices as one.
class TriangleBudget {
  public:
    /// Error: BadInput, beyond 6e7 in all.
    Status take(const RawScene& model, const std::string& where);
    /// Counts only the parts of the model with these indices.
    Status take(const RawScene& model, const std::vector<std::size_t>& parts,
                const std::string& where);

  private:
    Status take(std::size_t triangles, const std::string& where);

    std::size_t used_ = 0;
};

}  // namespace dollytrack::io
