#include "engine/io/gltf/draco_mesh.h"

#include "engine/core/clean_text.h"

#include <draco/compression/decode.h>
#include <draco/core/decoder_buffer.h>
#include <draco/mesh/mesh.h>

#include <cmath>
#include <limits>
#include <memory>

namespace dollytrack::gltf {
namespace {

/// Divisor that converts integers to fractions; 1 if the values are already fractions.
float largestOf(const draco::PointAttribute& attribute) {
    if (attribute.normalized()) return 1.0F;  // divided by the library
    switch (attribute.data_type()) {
        case draco::DT_INT8:
            return std::numeric_limits<std::int8_t>::max();
        case draco::DT_UINT8:
            return std::numeric_limits<std::uint8_t>::max();
        case draco::DT_INT16:
            return std::numeric_limits<std::int16_t>::max();
        case draco::DT_UINT16:
            return std::numeric_limits<std::uint16_t>::max();
        default:
            return 1.0F;
    }
}

Elements elementsOf(const draco::PointAttribute& attribute, std::size_t points, bool normalized) {
    Elements elements;
    elements.count = points;
    elements.components = static_cast<std::size_t>(attribute.num_components());
    const bool sound = elements.components >= 1 && elements.components <= 4 &&
                       (attribute.is_mapping_identity() || attribute.indices_map_size() >= points);
    if (!sound) throw damaged("a Draco attribute has no value for each vertex");
    elements.values.resize(points * elements.components);
    const float divisor = normalized ? largestOf(attribute) : 1.0F;
    for (std::size_t i = 0; i < points; ++i) {
        const draco::AttributeValueIndex at =
            attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
        float* out = elements.values.data() + i * elements.components;
        if (at.value() >= attribute.size() ||
            !attribute.ConvertValue<float>(at, static_cast<std::int8_t>(elements.components),
                                           out)) {
            throw damaged("a Draco attribute has no value for each vertex");
        }
        for (std::size_t c = 0; c < elements.components; ++c) out[c] /= divisor;
    }
    return elements;
}

}  // namespace

DracoMesh unpackDraco(const Document& document, const Json& description,
                      const std::map<std::string, bool>& normalized) {
    const Bytes bytes = document.view(requireCount(description, "bufferView"));
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto outcome = decoder.DecodeMeshFromBuffer(&buffer);
    if (!outcome.ok()) {
        throw damaged("its Draco data is damaged: " +
                      cleanText(outcome.status().error_msg_string()));
    }
    const std::unique_ptr<draco::Mesh> mesh = std::move(outcome).value();
    DracoMesh unpacked;
    unpacked.indices.reserve(std::size_t{3} * mesh->num_faces());
    for (std::uint32_t i = 0; i < mesh->num_faces(); ++i) {
        for (const draco::PointIndex& point : mesh->face(draco::FaceIndex(i))) {
            unpacked.indices.push_back(point.value());
        }
    }
    const Json& attributes = objectAt(description, "attributes");
    if (!attributes.is_object()) throw damaged("its Draco data has no attributes");
    for (const auto& [name, id] : attributes.items()) {
        const std::size_t number = requireCount(attributes, name.c_str());
        const draco::PointAttribute* attribute =
            number <= std::numeric_limits<std::uint32_t>::max()
                ? mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(number))
                : nullptr;
        if (!attribute) throw damaged("its Draco data lacks the attribute " + cleanText(name));
        const auto found = normalized.find(name);
        unpacked.attributes[name] =
            elementsOf(*attribute, mesh->num_points(), found != normalized.end() && found->second);
    }
    return unpacked;
}

}  // namespace dollytrack::gltf
