#pragma once

#include "engine/io/gltf/gltf_fault.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace dollytrack::gltf {

using Json = nlohmann::json;

/// The value under this key; null where there is none.
[[nodiscard]] const Json& member(const Json& object, const char* key);

/// The object under this key; null where there is none. Fault: it is something else.
[[nodiscard]] const Json& objectAt(const Json& object, const char* key);

/// The list under this key; empty where there is none. Fault: it is something else.
[[nodiscard]] const Json::array_t& listAt(const Json& object, const char* key);

/// The object of an extension; null if the extension is not used. Fault: it is no object.
[[nodiscard]] const Json& extensionOf(const Json& object, const char* extension);

/// A non-negative integer; empty if there is no value. Fault: it is something else.
[[nodiscard]] std::optional<std::size_t> findCount(const Json& object, const char* key);
[[nodiscard]] std::size_t countOr(const Json& object, const char* key, std::size_t otherwise);
/// Fault: it is missing.
[[nodiscard]] std::size_t requireCount(const Json& object, const char* key);

/// A finite number; `otherwise` where there is none. Fault: it is something else.
[[nodiscard]] double numberOr(const Json& object, const char* key, double otherwise);

/// Reads a list of as many numbers as `into` has; leaves `into` unchanged if there is no value.
/// Fault: the list has another length, or holds something else.
template <class Vector>
void readNumbers(const Json& object, const char* key, Vector& into) {
    const Json& list = member(object, key);
    if (list.is_null()) return;
    const std::size_t wanted = into.size();
    if (!list.is_array() || list.size() != wanted) {
        throw damaged(std::string(key) + " does not hold " + std::to_string(wanted) + " numbers");
    }
    for (std::size_t i = 0; i < wanted; ++i) {
        if (!list[i].is_number()) throw damaged(std::string(key) + " holds no numbers");
        into.data()[i] = list[i].get<typename Vector::Scalar>();
    }
}

/// The text under this key, byte for byte; empty where there is none. Fault: it is something else.
[[nodiscard]] std::string textOr(const Json& object, const char* key);

}  // namespace dollytrack::gltf
