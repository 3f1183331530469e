#include "engine/scene/class_table.h"

#include "engine/core/name_pattern.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dollytrack {
namespace {

/// An object's name in the forms that patterns are compared with.
struct NameForms {
    std::string whole;  // lower case
    std::string words;  // without numbers, words separated by blanks
};

NameForms formsOf(std::string_view name) {
    NameForms forms{inSmallLetters(name), {}};
    for (const std::string& word : wordsOfName(name)) {
        if (!forms.words.empty()) forms.words += ' ';
        forms.words += word;
    }
    return forms;
}

bool fits(const std::string& pattern, const NameForms& name, int nyu40) {
    const bool has_wildcards = pattern.find_first_of("*?") != std::string::npos;
    const int meant = has_wildcards ? 0 : nyu40FromName(pattern);
    if (meant != 0) return meant == nyu40;
    std::string wanted = inSmallLetters(pattern);
    if (fitsPattern(wanted, name.whole)) return true;
    if (nyu40 != 0 && fitsPattern(wanted, nyu40Name(nyu40))) return true;
    std::ranges::replace_if(
        wanted, [](char c) { return c == '_' || c == '-'; }, ' ');
    return fitsPattern(wanted, name.words);
}

constexpr int kLargestByte = 255;

}  // namespace

ClassTable::ClassTable() : void_{0, std::string(nyu40Name(0)), nyu40Color(0), ""}, is_nyu40_(true) {
    for (int nyu40 = 1; nyu40 <= kNyu40Count; ++nyu40) {
        const bool prop = nyu40 == kNyuOtherProp;
        classes_.push_back({nyu40, std::string(nyu40Name(nyu40)), nyu40Color(nyu40),
                            isStructureClass(nyu40) ? "structure"
                            : prop                  ? "prop"
                                                    : "furnishing"});
    }
}

ClassTable::ClassTable(std::vector<ClassRule> rules, std::optional<std::size_t> other, int void_id)
    : rules_(std::move(rules)),
      void_{void_id, kVoidName, {0, 0, 0}, ""},
      other_(other),
      is_wide_(void_id > kLargestByte) {
    for (const ClassRule& rule : rules_) {
        classes_.push_back(rule.made);
        is_wide_ = is_wide_ || rule.made.id > kLargestByte;
    }
}

const ClassTable& ClassTable::nyu40() {
    static const ClassTable table;
    return table;
}

const DatasetClass* ClassTable::find(int id) const {
    if (id == void_.id) return &void_;
    const auto at = std::ranges::find(classes_, id, &DatasetClass::id);
    return at == classes_.end() ? nullptr : &*at;
}

const DatasetClass& ClassTable::classFor(std::string_view object_name, int nyu40) const {
    if (is_nyu40_) {
        const bool known = nyu40 >= 1 && nyu40 <= kNyu40Count;
        return known ? classes_[nyu40 - 1] : void_;
    }
    const NameForms name = formsOf(object_name);
    for (std::size_t i = 0; i < rules_.size(); ++i) {
        if (std::ranges::any_of(rules_[i].patterns, [&](const std::string& pattern) {
                return fits(pattern, name, nyu40);
            })) {
            return classes_[i];
        }
    }
    return other_ ? classes_[*other_] : void_;
}

const DatasetClass& ClassTable::classOf(const Object& object) const {
    return object.dataset_class ? *object.dataset_class : classFor(object.name, object.nyu40);
}

const DatasetClass* ClassTable::boxClass(const DatasetClass& of_pixels) const {
    if (&of_pixels != &void_) return &of_pixels;
    return is_nyu40_ ? &classes_[kNyuOtherProp - 1] : nullptr;
}

const DatasetClass* ClassTable::boxClassFor(std::string_view object_name, int nyu40) const {
    return boxClass(classFor(object_name, nyu40));
}

const DatasetClass* ClassTable::boxClassOf(const Object& object) const {
    return boxClass(classOf(object));
}

std::array<std::uint8_t, 3> distinctColor(std::size_t index,
                                          std::span<const std::array<std::uint8_t, 3>> taken) {
    constexpr double kGoldenShare = 0.61803398875;
    for (std::size_t step = index;; step += 97) {
        const double hue = 6.0 * std::fmod(kGoldenShare * static_cast<double>(step), 1.0);
        const double value = 255.0 - 35.0 * static_cast<double>(step % 4);
        const double saturation = 0.85 - 0.2 * static_cast<double>(step / 4 % 3);
        const auto channel = [&](double shift) {
            const double at = std::fmod(hue + shift, 6.0);
            const double share = std::clamp(std::min(at, 4.0 - at), 0.0, 1.0);
            return static_cast<std::uint8_t>(std::lround(value * (1.0 - saturation * share)));
        };
        const std::array<std::uint8_t, 3> color = {channel(5.0), channel(3.0), channel(1.0)};
        if (std::ranges::find(taken, color) == taken.end()) return color;
    }
}

void assignDatasetClasses(Scene& scene) {
    if (!scene.class_table) return;
    for (Object& object : scene.objects) {
        const DatasetClass& found = scene.class_table->classFor(object.name, object.nyu40);
        object.dataset_class = {scene.class_table, &found};  // shares ownership of the table
    }
}

}  // namespace dollytrack
