#include "engine/io/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace dollytrack::gltf {
namespace {

/// Largest number of elements of a sparse accessor that are not in the file, and so are zero.
constexpr std::size_t kMostZeros = std::size_t{1} << 24U;

std::size_t bytesOf(std::size_t component_type) {
    switch (component_type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            throw damaged(fmt::format("{} is not a component type", component_type));
    }
}

std::size_t componentsOf(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    throw damaged("an accessor's type is neither SCALAR nor VEC2, VEC3 or VEC4");
}

/// Location of an accessor's numbers, which is checked to be within the bytes.
struct Layout {
    const std::uint8_t* first = nullptr;
    std::size_t stride = 0;
    std::size_t count = 0;
    std::size_t components = 1;
    std::size_t component_type = 0;
    bool normalized = false;
};

/// Elements begin `stride` bytes apart; the last one needs only its own size.
Layout place(const Document& document, const Json& where, std::size_t count, std::size_t components,
             std::size_t component_type, bool may_interleave) {
    const std::size_t index = requireCount(where, "bufferView");
    const Bytes bytes = document.view(index);
    const std::size_t size = components * bytesOf(component_type);
    std::size_t stride = 0;
    if (may_interleave) stride = countOr(document.entry("bufferViews", index), "byteStride", 0);
    if (stride == 0) stride = size;
    const std::size_t offset = countOr(where, "byteOffset", 0);
    const bool fits = offset <= bytes.size() && size <= bytes.size() - offset &&
                      count - 1 <= (bytes.size() - offset - size) / stride;
    if (count > 0 && !fits) {
        throw damaged(fmt::format("{} elements reach beyond bufferViews[{}]", count, index));
    }
    return {
        bytes.data() + (count > 0 ? offset : 0), stride, count, components, component_type, false};
}

template <class Number, class Out>
void copyAs(const Layout& from, Out* out) {
    // Signed types have one negative value more than positive ones: both lowest mean -1.
    const bool scale = std::is_floating_point_v<Out> && from.normalized;
    const auto most = static_cast<Out>(std::numeric_limits<Number>::max());
    for (std::size_t i = 0; i < from.count; ++i) {
        const std::uint8_t* at = from.first + i * from.stride;
        for (std::size_t c = 0; c < from.components; ++c, at += sizeof(Number)) {
            Number number;
            std::memcpy(&number, at, sizeof(number));
            auto value = static_cast<Out>(number);
            if (scale) value = std::max(value / most, static_cast<Out>(-1));
            *out++ = value;
        }
    }
}

void copyFloats(const Layout& from, float* out) {
    switch (from.component_type) {
        case 5120:
            return copyAs<std::int8_t>(from, out);
        case 5121:
            return copyAs<std::uint8_t>(from, out);
        case 5122:
            return copyAs<std::int16_t>(from, out);
        case 5123:
            return copyAs<std::uint16_t>(from, out);
        case 5125:
            return copyAs<std::uint32_t>(from, out);
        default: {
            Layout plain = from;
            plain.normalized = false;
            return copyAs<float>(plain, out);
        }
    }
}

std::vector<std::uint32_t> copyIndices(const Layout& from) {
    std::vector<std::uint32_t> indices(from.count);
    if (from.component_type == 5121) {
        copyAs<std::uint8_t>(from, indices.data());
    } else if (from.component_type == 5123) {
        copyAs<std::uint16_t>(from, indices.data());
    } else if (from.component_type == 5125) {
        copyAs<std::uint32_t>(from, indices.data());
    } else {
        throw damaged("indices are not unsigned integers");
    }
    return indices;
}

/// Replaces elements by those of a sparse accessor.
void overlay(const Document& document, const Json& sparse, std::size_t component_type,
             bool normalized, Elements& elements) {
    const std::size_t count = requireCount(sparse, "count");
    const Json& where = objectAt(sparse, "indices");
    const std::vector<std::uint32_t> indices =
        copyIndices(place(document, where, count, 1, requireCount(where, "componentType"), false));
    Layout layout = place(document, objectAt(sparse, "values"), count, elements.components,
                          component_type, false);
    layout.normalized = normalized;
    std::vector<float> values(count * elements.components);
    copyFloats(layout, values.data());
    for (std::size_t i = 0; i < count; ++i) {
        if (indices[i] >= elements.count) {
            throw damaged("a sparse accessor replaces an element that does not exist");
        }
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * elements.components),
                    elements.components,
                    elements.values.begin() +
                        static_cast<std::ptrdiff_t>(indices[i] * elements.components));
    }
}

}  // namespace

Elements readElements(const Document& document, std::size_t accessor) {
    const Json& description = document.entry("accessors", accessor);
    const std::size_t type = requireCount(description, "componentType");
    const Json& normalized = member(description, "normalized");
    const bool is_normalized = normalized.is_boolean() && normalized.get<bool>();
    const Json& sparse = objectAt(description, "sparse");
    Elements elements;
    elements.count = requireCount(description, "count");
    elements.components = componentsOf(textOr(description, "type"));
    if (description.contains("bufferView")) {
        Layout layout =
            place(document, description, elements.count, elements.components, type, true);
        layout.normalized = is_normalized;
        elements.values.resize(elements.count * elements.components);
        copyFloats(layout, elements.values.data());
    } else if (sparse.is_object() && elements.count <= kMostZeros) {
        elements.values.resize(elements.count * elements.components);
    } else {
        throw damaged(fmt::format("accessors[{}] has no data", accessor));
    }
    if (sparse.is_object()) overlay(document, sparse, type, is_normalized, elements);
    return elements;
}

std::vector<std::uint32_t> readIndices(const Document& document, std::size_t accessor) {
    const Json& description = document.entry("accessors", accessor);
    if (textOr(description, "type") != "SCALAR" || description.contains("sparse")) {
        throw damaged(fmt::format("accessors[{}] is not a plain list of indices", accessor));
    }
    if (!description.contains("bufferView")) {
        throw damaged(fmt::format("accessors[{}] has no data", accessor));
    }
    return copyIndices(place(document, description, requireCount(description, "count"), 1,
                             requireCount(description, "componentType"), true));
}

}  // namespace dollytrack::gltf
