#pragma once

#include "engine/core/random.h"
#include "engine/core/result.h"
#include "engine/generate/furniture_pool.h"
#include "engine/generate/room_layout.h"
#include "engine/generate/room_spec.h"
#include "engine/jobs/job.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::generate {

/// A furnished room as its files.
struct GeneratedRoom {
    std::vector<std::uint8_t> home;  // room.sh3d: walls, furniture, models and pictures
    nlohmann::ordered_json truth;    // objects.json
    std::string licenses;            // LICENSES
    int objects = 0;                 // doors and windows aside
};

/// Makes rooms of a furniture library; each model is read once.
class RoomGenerator {
  public:
    /// `catalog` has to outlive this object.
    explicit RoomGenerator(const FurnitureCatalog& catalog) : catalog_(catalog), pool_(catalog) {}

    /// The room of this seed and number: the same whatever was made before. Errors: Cancelled, and
    /// BadInput where the library is damaged.
    Result<GeneratedRoom> make(const RoomSpec& spec, std::uint64_t seed, std::uint64_t number,
                               const JobContext& job);

  private:
    const FurnitureCatalog& catalog_;
    FurniturePool pool_;
};

/// What the room holds, before it is written.
RoomLayout layOut(const RoomSpec& spec, FurniturePool& pool, Random& random, const JobContext& job);

}  // namespace dollytrack::generate
