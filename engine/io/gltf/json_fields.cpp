#include "engine/io/gltf/json_fields.h"

#include <cmath>

namespace dollytrack::gltf {

const Json& member(const Json& object, const char* key) {
    static const Json nothing;
    if (!object.is_object()) return nothing;
    const auto found = object.find(key);
    return found != object.end() ? *found : nothing;
}

const Json& objectAt(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (!value.is_null() && !value.is_object())
        throw damaged(std::string(key) + " is not an object");
    return value;
}

const Json::array_t& listAt(const Json& object, const char* key) {
    static const Json::array_t nothing;
    const Json& value = member(object, key);
    if (value.is_null()) return nothing;
    if (!value.is_array()) throw damaged(std::string(key) + " is not a list");
    return value.get_ref<const Json::array_t&>();
}

const Json& extensionOf(const Json& object, const char* extension) {
    return objectAt(objectAt(object, "extensions"), extension);
}

std::optional<std::size_t> findCount(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (value.is_null()) return std::nullopt;
    if (value.is_number_unsigned()) return value.get<std::size_t>();
    // Some exporters write 3.0 for 3; larger values than 2^53 are not exact.
    constexpr double kLargest = 9007199254740992.0;
    const double number = value.is_number_float() ? value.get<double>() : -1.0;
    if (!(number >= 0.0 && number <= kLargest) || number != std::floor(number)) {
        throw damaged(std::string(key) + " is not a whole number of zero or more");
    }
    return static_cast<std::size_t>(number);
}

std::size_t countOr(const Json& object, const char* key, std::size_t otherwise) {
    return findCount(object, key).value_or(otherwise);
}

std::size_t requireCount(const Json& object, const char* key) {
    const std::optional<std::size_t> found = findCount(object, key);
    if (!found) throw damaged(std::string(key) + " is missing");
    return *found;
}

double numberOr(const Json& object, const char* key, double otherwise) {
    const Json& value = member(object, key);
    if (value.is_null()) return otherwise;
    if (!value.is_number()) throw damaged(std::string(key) + " is not a number");
    return value.get<double>();
}

std::string textOr(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (value.is_null()) return {};
    if (!value.is_string()) throw damaged(std::string(key) + " is not a text");
    return value.get<std::string>();
}

}  // namespace dollytrack::gltf
