#pragma once

#include "engine/document/operation.h"
#include "tests/support/scene_builder.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dollytrack::test {

/// A substitute for the planner's parameters: a section with two numbers.
inline Status setTestParameter(nlohmann::json& parameters, const std::string& name,
                               const nlohmann::json& value) {
    if (name != "fill" && name != "min_height_m" && name != "max_height_m") {
        return fail(ErrorCode::Usage, "There is no parameter '" + name + "'.");
    }
    if (!value.is_number()) return fail(ErrorCode::Usage, "not a number");
    parameters["test"][name] = value;
    return {};
}

/// A room with an object of two cubes, between two other objects.
inline Scene pairScene() {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});                          // 1..6
    builder.object("lamp").box({0.5, 0.5, 0.5}, {0.2, 0.2, 1.0});  // 7
    builder.object("pair")
        .box({1, 1, 0.25}, {0.5, 0.5, 0.5})  // 8
        .box({3, 2, 0.4}, {0.4, 0.6, 0.8});
    builder.object("mug").box({2, 2.5, 0.05}, {0.1, 0.1, 0.1});  // 9
    return builder.build();
}

/// A project of this scene, edited by operations.
struct Editing {
    Scene imported = pairScene();
    ProjectState state;

    Result<std::vector<std::string>> apply(const nlohmann::json& operations) {
        return applyOperations(state, imported, setTestParameter, operations);
    }
    [[nodiscard]] Scene scene() const { return *applySceneEdits(imported, state.edits.scene); }
    [[nodiscard]] const Object* find(const Scene& in, const std::string& name) const {
        for (const Object& object : in.objects) {
            if (object.name == name) return &object;
        }
        return nullptr;
    }
};

}  // namespace dollytrack::test
