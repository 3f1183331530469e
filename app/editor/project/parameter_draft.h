#pragma once

#include "planning/plan_params.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace dollytrack::editor {

/// The parameters as the widgets edit them, beside the standard ones.
class ParameterDraft {
  public:
    ParameterDraft()
        : fields_(planning::listFields(params_)),
          standard_fields_(planning::listFields(standard_)) {}
    ParameterDraft(const ParameterDraft&) = delete;  // its fields point into it
    ParameterDraft& operator=(const ParameterDraft&) = delete;

    /// False where they do not fit.
    bool read(const nlohmann::json& parameters) {
        return setFromJson(fields_, parameters).has_value();
    }
    void reset() { params_ = standard_; }
    [[nodiscard]] const planning::PlanParams& params() const { return params_; }
    [[nodiscard]] FieldList& fields() { return fields_; }
    [[nodiscard]] const FieldList& standard() const { return standard_fields_; }

    std::string filter;  // of the names that are listed

  private:
    planning::PlanParams params_;
    planning::PlanParams standard_;
    FieldList fields_;
    FieldList standard_fields_;
};

}  // namespace dollytrack::editor
