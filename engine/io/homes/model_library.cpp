#include "engine/io/homes/model_library.h"

#include "engine/io/files/file_type.h"
#include "engine/io/homes/standard_colors.h"
#include "engine/io/models/model_reader.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace dollytrack::homes {
namespace {

/// The extension of a model by its first bytes, since files in a home may have none.
bool looksLikeObj(const std::vector<std::uint8_t>& bytes) {
    const std::string head(
        bytes.begin(),
        bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 4096)));
    if (head.find('\0') != std::string::npos) return false;
    const auto starts_line = [&](std::string_view start) {
        const auto at = head.find(start);
        return at != std::string::npos && (at == 0 || head[at - 1] == '\n');
    };
    return starts_line("v ") || starts_line("g ") || starts_line("o ") || starts_line("usemtl ") ||
           starts_line("mtllib ");
}

/// A file source in which one file also has a second name, with an extension.
class NamedFiles : public FileSource {
  public:
    NamedFiles(const FileSource& files, std::string alias, std::string name)
        : files_(files), alias_(std::move(alias)), name_(std::move(name)) {}
    [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> read(
        const std::string& name) const override {
        return files_.read(name == alias_ ? name_ : name);
    }

  private:
    const FileSource& files_;
    std::string alias_;
    std::string name_;
};

}  // namespace

ModelLibrary::Entry ModelLibrary::read(const std::string& name, const JobContext& job) const {
    Entry entry;
    entry.why = "is not among the home's files";
    for (const FileSource* place : places_) {
        const auto bytes = place->read(name);
        if (!bytes) entry.why = bytes.error().message;
        if (!bytes || !*bytes) continue;
        std::string readable = name;
        static const std::vector<std::string> known = {".obj", ".dae", ".fbx", ".gltf",
                                                       ".glb", ".ply", ".stl"};
        const std::string extension = lowerExtension(name);
        if (std::find(known.begin(), known.end(), extension) == known.end()) {
            if (!looksLikeObj(**bytes)) {
                entry.why = "is in a format that cannot be read; use OBJ, DAE or glTF";
                continue;
            }
            readable += ".obj";
        }
        Result<RawScene> raw = readModel(NamedFiles(*place, readable, name), readable, job);
        if (!raw) {
            entry.why = raw.error().message;
            continue;
        }
        auto model = std::make_unique<FurnitureModel>();
        model->raw = std::move(*raw);
        for (const MeshPart& part : model->raw.parts) {
            if (!part.triangles.empty()) model->bounds.extend(part.bounds.cast<double>());
        }
        if (model->bounds.isEmpty()) {
            entry.why = "holds no triangle";
            continue;
        }
        giveStandardColors(model->raw);
        model->raw.repairs = {};
        entry.model = std::move(model);
        return entry;
    }
    return entry;
}

const FurnitureModel* ModelLibrary::find(const std::string& name, const JobContext& job,
                                         std::string& why) {
    auto found = entries_.find(name);
    if (found == entries_.end()) {
        Entry entry = read(name, job);
        if (job.cancelled()) return nullptr;  // not stored, because the model may be readable
        found = entries_.emplace(name, std::move(entry)).first;
    }
    why = found->second.why;
    return found->second.model.get();
}

}  // namespace dollytrack::homes
