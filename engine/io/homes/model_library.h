#pragma once

#include "engine/io/files/file_source.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <Eigen/Geometry>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::homes {

/// A model as furniture uses it.
struct FurnitureModel {
    RawScene raw;
    Eigen::AlignedBox3d bounds;  // in the model's own axes
};

/// Finds models by name in a home's files, then in the folders and archives given besides, and
/// reads each once.
class ModelLibrary {
  public:
    /// Several places, asked in this order; all have to outlive this object.
    explicit ModelLibrary(std::vector<const FileSource*> places) : places_(std::move(places)) {}

    /// Null when there is no such model or it cannot be read; `why` says which.
    const FurnitureModel* find(const std::string& name, const JobContext& job, std::string& why);

  private:
    struct Entry {
        std::unique_ptr<FurnitureModel> model;
        std::string why;
    };
    Entry read(const std::string& name, const JobContext& job) const;

    std::vector<const FileSource*> places_;
    std::map<std::string, Entry> entries_;
};

}  // namespace dollytrack::homes
