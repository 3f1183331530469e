#pragma once

#include "planning/motions/move_settings.h"

#include <Eigen/Core>

#include <map>
#include <string>

namespace dollytrack::ui {

/// The camera move that is being set up, kept between window frames.
struct MoveDraft {
    std::string kind;  // empty: none is chosen, and no form is shown
    /// By kind: the options that are set. The others are chosen to fit the scene.
    std::map<std::string, planning::MoveOptions> options;
    bool drawn = false;  // whether a form was drawn in the last window frame

    /// The request that the form describes, without an object.
    [[nodiscard]] planning::MoveRequest request() const;
};

/// Input of the form for one window frame.
struct MoveFormView {
    std::string why_not;    // why no move can be made now; empty: one can
    std::string target;     // name of the selected object; empty: not exactly one is selected
    bool has_path = false;  // whether the viewport shows the path of the move
    std::string note;  // how obstacles change the move, or why there is none; empty: not at all
    Eigen::Vector3d eye = Eigen::Vector3d::Zero();    // of the viewport's camera, m
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  // the point that it turns about, m
};

/// User actions of this frame.
struct MoveFormActions {
    bool make = false;
    bool show = false;  // bring the path in the viewport into view
};

/// Draws the kinds of moves, and a form with all settings of the chosen one.
MoveFormActions drawMoveForm(const MoveFormView& view, MoveDraft& draft);

}  // namespace dollytrack::ui
