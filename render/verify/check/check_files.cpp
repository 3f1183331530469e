#include "engine/io/files/sha256.h"
#include "engine/jobs/parallel.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/amodal_masks.h"
#include "render/verify/read/flow_files.h"
#include "render/verify/read/sensor_files.h"
#include "render/verify/read/stored_rig.h"
#include "render/verify/read/track_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

namespace dollytrack::verify {
namespace {

namespace fs = std::filesystem;

/// Files that the modalities and formats in dataset.json require.
std::set<std::string> neededFiles(const StoredDataset& dataset) {
    std::set<std::string> names;
    for (const ImageKind& kind : imageKinds()) {
        if (!dataset.has(kind.modality)) continue;
        for (int frame = 0; frame < static_cast<int>(dataset.frames.size()); ++frame) {
            names.insert(storedFile(dataset, kind, frame));
            if (kind.mask) names.insert(fmt::format("{}/{:06}{}", kind.modality, frame, kind.mask));
        }
    }
    for (int frame = 0; frame < static_cast<int>(dataset.frames.size()); ++frame) {
        if (dataset.has("amodal")) names.insert(amodalFile(frame));
        for (const FlowFile& file : flowFiles(dataset, frame)) {
            names.insert(file.stem + ".flo");
            names.insert(file.stem + "_mask.png");
        }
        for (const FlowFile& file : pairFiles(dataset, "scene_flow", frame)) {
            names.insert(file.stem + ".exr");
        }
        for (const std::string& file : trackFiles(dataset, frame)) names.insert(file);
    }
    for (const std::string& name : rigImageFiles(dataset)) names.insert(name);
    for (const std::string& format : dataset.formats) {
        const auto convention = dataset.convention(format);
        if (!convention.is_object()) continue;
        for (const char* const key : {"file", "files"}) {
            const auto named = convention.value(key, nlohmann::ordered_json());
            if (named.is_string()) names.insert(named.get<std::string>());
            if (!named.is_array()) continue;
            for (const auto& name : named) {
                if (name.is_string()) names.insert(name.get<std::string>());
            }
        }
    }
    return names;
}

/// Frame number in an image's name, if any.
std::optional<int> frameOf(const std::string& name) {
    const std::string stem = fs::path(name).stem().string();
    if (stem.size() < 6 || stem.find_first_not_of("0123456789") < 6) return std::nullopt;
    return std::stoi(stem.substr(0, 6));
}

void findForeign(const StoredDataset& dataset, Findings& findings) {
    std::set<std::string> there;
    std::error_code error;
    for (auto at = fs::recursive_directory_iterator(dataset.folder, error);
         !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
        std::error_code unknown;
        if (at->is_directory(unknown)) continue;
        there.insert(at->path().lexically_relative(dataset.folder).generic_string());
    }
    if (error) {
        findings.add({{}, {}, {}, "a folder that cannot be read: " + error.message(), "its files"});
    }
    for (const std::string& name : there) {
        if (name == "dataset.json" || dataset.sha256s.contains(name)) continue;
        // Files of an unfinished export that may replace this dataset.
        if (name == ".dollytrack-export" || name.starts_with(".dollytrack-new/")) continue;
        findings.add({name, {}, {}, "a file that dataset.json does not name", "no such file"});
    }
}

/// Whether a path stays inside the dataset folder.
bool staysInside(const std::string& name) {
    const fs::path path(name);
    if (path.is_absolute()) return false;
    for (const fs::path& part : path) {
        if (part == "..") return false;
    }
    return true;
}

/// Largest possible size of a file of this dataset, bytes; hashing larger ones could take hours.
std::uintmax_t mostBytes(const StoredDataset& dataset) {
    constexpr std::uintmax_t kOfTables = std::uintmax_t{1} << 32U;
    constexpr std::uintmax_t kOfPixel = 256;  // of all images of a frame together, in an HDF5 file
    const auto pixels = static_cast<std::uintmax_t>(dataset.lens.width) *
                        static_cast<std::uintmax_t>(dataset.lens.height);
    return kOfTables + kOfPixel * pixels * dataset.frames.size();
}

}  // namespace

CheckWork beginFiles(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    for (const std::string& name : neededFiles(dataset)) {
        if (dataset.sha256s.contains(name)) continue;
        findings.add({name, frameOf(name), {}, "not listed in dataset.json", "its hash"});
    }
    findForeign(dataset, findings);
    CheckWork work;
    work.finish = [&dataset](Findings& all, const JobContext& job) {
        const std::vector<std::pair<std::string, std::string>> files(dataset.sha256s.begin(),
                                                                     dataset.sha256s.end());
        std::vector<Findings> found(files.size());
        const std::uintmax_t most_bytes = mostBytes(dataset);
        parallelFor(files.size(), [&](std::size_t i) {
            if (job.cancelled()) return;
            const auto& [name, said] = files[i];
            const auto tell = [&, &name = name](std::string what, std::string expected) {
                found[i].add({name, frameOf(name), {}, std::move(what), std::move(expected)});
            };
            std::error_code error;
            if (!staysInside(name))
                return tell("a path that leads out of the folder", "a file in it");
            const fs::path path = dataset.folder / name;
            if (!fs::exists(path, error)) return tell("missing", "a file");
            const std::uintmax_t size = fs::file_size(path, error);
            if (!error && size > most_bytes) {
                return tell(fmt::format("{} bytes", size), fmt::format("at most {}", most_bytes));
            }
            const Result<std::string> is = sha256OfFile(path, job);
            if (!is) return tell("it cannot be read", "a file");
            if (*is != said) tell("SHA-256 " + *is, said);
        });
        for (const Findings& one : found) all.append(one);
    };
    return work;
}

}  // namespace dollytrack::verify
