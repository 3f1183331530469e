#pragma once

#include "engine/core/random.h"
#include "engine/core/result.h"

#include <cstdint>
#include <vector>

namespace dollytrack::generate {

/// Side lengths of the square surfaces that the textures cover, cm. They tile seamlessly.
constexpr double kBoardsSize = 120.0;
constexpr double kTilesSize = 120.0;
constexpr double kPlasterSize = 150.0;

/// Square PNG textures for floors and walls, with random colours and fine detail everywhere, so
/// that feature trackers find corners. Error: as of writing PNG.
Result<std::vector<std::uint8_t>> boardsPicture(Random& random);
Result<std::vector<std::uint8_t>> tilesPicture(Random& random);
Result<std::vector<std::uint8_t>> plasterPicture(Random& random);

}  // namespace dollytrack::generate
