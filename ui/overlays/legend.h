#pragma once

#include "render/overlays/overlay.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// One line of a legend: how something is drawn, what it is, and how many of it there are.
struct LegendEntry {
    enum class Shape { Dot, SmallDot, Cross, Ring, Arrow, Line, DashedLine, Block };
    std::string name;
    Shape shape = Shape::Dot;
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    int count = 0;
};

/// What the colours between two ends mean. The colours are scaleColor(0..1).
struct LegendScale {
    std::string name;
    std::string unit;
    double min = 0.0;
    double max = 1.0;
};

struct Legend {
    std::string title;
    std::vector<LegendEntry> entries;
    std::optional<LegendScale> scale;
};

/// Something to draw together with the legend that explains it. Both are made at once, so that the
/// legend is true.
struct PlanLayer {
    render::Overlay overlay;
    Legend legend;
};

}  // namespace dollytrack::ui
