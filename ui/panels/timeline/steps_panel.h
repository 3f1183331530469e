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

/// The groups of steps that the paper names; each covers one or more AlgorithmStep::Kind.
enum class StepGroup { Sample, Near, Edge, CollisionFree, Link, Prune, Branch };
constexpr std::size_t kStepGroups = 7;
using StepFilter = std::array<bool, kStepGroups>;

[[nodiscard]] StepGroup groupOf(AlgorithmStep::Kind kind);

/// Input of the panel for one window frame.
struct StepsView {
    const AlgorithmSteps* steps = nullptr;  // null before planning
    std::uint64_t serial = 0;               // changes with every plan
    std::size_t taken = 0;                  // number of displayed steps: 0 .. steps->steps.size()
    bool playing = false;
    std::function<std::string(std::size_t)> describe = {};  // one step as a sentence
};

/// State kept between window frames. The editor advances playback with nextStop() at `per_second`.
struct StepsState {
    StepFilter shown = {true, true, true, true, true, true, true};
    double per_second = 10.0;
    // Cache: indices of the steps that pass the filter, with the plan's serial and the filter they
    // are for.
    std::vector<std::uint32_t> rows;
    std::uint64_t rows_of = 0;
    StepFilter rows_by = {};
    std::size_t scrolled_to = 0;  // `taken` when the list was last scrolled
};

struct StepsActions {
    std::optional<std::size_t> go_to;  // new value of `taken`
    bool toggle_play = false;
};

/// Draws the step list and the controls to step forward and back through the algorithm.
StepsActions drawStepsPanel(const StepsView& view, StepsState& state);

/// The number of steps taken after moving to the next listed step (`direction` 1) or the previous
/// one (-1). `rows`: indices of the listed steps, ascending. Forward from the last, and back from 0
/// steps, returns nullopt; back from the first listed step returns 0.
[[nodiscard]] std::optional<std::size_t> nextStop(const std::vector<std::uint32_t>& rows,
                                                  std::size_t taken, int direction);

}  // namespace dollytrack::ui
