#include "engine/io/assimp/assimp_folder.h"

#include "engine/io/assimp/assimp_files.h"
#include "engine/io/assimp/model_text_repair.h"
#include "engine/io/files/file_type.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace dollytrack {
namespace {

class FileStream : public Assimp::IOStream {
  public:
    explicit FileStream(InputFile file) : file_(std::move(file)) {}

    std::size_t Read(void* into, std::size_t size, std::size_t count) override {
        if (size == 0 || at_ >= file_.size()) return 0;
        count = std::min(count, (file_.size() - at_) / size);
        const std::size_t got = file_.read(at_, into, size * count);
        at_ += got;
        return got / size;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t base = origin == aiOrigin_CUR   ? at_
                                 : origin == aiOrigin_END ? file_.size()
                                                          : 0;
        // Offsets from the end count backwards, as in assimp's memory streams.
        const std::size_t to = origin == aiOrigin_END ? base - offset : base + offset;
        if (to > file_.size()) return aiReturn_FAILURE;
        at_ = to;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return file_.size(); }
    void Flush() override {}

  private:
    InputFile file_;
    std::size_t at_ = 0;
};

}  // namespace

AssimpFolder::AssimpFolder(std::filesystem::path scene, ModelTextRepairs& repairs)
    : scene_(std::move(scene)), folder_(scene_.parent_path()), repairs_(repairs) {}

bool AssimpFolder::Exists(const char* file) const {
    return scene_ == file || folder_.has(folder_.relative(file));
}

Assimp::IOStream* AssimpFolder::Open(const char* file, const char* mode) {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    const bool is_scene = scene_ == file;
    Result<InputFile> opened =
        is_scene ? openNamedFile(scene_) : folder_.open(folder_.relative(file));
    const bool material = lowerExtension(file) == ".mtl";
    if (material) repairs_.noteMaterial(file, opened.has_value());
    if (!opened) return nullptr;
    if (material && opened->size() < kLeastMaterialBytes) return nullptr;
    return mendText(new FileStream(std::move(*opened)), lowerExtension(file), repairs_);
}

void AssimpFolder::Close(Assimp::IOStream* stream) {
    delete stream;
}

}  // namespace dollytrack
