#include "engine/generate/room_generator.h"

#include "engine/generate/model_files.h"
#include "engine/generate/placed_model.h"
#include "engine/generate/room_furnisher.h"
#include "engine/generate/room_shell.h"
#include "engine/generate/room_truth.h"
#include "engine/generate/surface_stacker.h"
#include "engine/io/homes/home_writer.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

std::vector<std::uint8_t> bytesOf(const std::string& text) {
    return {text.begin(), text.end()};
}

/// The .sh3d archive: home, textures, models and licences.
Result<std::vector<std::uint8_t>> archiveOf(const RoomLayout& layout,
                                            const std::vector<std::string>& names, RoomKind kind,
                                            const std::string& licenses,
                                            const FurnitureCatalog& catalog, Random& random) {
    homes::Home home;
    std::vector<ArchiveFile> files = {{"Home.xml", {}}, {"LICENSES", bytesOf(licenses)}};
    if (Status done = addShell(layout, kind, random, home, files); !done) {
        return tl::unexpected(done.error());
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        home.pieces.push_back(homePiece(layout.pieces()[i], names[i]));
    }
    files.front().bytes = bytesOf(homes::homeXml(home, "room.sh3d"));
    auto models = modelFiles(layout, catalog);
    if (!models) return tl::unexpected(models.error());
    std::move(models->begin(), models->end(), std::back_inserter(files));
    return makeArchive(files);
}

}  // namespace

RoomLayout layOut(const RoomSpec& spec, FurniturePool& pool, Random& random,
                  const JobContext& job) {
    RoomLayout layout(100.0 * spec.length_m, 100.0 * spec.width_m, 100.0 * spec.height_m);
    Furnisher furnisher{pool, random, job, layout};
    furnish(spec, furnisher);
    // Some of the missing objects are placed on walls and floor, most on the furniture.
    const int missing = spec.objects - layout.furnished();
    decorate(spec.kind, layout.furnished() + std::max(0, missing / 4), missing, furnisher);
    stackItems(spec.objects, furnisher);
    decorate(spec.kind, spec.objects, 2 * spec.objects, furnisher);
    return layout;
}

Result<GeneratedRoom> RoomGenerator::make(const RoomSpec& spec, std::uint64_t seed,
                                          std::uint64_t number, const JobContext& job) {
    if (!pool_.hasPieces()) {
        return fail(ErrorCode::BadInput,
                    "no model of the libraries can furnish a room; models are recognized by words "
                    "in their names, as in Sweet Home 3D's libraries");
    }
    Random random(seed, number);
    const RoomLayout layout = layOut(spec, pool_, random, job);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "room generation was cancelled");
    const std::vector<std::string> names = namesOf(layout);
    GeneratedRoom room;
    room.licenses = licensesOf(layout, catalog_);
    auto home = archiveOf(layout, names, spec.kind, room.licenses, catalog_, random);
    if (!home) return tl::unexpected(home.error());
    room.home = std::move(*home);
    room.objects = layout.furnished();
    room.truth = {{"kind", roomKindName(spec.kind)},
                  {"seed", seed},
                  {"number", number},
                  {"size_m", {spec.length_m, spec.width_m, spec.height_m}},
                  {"objects_asked", spec.objects},
                  {"objects_placed", room.objects},
                  {"objects", truthOf(layout, names)}};
    return room;
}

}  // namespace dollytrack::generate
