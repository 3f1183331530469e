#include "engine/io/sandbox/input_list.h"

#include "engine/io/sandbox/binary_archive.h"

#include <algorithm>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::size_t kMostUses = 100'000;
constexpr std::ptrdiff_t kMostListings = 1000;  // each is listed again when the entry is validated

template <class Archive, class T>
void useMembers(Archive& archive, T& use) {
    auto& [kind, path, identity] = use;
    auto& [device, inode, size, modified_ns, changed_ns] = identity;
    archive.number(kind);
    if constexpr (Archive::kReads) {
        std::string name;
        archive.text(name);
        path = std::move(name);
    } else {
        archive.text(path.native());
    }
    for (auto* number : {&device, &inode, &size}) archive.number(*number);
    for (auto* time : {&modified_ns, &changed_ns}) archive.number(*time);
}

}  // namespace

std::string inputListText(const std::vector<InputUse>& uses) {
    if (uses.size() > kMostUses) return {};
    return listText(uses, [](auto& to, const InputUse& use) { useMembers(to, use); });
}

std::optional<std::vector<InputUse>> parseInputList(std::string_view text) {
    std::optional<std::vector<InputUse>> uses =
        parseListText<InputUse>(text, 52, [](auto& from, InputUse& use) { useMembers(from, use); });
    if (!uses || uses->size() > kMostUses) return std::nullopt;
    const auto listings = std::ranges::count(*uses, InputUse::Listing, &InputUse::kind);
    if (listings > kMostListings) return std::nullopt;
    for (const InputUse& use : *uses) {
        const bool known = use.kind <= InputUse::Refused;
        if (!known || use.path.native().find('\0') != std::string::npos) return std::nullopt;
    }
    return uses;
}

}  // namespace dollytrack
