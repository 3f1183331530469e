#include "app/gather/sources/source.h"

#include "engine/io/settings/class_table_file.h"
#include "engine/jobs/parallel.h"
#include "render/formats/tables/dataset_card.h"
#include "render/verify/read/flow_files.h"
#include "render/verify/read/stored_rig.h"
#include "render/verify/read/track_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

namespace dollytrack::gather {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Conventions that must be equal in all datasets.
constexpr std::array<const char*, 8> kShared = {
    "length_unit",      "world",        "camera_axes",  "pose",
    "quaternion_order", "matrix_order", "pixel_origin", "intrinsics"};

constexpr std::array<const char*, 4> kModalities = {kPicture, kDepth, kInstance, kSemantic};

tl::unexpected<Error> notUsable(const fs::path& folder, const std::string& lacking,
                                const std::string& how) {
    return fail(ErrorCode::BadInput,
                fmt::format("The dataset has no {}; export it with {}.", lacking, how),
                folder.string());
}

/// The folders of all images with a PNG or JPEG file for each frame. Error: BadInput where the rig
/// is damaged.
Result<std::set<std::string>> imageFoldersOf(const verify::StoredDataset& dataset) {
    std::set<std::string> folders(dataset.modalities.begin(), dataset.modalities.end());
    if (dataset.has("cameras")) {
        const Result<std::vector<verify::StoredCamera>> rig = verify::readStoredRig(dataset);
        if (!rig) return tl::unexpected(rig.error());
        for (const verify::StoredCamera& camera : *rig) {
            for (const char* image : verify::kStoredRigImages) {
                const std::string file = camera.file(image, 0);
                folders.insert(file.substr(0, file.rfind('/')));
            }
        }
    }
    std::erase_if(folders, [&](const std::string& folder) {
        return !GuardedFolder::isPlain(folder) ||
               !dataset.sha256s.contains(frameFileOf(dataset, folder, 0));
    });
    return folders;
}

}  // namespace

bool isModality(std::string_view name) {
    return std::ranges::find(kModalities, name) != kModalities.end();
}

std::string frameFileOf(const verify::StoredDataset& dataset, std::string_view modality,
                        std::size_t frame) {
    std::string jpeg = fmt::format("{}/{:06}.jpg", modality, frame);
    if (!isModality(modality) && dataset.sha256s.contains(jpeg)) return jpeg;
    return fmt::format("{}/{:06}.png", modality, frame);
}

std::vector<std::string> frameFilesOf(const verify::StoredDataset& dataset,
                                      const std::string& modality, std::size_t frame) {
    const int index = static_cast<int>(frame);
    if (modality == kTracks) return verify::trackFiles(dataset, index);
    if (modality != kSceneFlow) return {frameFileOf(dataset, modality, frame)};
    std::vector<std::string> names;
    for (const verify::FlowFile& file : verify::pairFiles(dataset, modality, index)) {
        names.push_back(file.stem + ".exr");
    }
    return names;
}

Result<SourceFile> listedFile(const verify::StoredDataset& dataset, const std::string& name) {
    const auto found = dataset.sha256s.find(name);
    if (found != dataset.sha256s.end()) return SourceFile{dataset.folder / name, found->second};
    return fail(ErrorCode::BadInput,
                fmt::format("dataset.json does not list {}; export the dataset again, or leave it "
                            "out with --skip-damaged.",
                            name),
                dataset.folder.string());
}

Json SourceReader::conventionsOf(const verify::StoredDataset& dataset) const {
    Json shared = Json::object();
    for (const char* name : kShared) shared[name] = dataset.convention(name);
    if (needs_.mixed_lenses) {
        shared["intrinsics"] = {{"width", dataset.lens.width}, {"height", dataset.lens.height}};
    }
    for (const std::string& modality : needs_.modalities) {
        // Class masks follow from the class tables, which are compared separately.
        if (modality == kSemantic || !dataset.has(modality)) continue;
        shared[modality] = dataset.convention(modality);
    }
    if (needs_.everything) shared.erase("intrinsics");  // each dataset stays apart
    for (const std::string& format : needs_.required) {
        if (isModality(format)) continue;
        shared[format] = dataset.convention(format);
        // TartanAir's class masks, as above.
        if (shared[format].is_object()) shared[format].erase("seg_left");
    }
    return shared;
}

Status SourceReader::compare(const verify::StoredDataset& dataset) {
    Json own = conventionsOf(dataset);
    if (first_.empty()) {
        first_ = dataset.folder.string();
        conventions_ = std::move(own);
        return {};
    }
    const Json lens = conventions_.value("intrinsics", Json());
    if (!needs_.everything &&
        (lens["width"] != dataset.lens.width || lens["height"] != dataset.lens.height)) {
        return fail(ErrorCode::BadInput,
                    fmt::format("Its images are {} x {} px, those of {} are {} x {} px; gather "
                                "datasets of one size.",
                                dataset.lens.width, dataset.lens.height, first_,
                                lens["width"].dump(), lens["height"].dump()),
                    dataset.folder.string());
    }
    for (const auto& [name, value] : own.items()) {
        if (!conventions_.contains(name)) {
            conventions_[name] = value;  // a modality that the first dataset lacks
            continue;
        }
        if (conventions_[name] == value) continue;
        const char* hint = name == "intrinsics" ? ", or allow lenses to differ with --mixed-lenses"
                           : name == kSceneFlow ? ", or export both with the same --flow-distances"
                                                : "";
        return fail(
            ErrorCode::BadInput,
            fmt::format("Its convention '{}' differs from that of {}; gather the two separately{}.",
                        name, first_, hint),
            dataset.folder.string());
    }
    return {};
}

Result<Source> SourceReader::describe(const verify::StoredDataset& dataset) {
    Source source;
    source.folder = dataset.folder;
    source.frames = dataset.frames.size();
    source.width = dataset.lens.width;
    source.height = dataset.lens.height;
    if (needs_.everything) {
        Result<std::set<std::string>> folders = imageFoldersOf(dataset);
        if (!folders) return tl::unexpected(folders.error());
        source.modalities = std::move(*folders);
    }
    for (const char* modality : kModalities) {
        if (dataset.has(modality)) source.modalities.insert(modality);
    }
    for (const std::string& modality : dataset.modalities) {
        if (isModality(modality)) continue;
        (needs_.modalities.contains(modality) ? source.modalities : source.others).insert(modality);
    }
    try {
        const Json& scene = dataset.card.at("scene");
        source.scene = scene.at("name").get<std::string>();
        source.scene_sha256 = scene.at("sha256").get<std::string>();
        source.geometry_sha256 = scene.at("geometry_sha256").get<std::string>();
        source.product_version = dataset.card.at("product_version").get<std::string>();
    } catch (const Json::exception&) {
        return fail(ErrorCode::BadInput,
                    "A field is missing or of the wrong type; export the dataset again.",
                    (dataset.folder / "dataset.json").string() + ": scene");
    }
    if (const auto listed = dataset.sha256s.find(render::kLicensesFile);
        listed != dataset.sha256s.end()) {
        source.licenses_sha256 = listed->second;
    }
    if (dataset.own_classes) {
        auto& known = tables_[classTableToJson(*dataset.own_classes).dump()];
        if (!known) known = dataset.own_classes;
        source.own_classes = known;
    }
    return source;
}

Status SourceReader::checkFiles(const verify::StoredDataset& dataset, Source& source,
                                const JobContext& job) const {
    std::vector<SourceFile> files;
    const auto add = [&](const std::string& name) -> Status {
        Result<SourceFile> file = listedFile(dataset, name);
        if (!file) return tl::unexpected(file.error());
        std::error_code error;
        const std::uintmax_t bytes = fs::file_size(file->path, error);
        if (error) {
            return fail(
                ErrorCode::BadInput,
                fmt::format(
                    "{} is missing; export the dataset again, or leave the dataset out with "
                    "--skip-damaged.",
                    name),
                dataset.folder.string());
        }
        source.bytes += bytes;
        if (needs_.prove) files.push_back(std::move(*file));
        return {};
    };
    Status status = add(kAnnotationFile);
    if (status && !source.licenses_sha256.empty()) status = add(render::kLicensesFile);
    if (status && needs_.everything && dataset.has("imu")) status = add(kImuFile);
    for (const std::string& modality : source.modalities) {
        if (!needs_.everything && !needs_.modalities.contains(modality)) continue;
        for (std::size_t frame = 0; status && frame < source.frames; ++frame) {
            for (const std::string& name : frameFilesOf(dataset, modality, frame)) {
                if (status) status = add(name);
            }
        }
    }
    for (const std::string& beginning : needs_.copied) {
        for (auto at = dataset.sha256s.lower_bound(beginning);
             status && at != dataset.sha256s.end() && at->first.starts_with(beginning); ++at) {
            status = add(at->first);
        }
    }
    if (!status || files.empty()) return status;
    std::vector<Status> proven(files.size());
    parallelFor(files.size(), [&](std::size_t i) {
        if (!job.cancelled()) proven[i] = prove(files[i]);
    });
    for (const Status& one : proven) {
        if (!one) return one;
    }
    return {};
}

Result<Source> SourceReader::read(const Result<verify::StoredDataset>& dataset,
                                  const JobContext& job) {
    damaged_ = true;
    if (!dataset) return tl::unexpected(dataset.error());
    const fs::path& folder = dataset->folder;
    Result<Source> source = describe(*dataset);
    if (!source) return source;
    source->card_sha256 = dataset->card_sha256;
    damaged_ = false;
    if (needs_.modalities.contains(kPicture) && !source->modalities.contains(kPicture)) {
        return notUsable(folder, "colour images", "--modalities rgb");
    }
    if (!dataset->has("coco")) return notUsable(folder, kAnnotationFile, "--formats coco");
    for (const std::string& name : needs_.required) {
        if (dataset->has(name)) continue;
        return isModality(name)
                   ? notUsable(folder, name + " images", "--modalities rgb," + name)
                   : notUsable(folder, "files in the format " + name, "--formats coco," + name);
    }
    damaged_ = true;
    if (Status whole = checkFiles(*dataset, *source, job); !whole) {
        return tl::unexpected(whole.error());
    }
    if (needs_.check != nullptr) {
        if (Status sound = needs_.check(*dataset); !sound) return tl::unexpected(sound.error());
    }
    damaged_ = false;
    if (Status fits = compare(*dataset); !fits) return tl::unexpected(fits.error());
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "the datasets were not gathered");
    return source;
}

}  // namespace dollytrack::gather
