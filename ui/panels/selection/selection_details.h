#pragma once

#include "ui/panels/selection/selection_panel.h"

namespace dollytrack::ui {

// One function for each kind of selection. The caller checks that the scene and the selected
// element exist; functions from drawSearch() on also need a plan that contains the index.

// selection_object.cpp
void drawObject(const SelectionView& view, int id, SelectionState& state,
                SelectionActions& actions);
void drawObjects(const SelectionView& view, SelectionState& state, SelectionActions& actions);

// selection_track.cpp: the object's track, its poses by time
void drawTrack(const SelectionView& view, int id, SelectionActions& actions);

// selection_split.cpp: the limits of a split and the pieces it would produce
void drawSplit(const SelectionView& view, SelectionState& state);
/// "Makes 12 objects of it, the smallest 0.21 m"; empty if fewer than two pieces are within the
/// limits.
std::string splitText(const SelectionView& view, const SplitLimits& limits);

// selection_search.cpp: the candidates tested for an observation point, by verdict
void drawSearch(const SelectionView& view, int observation_point, SelectionActions& actions);
void drawCandidate(const SelectionView& view, SelectionActions& actions);

// selection_points.cpp
void drawObservationPoint(const SelectionView& view, SelectionActions& actions);
void drawPositionPoint(const SelectionView& view, SelectionActions& actions);

// selection_path.cpp
void drawEdge(const SelectionView& view, SelectionActions& actions);
void drawRefusedEdge(const SelectionView& view, SelectionActions& actions);
void drawFrame(const SelectionView& view, SelectionActions& actions);
void drawVoxel(const SelectionView& view);

/// Index of the observation point that covers an object; -1: none.
int observationPointOf(const Plan& plan, int object_id);
/// Index of the frame at a position point; -1: none.
int frameOf(const Plan& plan, int position_point);
/// Display name of a position point: "view of sofa and 2 more".
std::string positionPointName(const SelectionView& view, int index);

}  // namespace dollytrack::ui
