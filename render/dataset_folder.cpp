#include "render/dataset_folder.h"

#include "engine/io/durable_file.h"
#include "render/formats/dataset_card.h"

#include <sys/statvfs.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <fstream>
#include <system_error>

namespace dollytrack::render {
namespace {

namespace fs = std::filesystem;

// Present while an export runs, and after one that did not end: tells our folders from others.
constexpr const char* kMarker = ".dollytrack-export";
constexpr std::array<const char*, 4> kSubfolders = {"rgb", "depth", "instance", "semantic"};
constexpr std::array<const char*, 4> kFiles = {"dataset.json", "camera.json", "annotations.json",
                                               "contact_sheet.jpg"};

/// 000000.png, and what a killed run left of it (000000.png.tmp.123).
bool isFrameFile(const std::string& name) {
    const std::size_t digits = name.find_first_not_of("0123456789");
    return digits != std::string::npos && digits >= 6 && name.compare(digits, 4, ".png") == 0 &&
           (name.size() == digits + 4 || name.compare(digits + 4, 5, ".tmp.") == 0);
}

/// Many datasets have a dataset.json; ours says so in it.
bool isOurCard(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return false;
    using Json = nlohmann::json;
    // Somebody else's may be huge: nothing but its `format` is kept.
    const auto keep = [](int depth, Json::parse_event_t event, Json& parsed) {
        return depth != 1 || event != Json::parse_event_t::key || parsed == "format";
    };
    try {
        std::ifstream file(path, std::ios::binary);
        const Json card = Json::parse(file, keep, false);
        return card.is_object() && card.contains("format") && card["format"] == kDatasetFormat;
    } catch (const std::exception&) {  // the stream's buffer throws what read() refuses
        return false;
    }
}

bool isOurs(const fs::path& folder, std::error_code& error) {
    return fs::exists(folder / kMarker, error) || isOurCard(folder / "dataset.json");
}

bool isForeign(const fs::path& folder, std::error_code& error) {
    return !isOurs(folder, error) && !fs::is_empty(folder, error);
}

Error asError(const std::error_code& error, const fs::path& path) {
    return io::writeError(error.value(), path);
}

Status removeOldDataset(const fs::path& folder) {
    std::error_code error;
    // First what says that the dataset is complete.
    for (const char* file : kFiles) {
        fs::remove(folder / file, error);
        if (error) return tl::unexpected<Error>(asError(error, folder / file));
    }
    for (const char* subfolder : kSubfolders) {
        for (const auto& entry : fs::directory_iterator(folder / subfolder, error)) {
            if (!isFrameFile(entry.path().filename().string())) continue;
            fs::remove(entry.path(), error);
            if (error) return tl::unexpected<Error>(asError(error, entry.path()));
        }
        if (error) return tl::unexpected<Error>(asError(error, folder / subfolder));
    }
    return {};
}

}  // namespace

Status prepareDatasetFolder(const fs::path& folder, bool overwrite, std::uint64_t bytes_needed) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return tl::unexpected<Error>(asError(error, folder));
    // create_directories is content with a file in the folder's place.
    if (!fs::is_directory(folder, error)) {
        return tl::unexpected<Error>(io::writeError(ENOTDIR, folder));
    }
    if (!overwrite && isForeign(folder, error)) {
        return fail(ErrorCode::CannotWrite,
                    "the folder holds files that are not a Dollytrack dataset; choose an empty "
                    "folder, or give --overwrite",
                    folder.string());
    }
    if (error) return tl::unexpected<Error>(asError(error, folder));
    struct statvfs space {};
    if (::statvfs(folder.c_str(), &space) == 0 && space.f_blocks > 0) {
        const std::uint64_t free = std::uint64_t{space.f_bavail} * space.f_frsize;
        if (free < bytes_needed) {
            return fail(ErrorCode::CannotWrite,
                        "about " + std::to_string(bytes_needed / 1'000'000 + 1) +
                            " MB are needed and " + std::to_string(free / 1'000'000) +
                            " MB are free; free some space or choose another folder",
                        folder.string());
        }
    }
    // The mark makes the folder ours, so it comes after everything that may be refused.
    if (Status status = io::writeWhole(folder / kMarker, "an export is running or was cut off\n");
        !status) {
        return status;
    }
    for (const char* subfolder : kSubfolders) {
        fs::create_directories(folder / subfolder, error);
        if (error) return tl::unexpected<Error>(asError(error, folder / subfolder));
    }
    // Last: whatever was refused above must not have cost anyone a dataset.
    return removeOldDataset(folder);
}

Status releaseDatasetFolder(const fs::path& folder) {
    std::error_code error;
    fs::remove(folder / kMarker, error);
    if (error) return tl::unexpected<Error>(asError(error, folder / kMarker));
    return io::syncFolder(folder);
}

std::string frameFile(const std::string& subfolder, int index) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "/%06d.png", index);
    return subfolder + name.data();
}

std::uint64_t estimateBytes(int frames, int width, int height) {
    // Measured over real rooms at 640 x 480: see render/README.md.
    constexpr double kBytesPerPixel = 1.6;
    return static_cast<std::uint64_t>(kBytesPerPixel * frames * width * height) + 1'000'000;
}

}  // namespace dollytrack::render
