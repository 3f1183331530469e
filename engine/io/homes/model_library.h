#pragma once

#include "engine/io/files/file_source.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

#include <Eigen/Geometry>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::homes {

/// A furniture model.
struct FurnitureModel {
    RawScene raw;
    Eigen::AlignedBox3d bounds;  // in the model's own axes
};

/// Finds models by name in a home's files, then in further folders and archives. Each model is read
/// once.
class ModelLibrary {
  public:
    /// `places` are searched in this order and must outlive this object.
    explicit ModelLibrary(std::vector<const FileSource*> places) : places_(std::move(places)) {}

    /// The model of this name. Null if it does not exist or cannot be read (`why` then has the
    /// reason), or if the job is cancelled.
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
