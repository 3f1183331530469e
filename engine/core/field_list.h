#pragma once

#include "engine/core/fields.h"
#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dollytrack {

/// A field of some parameter struct, without its type: what files, `--set` and widgets work on.
/// Points into the struct it was made from.
struct Field {
    struct Choice {
        ChoiceInfo info;
        std::function<int()> get;
        std::function<void(int)> set;
    };
    struct Switch {
        SwitchInfo info;
        bool* value = nullptr;
    };
    struct Integer {
        FieldInfo info;
        int* value = nullptr;
    };
    struct Real {
        FieldInfo info;
        double* value = nullptr;
    };
    std::string section;
    std::string name;
    std::variant<Choice, Switch, Integer, Real> value;

    [[nodiscard]] std::string_view text() const;  // what it means
    [[nodiscard]] std::string_view unit() const;
    [[nodiscard]] std::string_view symbol() const;
    [[nodiscard]] std::string_view onlyWith() const;  // see FieldInfo::onlyWith()
    [[nodiscard]] std::string valueText() const;      // as `--set` reads it
    [[nodiscard]] std::string rangeText() const;      // "0.1 .. 1" or "tour | longest_branch"
    /// The range and what the field needs: "0 .. 1; only with max_frames>0".
    [[nodiscard]] std::string rangeAndConditionText() const;
};

using FieldList = std::vector<Field>;

/// A visitor for the visit...Params functions that lists their fields, with pointers to the visited
/// parameters.
class FieldCollector {
  public:
    void beginSection(std::string_view name) { section_ = name; }
    void operator()(std::string_view name, int& value, const FieldInfo& info) {
        fields_.push_back({section_, std::string(name), Field::Integer{info, &value}});
    }
    void operator()(std::string_view name, double& value, const FieldInfo& info) {
        fields_.push_back({section_, std::string(name), Field::Real{info, &value}});
    }
    void operator()(std::string_view name, bool& value, const SwitchInfo& info) {
        fields_.push_back({section_, std::string(name), Field::Switch{info, &value}});
    }
    template <class Enum>
    void operator()(std::string_view name, Enum& value, const ChoiceInfo& info) {
        fields_.push_back({section_, std::string(name),
                           Field::Choice{info, [&value] { return static_cast<int>(value); },
                                         [&value](int i) { value = static_cast<Enum>(i); }}});
    }
    [[nodiscard]] FieldList take() { return std::move(fields_); }

  private:
    std::string section_;
    FieldList fields_;
};

/// Makes `set_others` run whenever the preset with this name is set: it sets all fields that the
/// preset stands for. Fields that are set later override it.
void letPresetSetOthers(FieldList& fields, std::string_view name,
                        const std::function<void()>& set_others);

/// Sets one field from "name=value" text. Errors: Usage, naming the field, its range, or the
/// closest name when there is none of that name.
Status setField(const FieldList& fields, std::string_view assignment);

/// The value of another field of the list because of which this one has no effect, for example
/// "shake=none"; empty if it has an effect. The condition is that of FieldInfo::onlyWith().
std::string withoutEffectBy(const FieldList& fields, const Field& field);

/// Object of sections, each an object of fields.
nlohmann::json toJson(const FieldList& fields);

/// Sets the fields that the JSON names, in the list's order; those it does not name keep their
/// values. Error: BadInput for a wrong type, an unknown name or a value out of range.
Status setFromJson(const FieldList& fields, const nlohmann::json& sections);

/// The name among `names` that `wrong` was most likely meant to be; empty when none is close.
std::string closestName(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace dollytrack
