#pragma once

#include "ui/overlays/legend.h"

#include <vector>

namespace dollytrack::ui {

/// What the signs and colours in the scene mean, as many lines as that takes.
void drawLegends(const std::vector<Legend>& legends);

}  // namespace dollytrack::ui
