#include "engine/core/natural_order.h"

#include <algorithm>
#include <compare>

namespace dollytrack {
namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Removes and returns the leading digits of the text, or one byte if it starts with another
/// character.
std::string_view takePart(std::string_view& text) {
    std::size_t length = 0;
    while (length < text.size() && isDigit(text[length])) ++length;
    const std::string_view part = text.substr(0, std::max<std::size_t>(length, 1));
    text.remove_prefix(part.size());
    return part;
}

/// Compares by value, for any number of digits.
std::strong_ordering compareNumbers(std::string_view a, std::string_view b) {
    a.remove_prefix(std::min(a.find_first_not_of('0'), a.size()));
    b.remove_prefix(std::min(b.find_first_not_of('0'), b.size()));
    if (a.size() != b.size()) return a.size() <=> b.size();
    return a <=> b;
}

}  // namespace

bool comesBefore(std::string_view a, std::string_view b) {
    std::string_view rest_a = a;
    std::string_view rest_b = b;
    while (!rest_a.empty() && !rest_b.empty()) {
        const std::string_view part_a = takePart(rest_a);
        const std::string_view part_b = takePart(rest_b);
        const bool numbers = isDigit(part_a.front()) && isDigit(part_b.front());
        const auto order = numbers ? compareNumbers(part_a, part_b) : part_a <=> part_b;
        if (order != 0) return order < 0;
    }
    if (rest_a.empty() != rest_b.empty()) return rest_a.empty();
    return a < b;
}

}  // namespace dollytrack
