#pragma once

#include "engine/core/result.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/document/project_state.h"
#include "engine/jobs/job.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Sets one parameter in the sections of a project. Errors as setFromJson() gives them.
using SetParameter = std::function<Status(nlohmann::json& parameters, const std::string& name,
                                          const nlohmann::json& value)>;

/// What an operation refers to.
struct OperationContext {
    const Scene& scene;  // with the state's own edits applied
    SetParameter set_parameter;
};

/// Applies one operation, such as {"op":"exclude","object":"lamp_3"}. Objects are named by number
/// or by a name that only one object has. Returns its name for people ("Exclude lamp_3"). Error:
/// Usage, with the field and the closest name for a misspelt one; the state is then unchanged.
Result<std::string> applyOperation(ProjectState& state, const OperationContext& context,
                                   const nlohmann::json& operation);

/// Applies several operations in order, all or none. Each one sees the scene as the ones before it
/// left it. Returns their names. The place of an error begins with the operation's number:
/// "operation 3" is the third. Errors: Usage; Cancelled if the job was cancelled.
Result<std::vector<std::string>> applyOperations(ProjectState& state, const Scene& imported,
                                                 const SetParameter& set_parameter,
                                                 const nlohmann::json& operations,
                                                 const SizeRules& rules = {},
                                                 const JobContext& job = {});

/// One field of an operation.
struct OperationField {
    std::string_view name;
    std::string_view kind;  // "object", "objects", "text", "number", "point", ... for people
    bool required = true;
    std::string_view text;
};

class OperationReader;

/// Applies an operation to the state and returns its name for people. Errors are recorded in the
/// reader; the caller must then discard the state, which may be half changed.
using ApplyOperation = std::string (*)(ProjectState& state, const OperationContext& context,
                                       const OperationReader& fields);

/// One kind of operation. Validation, `dollytrack edit --list` and the manual are generated from
/// this.
struct OperationInfo {
    std::string_view op;
    ApplyOperation apply;
    std::string_view text;
    std::vector<OperationField> fields;
};

/// All kinds of operations, in the order of the manual.
std::span<const OperationInfo> listOperations();

}  // namespace dollytrack
