#include "engine/io/datasets/front3d_furniture.h"

#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/model_info.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/raw_scene/model_placement.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <set>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNone = -1;

/// The object's name: the last part of the title ("bed/king-size bed"), otherwise the first part of
/// the category ("Cabinet/Shelf/Desk").
std::string nameOf(const Front3dFurniture& piece, const ModelInfo& info) {
    const std::string& category = info.category.empty() ? piece.category : info.category;
    std::string name = piece.title.empty() ? category.substr(0, category.find('/'))
                                           : piece.title.substr(piece.title.rfind('/') + 1);
    while (!name.empty() && name.back() == ' ') name.pop_back();
    while (!name.empty() && name.front() == ' ') name.erase(0, 1);
    return name.empty() ? "furniture" : name;
}

/// The most specific description: the first that names the class of a target, otherwise of a part
/// of the building, otherwise any known word. The title precedes the scene's category, which may be
/// a room ("Living room").
std::string categoryOf(const Front3dFurniture& piece, const ModelInfo& info,
                       const LabelTable& labels) {
    const std::array<std::string, 6> words = {info.category,    piece.title,
                                              piece.category,   info.super_category,
                                              info.category_id, piece.category_id};
    const std::string* best = labels.mostTelling(words);
    return best != nullptr ? *best : std::string();
}

fs::path modelOf(const std::vector<fs::path>& folders,
                 std::initializer_list<const std::string*> ids) {
    for (const std::string* id : ids) {
        if (!isPlainName(*id)) continue;
        if (const auto file = findBelow(folders, fs::path(*id) / "raw_model.obj")) return *file;
    }
    return {};
}

/// Gives a model without textures the texture beside it. ToolBox and ATISS use that texture for
/// every model, independent of its MTL file.
void paintWithTexture(const fs::path& file, RawScene& model) {
    const fs::path folder = file.parent_path();
    const bool has_picture = std::any_of(model.materials.begin(), model.materials.end(),
                                         [](const Material& m) { return m.texture >= 0; });
    if (has_picture || !hasFile(folder / "texture.png")) return;
    TextureRequest request;
    request.name = "texture.png";
    request.folder = folder;
    for (Material& material : model.materials) {
        material.texture = static_cast<int>(model.textures.size());
        material.base_color.setOnes();
    }
    model.textures.push_back(std::move(request));
}

/// Furniture that was left out, for the report: "Bed (jid ...) x 2".
class LeftOut {
  public:
    void add(const std::string& name, const std::string& jid) {
        ++all_;
        if (++counts_[name + (jid.empty() ? "" : " (" + jid + ")")] == 1) {
            order_.push_back(name + (jid.empty() ? "" : " (" + jid + ")"));
        }
    }
    [[nodiscard]] std::size_t count() const { return all_; }
    [[nodiscard]] std::string list() const {
        std::vector<std::string> names;
        for (const std::string& name : order_) {
            const int count = counts_.at(name);
            names.push_back(count == 1 ? name : name + " x " + std::to_string(count));
        }
        return listOf(names, 100);
    }

  private:
    std::size_t all_ = 0;
    std::map<std::string, int> counts_;
    std::vector<std::string> order_;
};

/// A placed piece of furniture.
struct Placed {
    const Front3dChild* child = nullptr;
    const Front3dFurniture* piece = nullptr;
    std::size_t model = kNone;
};

class Furnishing {
  public:
    Furnishing(const Front3dScene& source, const LabelTable& labels,
               const std::vector<fs::path>& folders, RawScene& scene)
        : source_(source), labels_(labels), folders_(folders), scene_(scene) {
        for (const Front3dFurniture& piece : source.furniture)
            pieces_.try_emplace(piece.uid, &piece);
        says_valid_ = std::any_of(source.furniture.begin(), source.furniture.end(),
                                  [](const Front3dFurniture& p) { return p.valid.has_value(); });
        readInfo();
    }

    void choose() {
        for (const Front3dChild& child : source_.children) {
            const auto found = pieces_.find(child.ref);
            if (found == pieces_.end()) continue;  // a mesh, or nothing
            used_.insert(found->second);
            choose(child, *found->second);
        }
    }

    Status place(const std::string& where, const JobContext& job) {
        if (Status read = library_.read(job); !read) return read;
        std::map<std::size_t, ModelPlacement> placements;
        TriangleBudget budget;
        ObjectNames names;
        for (const Placed& one : placed_) {
            const ModelInfo& info = infoOf(*one.piece);
            const std::string base = nameOf(*one.piece, info);
            RawScene* model = library_.model(one.model);
            if (!model) {
                unreadable_.add(base, one.piece->jid);
                continue;
            }
            if (Status fits = budget.take(*model, where); !fits) return fits;
            auto at = placements.find(one.model);
            if (at == placements.end()) {
                paintWithTexture(library_.path(one.model), *model);
                at = placements.try_emplace(one.model, *model, scene_).first;
            }
            SourceObject object;
            object.name = names.next(base);
            object.category = categoryOf(*one.piece, info, labels_);
            object.parts = at->second.place(object.name, one.child->scene_from_model);
            object.front = one.child->turn * Eigen::Vector3d::UnitZ();
            scene_.objects.push_back(std::move(object));
        }
        return {};
    }

    void report() const {
        const auto say = [](std::vector<std::string>& to, const LeftOut& what, const char* one,
                            const char* many) {
            if (what.count() == 0) return;
            to.push_back(counted(what.count(), one, many) + ": " + what.list());
        };
        say(scene_.warnings, missing_, "piece of furniture has no model and was left out",
            "pieces of furniture have no model and were left out");
        if (missing_with_size_ > 0) {
            scene_.notes.push_back("of the furniture without a model, " +
                                   std::to_string(missing_with_size_) +
                                   (missing_with_size_ == 1 ? " has" : " have") +
                                   " a size, but no box is put in its place");
        }
        if (missing_.count() > 0) {
            scene_.notes.push_back(
                "models are looked up as 3D-FUTURE-model/<jid>/raw_model.obj beside the scene, "
                "beside its folder and below the folders given as --models");
        }
        say(scene_.warnings, unreadable_,
            "piece of furniture was left out because its model cannot be read",
            "pieces of furniture were left out because their models cannot be read");
        say(scene_.notes, invalid_, "piece of furniture is marked as not valid and was left out",
            "pieces of furniture are marked as not valid and were left out");
        say(scene_.notes, unsaid_,
            "piece of furniture was left out because it is not marked as valid, unlike others",
            "pieces of furniture were left out because they are not marked as valid, unlike "
            "others");
        const std::size_t unused = pieces_.size() - used_.size();
        if (unused > 0) {
            scene_.notes.push_back(counted(unused, "listed piece of furniture is in no room",
                                           "listed pieces of furniture are in no room"));
        }
    }

  private:
    void readInfo() {
        const fs::path file = findModelInfo(folders_);
        if (file.empty()) return;
        Result<std::map<std::string, ModelInfo>> read = readModelInfo(file);
        if (read) {
            info_ = std::move(*read);
        } else {
            scene_.warnings.push_back("the categories of the furniture were not read: " +
                                      describe(read.error()));
        }
    }

    [[nodiscard]] const ModelInfo& infoOf(const Front3dFurniture& piece) const {
        static const ModelInfo nothing;
        const auto found = info_.find(piece.jid);
        return found == info_.end() ? nothing : found->second;
    }

    void choose(const Front3dChild& child, const Front3dFurniture& piece) {
        const std::string name = nameOf(piece, infoOf(piece));
        if (says_valid_ && !piece.valid.value_or(false)) {
            (piece.valid ? invalid_ : unsaid_).add(name, piece.jid);
            return;
        }
        const fs::path file = modelOf(folders_, {&piece.jid, &child.replace_jid});
        if (file.empty()) {
            missing_.add(name, piece.jid);
            missing_with_size_ += piece.has_size;
            return;
        }
        placed_.push_back({&child, &piece, library_.add(file)});
    }

    const Front3dScene& source_;
    const LabelTable& labels_;
    const std::vector<fs::path>& folders_;
    RawScene& scene_;
    std::map<std::string, const Front3dFurniture*> pieces_;
    std::set<const Front3dFurniture*> used_;
    std::map<std::string, ModelInfo> info_;
    bool says_valid_ = false;
    ModelLibrary library_{TexturePlace::AroundModelsFolder};
    std::vector<Placed> placed_;
    LeftOut missing_;
    LeftOut unreadable_;
    LeftOut invalid_;
    LeftOut unsaid_;
    std::size_t missing_with_size_ = 0;
};

}  // namespace

Status addFront3dFurniture(const Front3dScene& source, const LabelTable& labels,
                           const std::vector<fs::path>& model_folders, const std::string& where,
                           const JobContext& job, RawScene& scene) {
    Furnishing furnishing(source, labels, model_folders, scene);
    furnishing.choose();
    if (Status placed = furnishing.place(where, job); !placed) return placed;
    furnishing.report();
    return {};
}

}  // namespace dollytrack
