#pragma once

#include "engine/core/result.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/document/project_state.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Sets one parameter in the sections of a project. Errors as setFromJson() gives them.
using SetParameter = std::function<Status(nlohmann::json& parameters, const std::string& name,
                                          const nlohmann::json& value)>;

/// What an operation is understood in.
struct OperationContext {
    const Scene& scene;  // with the state's own edits applied
    SetParameter set_parameter;
};

/// Applies one operation, such as {"op":"exclude","object":"lamp_3"}. Objects are named by number
/// or by a name that only one object has. Returns its name for people ("Exclude lamp_3"). Error:
/// Usage, with the field and the closest name for a misspelt one; the state is then unchanged.
Result<std::string> applyOperation(ProjectState& state, const OperationContext& context,
                                   const nlohmann::json& operation);

/// Applies a list of them in order, all or none, and follows what definitions do to the scene.
/// Returns their names. An error's place begins with the operation's number, "operation 3" for
/// the third.
Result<std::vector<std::string>> applyOperations(ProjectState& state, const Scene& imported,
                                                 const SetParameter& set_parameter,
                                                 const nlohmann::json& operations,
                                                 const SizeRules& rules = {});

/// One field of an operation.
struct OperationField {
    std::string_view name;
    std::string_view kind;  // "object", "objects", "text", "number", "point", ... for people
    bool required = true;
    std::string_view text;
};

class OperationReader;

/// What applying an operation returns: its name for people. The first thing wrong is in the
/// reader; the state may then be half changed, and the caller drops it.
using ApplyOperation = std::string (*)(ProjectState& state, const OperationContext& context,
                                       const OperationReader& fields);

/// One kind of operation: validation, `dollytrack edit --list` and the manual come from this.
struct OperationInfo {
    std::string_view op;
    ApplyOperation apply;
    std::string_view text;
    std::vector<OperationField> fields;
};

/// All kinds of operations, in the order in which people meet them.
std::span<const OperationInfo> listOperations();

}  // namespace dollytrack
