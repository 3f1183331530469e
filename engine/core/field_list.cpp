#include "engine/core/field_list.h"

#include "engine/core/name_hint.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>

namespace dollytrack {
namespace {

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// Parses the whole text as a number, independently of the locale.
template <class Number>
bool parse(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

std::string join(const std::vector<std::string_view>& names) {
    return fmt::format("{}", fmt::join(names, " | "));
}

Status outOfRange(const Field& field, std::string_view value) {
    return fail(
        ErrorCode::Usage,
        fmt::format("'{}' cannot be used; it must be {}{}{}{}.", value,
                    std::holds_alternative<Field::Integer>(field.value) ? "a whole number in " : "",
                    field.rangeText(), field.unit().empty() ? "" : " ", field.unit()),
        field.name);
}

Status setNumber(const Field& field, double value, std::string_view text) {
    return std::visit(Overloaded{[&](const Field::Integer& f) -> Status {
                                     if (!f.info.range().has(value) || value != std::floor(value)) {
                                         return outOfRange(field, text);
                                     }
                                     *f.value = static_cast<int>(value);
                                     return {};
                                 },
                                 [&](const Field::Real& f) -> Status {
                                     if (!f.info.range().has(value)) return outOfRange(field, text);
                                     *f.value = value;
                                     return {};
                                 },
                                 [&](const auto&) -> Status { return outOfRange(field, text); }},
                      field.value);
}

Status setText(const Field& field, std::string_view text) {
    if (const auto* choice = std::get_if<Field::Choice>(&field.value)) {
        const auto& names = choice->info.names;
        const auto found = std::find(names.begin(), names.end(), text);
        if (found == names.end()) return outOfRange(field, text);
        choice->set(static_cast<int>(found - names.begin()));
        return {};
    }
    if (const auto* on = std::get_if<Field::Switch>(&field.value)) {
        if (text != "true" && text != "false") return outOfRange(field, text);
        *on->value = text == "true";
        return {};
    }
    double value = 0.0;
    if (!parse(text, value)) {
        return fail(ErrorCode::Usage,
                    fmt::format("'{}' is not a number; it must be {}.", text, field.rangeText()),
                    field.name);
    }
    return setNumber(field, value, text);
}

Status setValue(const Field& field, const nlohmann::json& value) {
    if (value.is_number()) return setNumber(field, value.get<double>(), value.dump());
    if (value.is_boolean()) return setText(field, value.get<bool>() ? "true" : "false");
    if (value.is_string()) return setText(field, value.get<std::string>());
    return outOfRange(field, value.type_name());
}

const Field* find(const FieldList& fields, std::string_view name) {
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&](const Field& field) { return field.name == name; });
    return found == fields.end() ? nullptr : &*found;
}

std::string unknownField(const FieldList& fields, std::string_view name) {
    std::vector<std::string> names;
    for (const Field& field : fields) names.push_back(field.name);
    return fmt::format("There is no parameter '{}'{}", name, nameHint(name, names));
}

}  // namespace

std::string_view Field::text() const {
    return std::visit([](const auto& f) { return f.info.text; }, value);
}

std::string_view Field::unit() const {
    return std::visit(Overloaded{[](const Integer& f) { return f.info.unit; },
                                 [](const Real& f) { return f.info.unit; },
                                 [](const auto&) { return std::string_view(); }},
                      value);
}

std::string_view Field::symbol() const {
    return std::visit(Overloaded{[](const Integer& f) { return f.info.symbol; },
                                 [](const Real& f) { return f.info.symbol; },
                                 [](const auto&) { return std::string_view(); }},
                      value);
}

std::string_view Field::onlyWith() const {
    return std::visit(Overloaded{[](const Switch&) { return std::string_view(); },
                                 [](const auto& f) { return f.info.only_with; }},
                      value);
}

std::string Field::valueText() const {
    return std::visit(
        Overloaded{[](const Integer& f) { return fmt::format("{}", *f.value); },
                   [](const Real& f) { return fmt::format("{}", *f.value); },
                   [](const Switch& f) { return std::string(*f.value ? "true" : "false"); },
                   [](const Choice& f) { return std::string(f.info.names[f.get()]); }},
        value);
}

std::string Field::rangeText() const {
    return std::visit(Overloaded{[](const Integer& f) { return f.info.range().text(); },
                                 [](const Real& f) { return f.info.range().text(); },
                                 [](const Switch&) { return std::string("true | false"); },
                                 [](const Choice& f) { return join(f.info.names); }},
                      value);
}

std::string Field::rangeAndConditionText() const {
    return onlyWith().empty() ? rangeText()
                              : fmt::format("{}; only with {}", rangeText(), onlyWith());
}

void letPresetSetOthers(FieldList& fields, std::string_view name,
                        const std::function<void()>& set_others) {
    const auto preset = std::ranges::find(fields, name, &Field::name);
    auto& choice = std::get<Field::Choice>(preset->value);
    choice.set = [set = choice.set, set_others](int index) {
        set(index);
        set_others();
    };
}

Status setField(const FieldList& fields, std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        return fail(ErrorCode::Usage,
                    fmt::format("'{}' is not an assignment; write name=value.", assignment));
    }
    const std::string_view name = assignment.substr(0, equals);
    const Field* field = find(fields, name);
    if (!field) return fail(ErrorCode::Usage, unknownField(fields, name));
    return setText(*field, assignment.substr(equals + 1));
}

std::string withoutEffectBy(const FieldList& fields, const Field& field) {
    const std::string_view condition = field.onlyWith();
    const std::size_t sign = condition.find_first_of("=>");
    if (sign == std::string_view::npos) return {};
    const Field* other = find(fields, condition.substr(0, sign));
    if (!other) return {};
    const std::string now = other->valueText();
    bool holds = false;
    if (condition[sign] == '>') {
        double value = 0.0;
        double least = 0.0;
        holds = parse(now, value) && parse(condition.substr(sign + 1), least) && value > least;
    } else {
        std::string_view values = condition.substr(sign + 1);
        while (!holds && !values.empty()) {
            const std::size_t bar = std::min(values.find('|'), values.size());
            holds = values.substr(0, bar) == now;
            values.remove_prefix(std::min(bar + 1, values.size()));
        }
    }
    return holds ? std::string() : other->name + "=" + now;
}

nlohmann::json toJson(const FieldList& fields) {
    nlohmann::json sections = nlohmann::json::object();
    for (const Field& field : fields) {
        nlohmann::json& slot = sections[field.section][field.name];
        std::visit(Overloaded{[&](const Field::Integer& f) { slot = *f.value; },
                              [&](const Field::Real& f) { slot = *f.value; },
                              [&](const Field::Switch& f) { slot = *f.value; },
                              [&](const Field::Choice&) { slot = field.valueText(); }},
                   field.value);
    }
    return sections;
}

Status setFromJson(const FieldList& fields, const nlohmann::json& sections) {
    if (!sections.is_object()) {
        return fail(ErrorCode::BadInput,
                    "The parameters must be a JSON object with an object for each section.");
    }
    struct Named {
        std::string section;
        const Field* field = nullptr;
        const nlohmann::json* value = nullptr;
    };
    std::vector<Named> named;
    for (const auto& [section, entries] : sections.items()) {
        if (!entries.is_object()) {
            return fail(ErrorCode::BadInput, "A section of parameters must be an object.", section);
        }
        for (const auto& [name, value] : entries.items()) {
            const Field* field = find(fields, name);
            if (!field) return fail(ErrorCode::BadInput, unknownField(fields, name), section);
            named.push_back({section, field, &value});
        }
    }
    // Applied in the order of the field list, because a preset must precede parameters that
    // override it and JSON objects have no order.
    std::ranges::stable_sort(named, std::less(), &Named::field);
    for (const auto& [section, field, value] : named) {
        if (Status status = setValue(*field, *value); !status) {
            return fail(ErrorCode::BadInput, status.error().message, section + "." + field->name);
        }
    }
    return {};
}

std::string closestName(std::string_view wrong, const std::vector<std::string>& names) {
    // Number of letters that are missing, added, changed or swapped with the next one
    // (Damerau-Levenshtein distance).
    const auto slips = [&](std::string_view name) {
        std::vector<std::size_t> row(name.size() + 1);
        std::vector<std::size_t> above = row;
        std::vector<std::size_t> two_above = row;
        std::iota(row.begin(), row.end(), 0U);
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            two_above.swap(above);
            above.swap(row);
            row[0] = i + 1;
            for (std::size_t j = 0; j < name.size(); ++j) {
                const std::size_t change = above[j] + (wrong[i] == name[j] ? 0 : 1);
                row[j + 1] = std::min({above[j + 1] + 1, row[j] + 1, change});
                const bool swapped =
                    i > 0 && j > 0 && wrong[i] == name[j - 1] && wrong[i - 1] == name[j];
                if (swapped) row[j + 1] = std::min(row[j + 1], two_above[j - 1] + 1);
            }
        }
        return row[name.size()];
    };
    std::string best;
    // Short words allow fewer errors: "foo" is not a misspelt "loop".
    const std::size_t length = wrong.size() - std::min(wrong.find_first_not_of('-'), wrong.size());
    std::size_t least = (length < 4 ? 1 : std::max<std::size_t>(2, length / 3)) + 1;
    for (const std::string& name : names) {
        const bool begins = !wrong.empty() && name.starts_with(wrong);
        const std::size_t d = begins ? 1 : slips(name);
        if (d >= least) continue;
        least = d;
        best = name;
    }
    return best;
}

}  // namespace dollytrack
