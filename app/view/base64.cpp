#include "app/view/base64.h"

#include <string_view>

namespace dollytrack::view {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(base64Length(bytes.size()));
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t at) {
            return at < bytes.size() ? static_cast<std::uint32_t>(bytes[at]) : 0U;
        };
        const std::uint32_t word = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        text += kDigits[word >> 18U & 63U];
        text += kDigits[word >> 12U & 63U];
        text += i + 1 < bytes.size() ? kDigits[word >> 6U & 63U] : '=';
        text += i + 2 < bytes.size() ? kDigits[word & 63U] : '=';
    }
    return text;
}

}  // namespace dollytrack::view
