#pragma once

#include "engine/core/random.h"
#include "engine/core/result.h"

#include <cstdint>
#include <vector>

namespace dollytrack::generate {

/// Sides of what the pictures show, cm. They repeat without a seam.
constexpr double kBoardsSize = 120.0;
constexpr double kTilesSize = 120.0;
constexpr double kPlasterSize = 150.0;

/// Square PNG pictures for floors and walls, coloured by chance and fine-grained everywhere, so
/// that whoever tracks features finds some.
Result<std::vector<std::uint8_t>> boardsPicture(Random& random);
Result<std::vector<std::uint8_t>> tilesPicture(Random& random);
Result<std::vector<std::uint8_t>> plasterPicture(Random& random);

}  // namespace dollytrack::generate
