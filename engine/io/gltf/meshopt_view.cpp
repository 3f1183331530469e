#include "engine/io/gltf/meshopt_view.h"

#include <meshoptimizer.h>

#include <string>

namespace dollytrack::gltf {
namespace {

/// Largest compression ratio of the codecs: 256 equal bytes take four.
constexpr std::size_t kTightest = 64;

/// Decodes after checking the arguments; the library's decoders only check the data.
bool decode(std::span<const std::uint8_t> packed, const std::string& mode, std::size_t count,
            std::size_t stride, std::vector<std::uint8_t>& into) {
    const bool of_indices = stride == 2 || stride == 4;
    if (mode == "ATTRIBUTES" && stride % 4 == 0 && stride <= 256) {
        return meshopt_decodeVertexBuffer(into.data(), count, stride, packed.data(),
                                          packed.size()) == 0;
    }
    if (mode == "TRIANGLES" && of_indices && count % 3 == 0) {
        return meshopt_decodeIndexBuffer(into.data(), count, stride, packed.data(),
                                         packed.size()) == 0;
    }
    if (mode == "INDICES" && of_indices) {
        return meshopt_decodeIndexSequence(into.data(), count, stride, packed.data(),
                                           packed.size()) == 0;
    }
    return false;
}

bool unfilter(const std::string& filter, std::size_t count, std::size_t stride,
              std::vector<std::uint8_t>& bytes) {
    if (filter.empty() || filter == "NONE") return true;
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    } else if (filter == "QUATERNION" && stride == 8) {
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    } else if (filter == "EXPONENTIAL" && stride % 4 == 0) {
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    } else {
        return false;
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> unpackMeshopt(std::span<const std::uint8_t> packed,
                                        const Json& description) {
    const std::size_t count = requireCount(description, "count");
    const std::size_t stride = requireCount(description, "byteStride");
    const std::size_t most = kTightest * (packed.size() + 1);
    if (stride == 0 || count > most / stride) {
        throw damaged("a compressed buffer view claims more data than its bytes can contain");
    }
    std::vector<std::uint8_t> bytes(count * stride);
    if (count == 0) return bytes;
    const bool whole = decode(packed, textOr(description, "mode"), count, stride, bytes) &&
                       unfilter(textOr(description, "filter"), count, stride, bytes);
    if (!whole) throw damaged("the data of EXT_meshopt_compression is damaged");
    return bytes;
}

}  // namespace dollytrack::gltf
