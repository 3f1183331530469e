#pragma once

#include "engine/plan/algorithm_step.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// The kinds of steps as the paper names them; each stands for one or more of AlgorithmStep::Kind.
enum class StepGroup { Sample, Near, Edge, CollisionFree, Link, Prune, Branch };
constexpr std::size_t kStepGroups = 7;
using StepFilter = std::array<bool, kStepGroups>;

[[nodiscard]] StepGroup groupOf(AlgorithmStep::Kind kind);

/// What the panel may read this frame.
struct StepsView {
    const AlgorithmSteps* steps = nullptr;  // null before planning
    std::uint64_t serial = 0;               // another number with every plan
    std::size_t taken = 0;  // steps taken so far, in the picture: 0 .. steps->steps.size()
    bool playing = false;
    std::function<std::string(std::size_t)> describe = {};  // a step in one sentence
};

/// What the panel remembers; the shell plays at `per_second`, with nextStop().
struct StepsState {
    StepFilter shown = {true, true, true, true, true, true, true};
    double per_second = 10.0;
    // Indices of the steps that are shown, of which plan, and by which filter.
    std::vector<std::uint32_t> rows;
    std::uint64_t rows_of = 0;
    StepFilter rows_by = {};
    std::size_t scrolled_to = 0;  // `taken` when the list was last scrolled
};

struct StepsActions {
    std::optional<std::size_t> go_to;  // number of steps taken
    bool toggle_play = false;
};

/// Going through the algorithm step by step, forward and back.
StepsActions drawStepsPanel(const StepsView& view, StepsState& state);

/// How many steps are taken after the next one (`direction` 1) of the kinds shown, or after the one
/// before (-1); nothing at the end. Going back from the first leads to no step at all.
[[nodiscard]] std::optional<std::size_t> nextStop(const std::vector<std::uint32_t>& rows,
                                                  std::size_t taken, int direction);

}  // namespace dollytrack::ui
