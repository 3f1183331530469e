#pragma once

#include "ui/panels/selection/selection_panel.h"

namespace dollytrack::ui {

// One function for each kind of thing that can be selected. Scene and selection are there; with
// those of the second group the plan is, too, and the index is one of it.

// selection_object.cpp
void drawObject(const SelectionView& view, int id, SelectionState& state,
                SelectionActions& actions);
void drawObjects(const SelectionView& view, SelectionState& state, SelectionActions& actions);

// selection_track.cpp: where an object is at which time
void drawTrack(const SelectionView& view, int id, SelectionActions& actions);

// selection_split.cpp: what a split would make of an object, and its limits
void drawSplit(const SelectionView& view, SelectionState& state);
/// "Makes 12 objects of it, the smallest 0.21 m".
std::string splitText(const SelectionView& view, const SplitLimits& limits);

// selection_search.cpp: what was tried for an observation point, and how it ended
void drawSearch(const SelectionView& view, int observation_point, SelectionActions& actions);
void drawCandidate(const SelectionView& view, SelectionActions& actions);

// selection_points.cpp
void drawObservationPoint(const SelectionView& view, SelectionActions& actions);
void drawPositionPoint(const SelectionView& view, SelectionActions& actions);

// selection_way.cpp
void drawEdge(const SelectionView& view, SelectionActions& actions);
void drawRefusedEdge(const SelectionView& view, SelectionActions& actions);
void drawFrame(const SelectionView& view, SelectionActions& actions);
void drawVoxel(const SelectionView& view);

/// The observation point that stands for an object; -1: none.
int observationPointOf(const Plan& plan, int object_id);
/// The frame that stands on a position point; -1: none.
int frameOf(const Plan& plan, int position_point);
/// "view of sofa and 2 more": what a position point is called.
std::string positionPointName(const SelectionView& view, int index);

}  // namespace dollytrack::ui
