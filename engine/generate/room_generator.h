#pragma once

#include "engine/core/random.h"
#include "engine/core/result.h"
#include "engine/generate/furniture/furniture_pool.h"
#include "engine/generate/room_layout.h"
#include "engine/generate/room_spec.h"
#include "engine/jobs/job.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::generate {

/// The files of a furnished room.
struct GeneratedRoom {
    std::vector<std::uint8_t> home;  // room.sh3d: walls, furniture, models and textures
    nlohmann::ordered_json truth;    // objects.json
    std::string licenses;            // LICENSES
    int objects = 0;                 // without doors and windows
};

/// Generates rooms with the furniture of a catalogue; each model is read once.
class RoomGenerator {
  public:
    /// `catalog` must outlive this object.
    explicit RoomGenerator(const FurnitureCatalog& catalog) : catalog_(catalog), pool_(catalog) {}

    /// Generates the room of this seed and number, independently of earlier calls. Errors:
    /// Cancelled; BadInput if the library is damaged.
    Result<GeneratedRoom> make(const RoomSpec& spec, std::uint64_t seed, std::uint64_t number,
                               const JobContext& job);

  private:
    const FurnitureCatalog& catalog_;
    FurniturePool pool_;
};

/// Furnishes a room, without writing it.
RoomLayout layOut(const RoomSpec& spec, FurniturePool& pool, Random& random, const JobContext& job);

}  // namespace dollytrack::generate
