#pragma once

#include "planning/plan_params.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace dollytrack::editor {

/// The parameters being edited by the widgets, with their defaults.
class ParameterDraft {
  public:
    ParameterDraft()
        : fields_(planning::listFields(params_)),
          standard_fields_(planning::listFields(standard_)) {}
    ParameterDraft(const ParameterDraft&) = delete;  // not copyable: the fields point into it
    ParameterDraft& operator=(const ParameterDraft&) = delete;

    /// Takes parameters from JSON; returns false if they are invalid.
    bool read(const nlohmann::json& parameters) {
        return setFromJson(fields_, parameters).has_value();
    }
    void reset() { params_ = standard_; }
    [[nodiscard]] const planning::PlanParams& params() const { return params_; }
    [[nodiscard]] FieldList& fields() { return fields_; }
    [[nodiscard]] const FieldList& standard() const { return standard_fields_; }

    std::string filter;  // text filter for the listed parameters

  private:
    planning::PlanParams params_;
    planning::PlanParams standard_;
    FieldList fields_;
    FieldList standard_fields_;
};

}  // namespace dollytrack::editor
