#pragma once

#include <array>

namespace dollytrack {

/// The usual range of the longest side of a class of furniture, m.
struct FurnitureSize {
    int nyu40;
    double low;
    double high;
};

/// Wide ranges around the recommendations of interior design handbooks (Panero and Zelnik, Human
/// Dimension and Interior Space, 1979; Neufert, Architects' Data, 4th edition, 2012), so that
/// children's furniture and the largest models on sale fit in. Classes without a usual size are
/// left out.
inline constexpr std::array<FurnitureSize, 20> kFurnitureSizes = {{{3, 0.4, 3.0},    // cabinet
                                                                   {4, 1.1, 2.4},    // bed
                                                                   {5, 0.4, 1.4},    // chair
                                                                   {6, 0.8, 3.6},    // sofa
                                                                   {7, 0.4, 2.8},    // table
                                                                   {8, 1.8, 2.6},    // door
                                                                   {9, 0.5, 3.0},    // window
                                                                   {10, 0.6, 2.6},   // bookshelf
                                                                   {11, 0.1, 2.0},   // picture
                                                                   {14, 0.8, 2.4},   // desk
                                                                   {17, 0.5, 2.0},   // dresser
                                                                   {18, 0.25, 0.9},  // pillow
                                                                   {23, 0.1, 0.5},   // books
                                                                   {24, 0.8, 2.2},   // refrigerator
                                                                   {25, 0.4, 2.2},   // television
                                                                   {32, 0.3, 0.9},   // night stand
                                                                   {33, 0.5, 1.1},   // toilet
                                                                   {34, 0.3, 1.3},   // sink
                                                                   {35, 0.15, 2.0},  // lamp
                                                                   {36, 1.2, 2.2}}};  // bathtub

}  // namespace dollytrack
