#pragma once

#include "engine/core/fields.h"

namespace dollytrack {

/// Limits of a split. Pieces that are smaller, or more than wanted, are joined to the nearest kept
/// piece. Saved with the project.
struct SplitLimits {
    double min_size_m = 0.0;  // longest side of the box of a kept piece
    int max_pieces = 0;       // the largest ones; 0: all
    bool operator==(const SplitLimits&) const = default;
};

/// The one list of these fields: the operation, the project file and the editor follow from it.
template <class Limits, class Visitor>
void visitSplitLimits(Limits& limits, Visitor&& visit) {
    visit("min_size_m", limits.min_size_m,
          FieldInfo{0.0, 100.0, "m",
                    "Longest side of the smallest piece; smaller ones join the nearest piece"});
    visit("max_pieces", limits.max_pieces,
          FieldInfo{0, 65'535, "", "Largest number of pieces; 0: all", {}, 2});
}

}  // namespace dollytrack
