#include "app/cli/command_line.h"
#include "engine/core/name_hint.h"
#include "engine/generate/room_generator.h"
#include "engine/io/files/durable_file.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string_view>
#include <vector>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kListName = "generated.json";
constexpr const char* kTruthName = "objects.json";
constexpr const char* kLicensesName = "LICENSES";
constexpr std::string_view kRoomPrefix = "room_";

struct GenerateArguments {
    std::string out;
    std::string library;
    std::vector<std::string> presets;
    std::string size;
    std::optional<int> objects;
    int rooms = 1;
    std::uint64_t seed = 1;
    bool overwrite = false;
    bool as_json = false;
};

/// Parses length, width and height in metres: "5x4x2.7".
Status readSize(std::string_view text, generate::RoomSpec& spec) {
    const auto wrong = [] {
        return fail(ErrorCode::Usage,
                    fmt::format("A size is length x width x height in metres, like 5x4x2.7; sides "
                                "from {} to {}, heights from {} to {}.",
                                generate::kLeastSide, generate::kMostSide, generate::kLeastHeight,
                                generate::kMostHeight),
                    "--size");
    };
    const char* at = text.data();
    const char* end = at + text.size();
    for (double* value : {&spec.length_m, &spec.width_m, &spec.height_m}) {
        const auto [next, error] = std::from_chars(at, end, *value);
        if (error != std::errc{} || (value == &spec.height_m) != (next == end)) return wrong();
        if (next != end && *next != 'x') return wrong();
        at = next == end ? next : next + 1;
    }
    const auto in = [](double value, double low, double high) {
        return value >= low && value <= high;  // also false for NaN
    };
    if (!in(spec.length_m, generate::kLeastSide, generate::kMostSide) ||
        !in(spec.width_m, generate::kLeastSide, generate::kMostSide) ||
        !in(spec.height_m, generate::kLeastHeight, generate::kMostHeight)) {
        return wrong();
    }
    return {};
}

Result<std::vector<generate::RoomPreset>> choosePresets(const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (const auto& preset : generate::roomPresets()) known.emplace_back(preset.name);
    std::vector<generate::RoomPreset> chosen;
    for (const std::string& name : names.empty() ? known : names) {
        const generate::RoomPreset* preset = generate::presetNamed(name);
        if (!preset) {
            return fail(ErrorCode::Usage,
                        fmt::format("There is no preset '{}'{}", name, nameHint(name, known)),
                        "--preset");
        }
        chosen.push_back(*preset);
    }
    return chosen;
}

/// The specification of a room: its preset with random variation, unless the user fixed values.
Result<generate::RoomSpec> specOf(const generate::RoomPreset& preset,
                                  const GenerateArguments& arguments, std::uint64_t number) {
    generate::RoomSpec spec = generate::varied(preset.spec, arguments.seed, number);
    if (!arguments.size.empty()) {
        if (Status status = readSize(arguments.size, spec); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    if (arguments.objects) spec.objects = *arguments.objects;
    return spec;
}

bool isRoomName(std::string_view name) {
    if (!name.starts_with(kRoomPrefix) || name.size() == kRoomPrefix.size()) return false;
    return name.find_first_not_of("0123456789", kRoomPrefix.size()) == std::string_view::npos;
}

/// Removes the files that writeRoom() writes; other files stay.
Status removeRooms(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> rooms;
    fs::directory_iterator it(folder, error);
    for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
        if (isRoomName(it->path().filename().string())) rooms.push_back(it->path());
    }
    if (error) return tl::unexpected(writeError(error.value(), folder));
    for (const fs::path& room : rooms) {
        const std::string home = room.filename().string() + ".sh3d";
        for (const fs::path& file : {room / kTruthName, room / kLicensesName, room / home}) {
            fs::remove(file, error);
            if (error) return tl::unexpected(writeError(error.value(), file));
        }
        fs::remove(room, error);  // fails if it contains other files
    }
    return {};
}

/// Refuses folders with other files, and existing rooms unless they may be overwritten.
Status prepareFolder(const fs::path& folder, bool overwrite) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return tl::unexpected(writeError(error.value(), folder));
    if (fs::is_empty(folder, error)) return {};
    if (error) return tl::unexpected(writeError(error.value(), folder));
    if (!fs::exists(folder / kListName)) {
        return fail(ErrorCode::CannotWrite,
                    "The folder contains other files; give an empty or new one.", folder.string());
    }
    if (!overwrite) {
        return fail(ErrorCode::Usage,
                    "The folder contains generated rooms; --overwrite replaces them.",
                    folder.string());
    }
    return removeRooms(folder);
}

Status writeRoom(const generate::GeneratedRoom& room, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return tl::unexpected(writeError(error.value(), folder));
    const std::string name = folder.filename().string() + ".sh3d";
    constexpr auto kLater = Durability::Renamed;
    return writeWhole(folder / kTruthName, room.truth.dump(1) + "\n", kLater)
        .and_then([&] { return writeWhole(folder / kLicensesName, room.licenses, kLater); })
        .and_then([&] { return writeWhole(folder / name, room.home, kLater); });
}

void printRoom(const nlohmann::ordered_json& room) {
    const auto& size = room.at("size_m");
    fmt::print("{:<11} {:<22} {:.2f} x {:.2f} x {:.2f} m  {:>3} objects\n",
               room.at("folder").get<std::string>(), room.at("preset").get<std::string>(),
               size[0].get<double>(), size[1].get<double>(), size[2].get<double>(),
               room.at("objects").get<int>());
}

Status writeList(const GenerateArguments& arguments, const nlohmann::ordered_json& rooms) {
    const nlohmann::ordered_json list = {{"seed", arguments.seed}, {"rooms", rooms}};
    return writeWhole(fs::path(arguments.out) / kListName, list.dump(1) + "\n");
}

/// Generates the rooms one by one; only completely written rooms are listed.
Status generateRooms(const GenerateArguments& arguments,
                     const std::vector<generate::RoomPreset>& presets,
                     const generate::FurnitureCatalog& catalog, const JobContext& job,
                     nlohmann::ordered_json& rooms) {
    generate::RoomGenerator generator(catalog);
    for (int i = 0; i < arguments.rooms; ++i) {
        job.reportItems(i, arguments.rooms);
        const auto number = static_cast<std::uint64_t>(i);
        const generate::RoomPreset& preset = presets[static_cast<std::size_t>(i) % presets.size()];
        const auto spec = specOf(preset, arguments, number);
        if (!spec) return tl::unexpected(spec.error());
        const auto room = generator.make(*spec, arguments.seed, number, job);
        if (!room) return tl::unexpected(room.error());
        const std::string folder = fmt::format("{}{:04}", kRoomPrefix, i);
        if (Status status = writeRoom(*room, fs::path(arguments.out) / folder); !status) {
            return status;
        }
        rooms.push_back({{"folder", folder},
                         {"scene", folder + "/" + folder + ".sh3d"},
                         {"preset", preset.name},
                         {"size_m", {spec->length_m, spec->width_m, spec->height_m}},
                         {"objects", room->objects}});
        if (!arguments.as_json) printRoom(rooms.back());
    }
    job.reportItems(arguments.rooms, arguments.rooms);
    return {};
}

Result<ExitCode> runGenerate(const GenerateArguments& arguments, const Session& session) {
    const auto presets = choosePresets(arguments.presets);
    if (!presets) return tl::unexpected(presets.error());
    if (const auto spec = specOf(presets->front(), arguments, 0); !spec) {
        return tl::unexpected(spec.error());
    }
    const auto catalog = generate::FurnitureCatalog::open(arguments.library);
    if (!catalog) return tl::unexpected(catalog.error());
    if (Status status = prepareFolder(arguments.out, arguments.overwrite); !status) {
        return tl::unexpected(status.error());
    }
    nlohmann::ordered_json rooms = nlohmann::ordered_json::array();
    if (Status status = writeList(arguments, rooms); !status) {
        return tl::unexpected(status.error());
    }
    const JobContext job = session.job().stage(0.0, 1.0, "generating rooms");
    const Status made = generateRooms(arguments, *presets, *catalog, job, rooms);
    // Listed rooms must be on the disk, also after a power failure.
    if (Status status = syncFolder(arguments.out); made && !status) {
        return tl::unexpected(status.error());
    }
    // After cancellation, too: finished rooms are listed.
    if (Status status = writeList(arguments, rooms); made && !status) {
        return tl::unexpected(status.error());
    }
    if (!made) return tl::unexpected(made.error());
    if (arguments.as_json) {
        fmt::print("{}\n",
                   nlohmann::ordered_json{{"seed", arguments.seed}, {"rooms", rooms}}.dump(1));
    }
    return kDone;
}

void listPresets() {
    for (const auto& preset : generate::roomPresets()) {
        const generate::RoomSpec& spec = preset.spec;
        fmt::print("{:<22} {:<12} {:.1f} x {:.1f} x {:.1f} m  {:>3} objects\n", preset.name,
                   generate::roomKindName(spec.kind), spec.length_m, spec.width_m, spec.height_m,
                   spec.objects);
    }
}

}  // namespace

void addGenerateCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand("generate", "Generate furnished rooms for planning");
    auto arguments = std::make_shared<GenerateArguments>();
    command->add_option("--out", arguments->out, "Folder for the rooms, each in its own folder")
        ->required()
        ->type_name("DIR");
    command->add_option("--rooms", arguments->rooms, "Number of rooms (1)")
        ->check(CLI::Range(1, 10'000).description("1 .. 10000"))
        ->type_name("N");
    command->add_option("--seed", arguments->seed, "Random seed (1)")
        ->check(CLI::Range(0, std::numeric_limits<int>::max()).description("0 .. 2147483647"))
        ->type_name("N");
    command
        ->add_option("--preset", arguments->presets,
                     "Kinds of rooms, separated by commas (see --list); default: all in turn")
        ->delimiter(',')
        ->type_name("NAMES");
    command->add_option("--size", arguments->size, "Exact size, m; default: about the preset's")
        ->type_name("LxWxH");
    command
        ->add_option("--objects", arguments->objects,
                     "Number of objects to aim at, at least the essential furniture of the preset; "
                     "default: about the preset's")
        ->check(CLI::Range(1, generate::kMostObjects)
                    .description(fmt::format("1 .. {}", generate::kMostObjects)))
        ->type_name("N");
    command
        ->add_option("--library", arguments->library,
                     "Folder of furniture libraries (.sh3f); default: those of Debian's package "
                     "sweethome3d-furniture")
        ->type_name("DIR");
    command->add_flag("--overwrite", arguments->overwrite, "Replace rooms generated there before");
    command->add_flag("--json", arguments->as_json, "Print the list of rooms as JSON");
    command->add_flag_callback(
        "--list",
        [] {
            listPresets();
            throw CLI::Success();
        },
        "List the presets, then exit");
    command->footer(
        "Each room is a home of Sweet Home 3D with its truth (objects.json: class, position,\n"
        "size, front, supporting object) and the licences of its models (LICENSES). Sizes vary\n"
        "by 5 %, numbers of objects by 10 % around the preset's.\n"
        "Example: dollytrack generate --rooms 20 --seed 7 --out rooms");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runGenerate(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
