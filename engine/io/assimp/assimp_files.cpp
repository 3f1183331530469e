#include "engine/io/assimp/assimp_files.h"

#include "engine/io/assimp/model_text_repair.h"
#include "engine/io/files/file_type.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace dollytrack {
namespace {

class BytesStream : public Assimp::IOStream {
  public:
    explicit BytesStream(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

    std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
        if (size == 0) return 0;
        const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
        if (whole > 0) std::memcpy(buffer, bytes_.data() + at_, whole * size);
        at_ += whole * size;
        return whole;
    }
    std::size_t Write(const void* /*buffer*/, std::size_t /*size*/,
                      std::size_t /*count*/) override {
        return 0;
    }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        std::size_t from = 0;
        if (origin == aiOrigin_CUR) from = at_;
        if (origin == aiOrigin_END) from = bytes_.size();
        // assimp passes negative offsets as very large unsigned numbers, which wrap around here.
        const std::size_t to = from + offset;
        if (to > bytes_.size()) return aiReturn_FAILURE;
        at_ = to;
        return aiReturn_SUCCESS;
    }
    [[nodiscard]] std::size_t Tell() const override { return at_; }
    [[nodiscard]] std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

  private:
    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

}  // namespace

Assimp::IOStream* openBytes(std::vector<std::uint8_t> bytes) {
    return new BytesStream(std::move(bytes));
}

bool AssimpFiles::Exists(const char* name) const {
    const auto bytes = files_.read(name);
    return bytes && *bytes;
}

Assimp::IOStream* AssimpFiles::Open(const char* name, const char* mode) {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    auto bytes = files_.read(name);
    const bool material = lowerExtension(name) == ".mtl";
    if (material) repairs_.noteMaterial(name, bytes && *bytes);
    if (!bytes || !*bytes) return nullptr;
    if (material && (**bytes).size() < kLeastMaterialBytes) return nullptr;
    return mendText(openBytes(std::move(**bytes)), lowerExtension(name), repairs_);
}

}  // namespace dollytrack
