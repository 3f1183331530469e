#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// Whether a text from a file is safe as a folder name: at most 128 letters, digits, '-', '_' and
/// '.', without "..".
bool isPlainName(const std::string& text);

/// Candidate folders for a dataset's models: the given ones, then folders with the `usual` names
/// beside the scene and beside its folder; each itself, and its subfolders with the usual names.
std::vector<std::filesystem::path> foldersFor(const std::filesystem::path& scene,
                                              const std::vector<std::filesystem::path>& given,
                                              const std::vector<std::string>& usual);

/// The file with this relative path in the first folder that contains it; nullopt if there is none.
/// Absolute paths and paths that leave the folder, by ".." or symbolic links, are not found.
std::optional<std::filesystem::path> findBelow(const std::vector<std::filesystem::path>& folders,
                                               const std::filesystem::path& relative);

/// Where textures of models are searched for: beside the model, or around its folder "models", for
/// ShapeNet and 3D-FUTURE, whose textures are in a folder beside that one.
enum class TexturePlace { BesideModel, AroundModelsFolder };

/// Reads models, each once, for any number of placements.
class ModelLibrary {
  public:
    explicit ModelLibrary(TexturePlace textures = TexturePlace::BesideModel)
        : textures_(textures) {}

    /// Adds a model to be read. Returns its index; equal paths have the same index.
    std::size_t add(const std::filesystem::path& path);
    /// Reads all added models in parallel. Error: Cancelled.
    Status read(const JobContext& job);
    /// A model, after read(); null if it has no triangles or could not be read, with the cause in
    /// reason().
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

/// Collects the warnings and notes of models, each once with the names of its models.
class ModelRemarks {
  public:
    void add(const RawScene& model, const std::string& name);
    /// Adds at most 20 warnings and 20 notes to the scene, and the number of further ones.
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
        std::map<std::string, std::size_t> numbers_;  // index by text
    };
    List warnings_;
    List notes_;
};

/// Limits the number of placed triangles, because a small file can place a large model many times.
/// Each part counts as at least one triangle, and three vertices as one.
class TriangleBudget {
  public:
    /// Counts a placement of a model. Error: BadInput beyond 6e7 triangles in all.
    Status take(const RawScene& model, const std::string& where);
    /// Counts only the parts of the model with these indices.
    Status take(const RawScene& model, const std::vector<std::size_t>& parts,
                const std::string& where);

  private:
    Status take(std::size_t triangles, const std::string& where);

    std::size_t used_ = 0;
};

}  // namespace dollytrack
