#include "engine/io/homes/home_reader.h"

#include "engine/io/files/file_source.h"
#include "engine/io/files/input_file.h"
#include "engine/io/homes/furniture_builder.h"
#include "engine/io/homes/home_xml.h"
#include "engine/io/homes/room_builder.h"
#include "engine/io/homes/wall_builder.h"
#include "engine/io/settings/import_labels.h"
#include "engine/scene/labels.h"

namespace dollytrack::homes {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostXmlBytes = std::size_t{64} << 20;

Result<Home> parse(const std::vector<std::uint8_t>& xml, const std::string& where) {
    if (xml.size() > kMostXmlBytes) {
        return fail(ErrorCode::BadInput, "the home's XML is larger than 64 MiB", where);
    }
    return parseHomeXml({reinterpret_cast<const char*>(xml.data()), xml.size()}, where);
}

Result<Home> homeIn(const FileSource& archive, const std::string& where) {
    const auto xml = archive.read("Home.xml");
    if (!xml) return tl::unexpected(xml.error());
    if (*xml) return parse(**xml, where + ": Home.xml");
    const auto serialized = archive.read("Home");
    if (serialized && *serialized) {
        return fail(ErrorCode::BadInput,
                    "the home was saved by Sweet Home 3D before 5.3, in a Java format that cannot "
                    "be read; open it with version 5.3 or later and save it again",
                    where);
    }
    return fail(ErrorCode::BadInput, "the archive has no Home.xml, so it is not a home", where);
}

void addStructure(const Home& home, HomeMaterials& materials, RawScene& scene) {
    const auto add = [&](const SurfaceMesh& mesh, const std::string& name, int nyu40) {
        if (mesh.empty()) return;
        SourceObject object;
        object.name = name;
        object.nyu40 = nyu40;
        object.structure = true;
        object.parts = mesh.addTo(scene, name);
        scene.objects.push_back(std::move(object));
    };
    const auto outlines = wallOutlines(home.walls);
    for (std::size_t i = 0; i < home.walls.size(); ++i) {
        add(buildWall(home, home.walls[i], outlines[i], materials), "wall_" + std::to_string(i + 1),
            kNyuWall);
    }
    for (std::size_t i = 0; i < home.rooms.size(); ++i) {
        const HomeRoom& room = home.rooms[i];
        const std::string of =
            "_" + (room.name.empty() ? "room_" + std::to_string(i + 1) : room.name);
        add(buildFloor(home, room, materials), "floor" + of, kNyuFloor);
        add(buildCeiling(home, room, materials), "ceiling" + of, kNyuCeiling);
    }
}

void addNotes(const Home& home, RawScene& scene) {
    if (home.hidden > 0) {
        scene.notes.push_back(std::to_string(home.hidden) +
                              " hidden walls, rooms and pieces were left out");
    }
    if (home.levels.size() > 1) {
        scene.notes.push_back("the home has " + std::to_string(home.levels.size()) + " levels");
    }
}

}  // namespace

bool looksLikeHomeXml(std::string_view head) {
    const auto at = head.find("<home");
    if (at == std::string_view::npos || at + 5 >= head.size()) return false;
    return std::string_view(" >/\t\r\n").find(head[at + 5]) != std::string_view::npos;
}

Result<Home> readHomeFile(std::string bytes, const fs::path& path) {
    std::vector<std::uint8_t> raw(bytes.begin(), bytes.end());
    if (!bytes.starts_with("PK")) return parse(raw, path.string());
    const auto archive = openArchive(std::move(raw), path.string());
    if (!archive) return tl::unexpected(archive.error());
    return homeIn(**archive, path.string());
}

Result<RawScene> readHome(const fs::path& path, const ImportOptions& options,
                          const JobContext& job) {
    const std::string where = path.string();
    std::vector<std::unique_ptr<FileSource>> places;
    Result<Home> home = tl::unexpected(Error{});
    const Result<std::string> bytes = readNamedFile(path, std::uint64_t{4} << 30);
    if (!bytes) return tl::unexpected(bytes.error());
    std::vector<std::uint8_t> raw(bytes->begin(), bytes->end());
    if (bytes->starts_with("PK")) {
        auto archive = openArchive(std::move(raw), where);
        if (!archive) return tl::unexpected(archive.error());
        places.push_back(std::move(*archive));
        home = homeIn(*places.front(), where);
    } else {
        places.push_back(openFolder(path.parent_path()));
        home = parse(raw, where);
    }
    if (!home) return tl::unexpected(home.error());
    for (const fs::path& folder : options.model_folders) {
        std::error_code error;
        if (fs::is_directory(folder, error)) {
            places.push_back(openFolder(folder));
            continue;
        }
        auto archive = openArchive(folder);
        if (!archive) return tl::unexpected(archive.error());
        places.push_back(std::move(*archive));
    }
    std::vector<const FileSource*> asked;
    for (const auto& place : places) asked.push_back(place.get());

    RawScene scene;
    scene.file_unit_m = 0.01;
    scene.file_up_axis = 'y';
    addNotes(*home, scene);
    HomeMaterials materials(*asked.front(), scene);
    addStructure(*home, materials, scene);
    ModelLibrary library(asked);
    const Result<LabelTable> labels = labelsOf(options);
    if (!labels) return tl::unexpected(labels.error());
    if (Status done = addFurniture(*home, library, materials, *labels, scene, job); !done) {
        Error error = done.error();
        error.where = where;
        return tl::unexpected(error);
    }
    return scene;
}

std::vector<fs::path> homeInputs(const fs::path& /*path*/, const ImportOptions& options) {
    return options.model_folders;
}

}  // namespace dollytrack::homes
