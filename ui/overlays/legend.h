#pragma once

#include "render/overlays/overlay.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// One line of a legend: symbol, name and number of elements.
struct LegendEntry {
    enum class Shape { Dot, SmallDot, Cross, Ring, Arrow, Line, DashedLine, Block };
    std::string name;
    Shape shape = Shape::Dot;
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    int count = 0;
};

/// A colour scale with its value range. Colours are scaleColor(0..1).
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

/// An overlay and its legend, built together so that they agree.
struct PlanLayer {
    render::Overlay overlay;
    Legend legend;
};

}  // namespace dollytrack::ui
