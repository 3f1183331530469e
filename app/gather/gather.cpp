#include "app/gather/gather.h"

#include "app/gather/gather_card.h"
#include "app/gather/output/output_files.h"
#include "app/gather/output/output_folder.h"
#include "app/gather/sources/class_union.h"
#include "app/gather/sources/opened_source.h"
#include "app/gather/sources/read_ahead.h"
#include "app/gather/sources/source_search.h"
#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/sha256.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace dollytrack::gather {
namespace {

namespace fs = std::filesystem;
using render::DatasetIdentity;

constexpr std::string_view kSubsystem = "gather";

tl::unexpected<Error> stopped() {
    return fail(ErrorCode::Cancelled,
                "gathering was stopped; the same command with --resume continues it");
}

/// The datasets and their common properties.
struct Gathered {
    std::vector<Source> sources;
    std::vector<SkippedDataset> skipped;
    std::set<std::string> modalities;  // modalities of all datasets
    nlohmann::ordered_json conventions;
};

/// Whether a folder is `around` or inside it.
bool isWithin(const fs::path& folder, const fs::path& around) {
    std::error_code error;
    const fs::path inner = fs::weakly_canonical(fs::absolute(folder, error), error);
    const fs::path outer = fs::weakly_canonical(fs::absolute(around, error), error);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first ==
           outer.end();
}

Status checkOut(const GatherOrder& order, const std::vector<FoundDataset>& found) {
    for (const FoundDataset& one : found) {
        if (!isWithin(order.out, one.folder)) continue;
        return fail(ErrorCode::Usage,
                    fmt::format("The folder is inside the source dataset {}; choose another one.",
                                one.folder.string()),
                    fmt::format("--out {}", order.out.string()));
    }
    return {};
}

void warnOfOldIds() {
    log::warn(kSubsystem,
              "semantic is left out: its pixels have the datasets' class ids, but the class map "
              "replaces them");
}

/// Chooses the layout's modalities: those that all datasets have, with a warning of the others, or
/// all if a layout keeps each dataset apart.
void chooseModalities(const GatherOrder& order, Gathered& all) {
    if (order.layout->content == LayoutContent::Copied) return;
    all.modalities = {kPicture};
    for (const char* name : order.layout->required) {
        if (isModality(name)) all.modalities.insert(name);
    }
    if (order.layout->content == LayoutContent::Colour) return;
    if (order.layout->content == LayoutContent::Everything) {
        for (const Source& one : all.sources) {
            all.modalities.insert(one.modalities.begin(), one.modalities.end());
        }
        const auto isSemantic = [](const std::string& folder) {
            return folder == kSemantic || folder.ends_with(std::string("/") + kSemantic);
        };
        if (order.class_map && std::erase_if(all.modalities, isSemantic) > 0) warnOfOldIds();
        return;
    }
    std::vector<const char*> shared = {kDepth, kInstance, kSemantic};
    shared.insert(shared.end(), order.layout->extra.begin(), order.layout->extra.end());
    for (const char* modality : shared) {
        const auto lacking = std::ranges::find_if(
            all.sources, [&](const Source& one) { return !one.modalities.contains(modality); });
        const bool any = std::ranges::any_of(
            all.sources, [&](const Source& one) { return one.modalities.contains(modality); });
        if (!any) continue;
        if (lacking != all.sources.end()) {
            log::warn(kSubsystem, fmt::format("{} is left out: {} has none", modality,
                                              lacking->folder.string()));
        } else if (modality == std::string_view(kSemantic) && order.class_map) {
            warnOfOldIds();
        } else {
            all.modalities.insert(modality);
        }
    }
}

/// Names the modalities that the layout has no place for.
void tellWhatIsLeftOut(const GatherOrder& order, const Gathered& all) {
    std::set<std::string> left_out;
    for (const Source& one : all.sources) left_out.insert(one.others.begin(), one.others.end());
    std::erase_if(left_out, [&](const std::string& name) {
        const auto isHeld = [&](std::string_view folder) {
            return folder == name || folder.starts_with(name + "/");
        };
        return std::ranges::any_of(all.modalities, isHeld) ||
               std::ranges::any_of(order.layout->copied, isHeld);
    });
    if (left_out.empty()) return;
    std::string hint;
    if (left_out.contains("cameras")) {
        for (const LayoutKind* one : layouts()) {
            if (one->content != LayoutContent::Everything) continue;
            hint += fmt::format("{}'--format {}'", hint.empty() ? "; " : " and ", one->name);
        }
        hint += " keep the cameras of a rig";
    }
    log::info(kSubsystem, fmt::format("left out, because the layout {} has no place for them: {}{}",
                                      order.layout->name, fmt::join(left_out, ", "), hint));
}

void warnOfCopies(const std::vector<Source>& sources) {
    std::map<std::string, const Source*> known;  // by the hash of dataset.json
    for (const Source& one : sources) {
        const Source* first = known.emplace(one.card_sha256, &one).first->second;
        if (first == &one) continue;
        log::warn(kSubsystem, fmt::format("{} is a copy of {}, so its frames occur twice",
                                          one.folder.string(), first->folder.string()));
    }
}

void warnOfMissingClasses(const std::vector<Source>& sources, const ClassUnion& classes) {
    std::set<const ClassTable*> told;
    for (const Source& one : sources) {
        const std::vector<std::string> missing = classes.missingIn(one);
        if (missing.empty() || !told.insert(&one.classes()).second) continue;
        log::warn(kSubsystem,
                  fmt::format("{} has no boxes of {}, for which other datasets have a class",
                              one.folder.string(), fmt::join(missing, ", ")));
    }
}

/// Warns if nearly all boxes have one class, which makes training and scores of a detector
/// meaningless.
void warnOfOneClass(const GatherSummary& summary, const ClassUnion& classes) {
    constexpr double kNearlyAll = 0.9;
    if (classes.classes().size() < 2) return;
    for (PartIndex part = 0; part < kParts.size(); ++part) {
        const PartSummary& one = summary.parts[part];
        const auto most = std::ranges::max_element(one.boxes_of_class);
        if (one.annotations == 0 ||
            static_cast<double>(*most) < kNearlyAll * static_cast<double>(one.annotations)) {
            continue;
        }
        const std::size_t index = most - one.boxes_of_class.begin();
        log::warn(kSubsystem,
                  fmt::format("{}: {} of {} boxes have the class '{}'; give the scenes' objects "
                              "classes with --labels or 'dollytrack edit' before exporting",
                              kParts[part], *most, one.annotations, classes.classes()[index].name));
    }
}

/// Keeps descriptions of datasets in memory while they are few, so that their files need not be
/// read twice.
class DescriptionStore {
  public:
    explicit DescriptionStore(const LayoutKind& layout)
        : entries_left_(layout.content == LayoutContent::Everything ? 0 : kMostEntries) {}

    /// Null if there is no room.
    std::shared_ptr<const verify::StoredDataset> keep(verify::StoredDataset dataset) {
        std::size_t entries =
            dataset.sha256s.size() + dataset.frames.size() + dataset.objects.size();
        for (const verify::StoredFrame& frame : dataset.frames) entries += frame.moving.size();
        if (entries > entries_left_) return nullptr;
        entries_left_ -= entries;
        keepConventionsOnly(dataset);
        return std::make_shared<const verify::StoredDataset>(std::move(dataset));
    }

  private:
    static constexpr std::size_t kMostEntries = 150'000;  // of about 250 bytes
    std::size_t entries_left_;
};

Result<Gathered> readSources(const GatherOrder& order, const std::vector<FoundDataset>& found,
                             const JobContext& job) {
    SourceNeeds needs;
    const LayoutKind& layout = *order.layout;
    if (layout.content == LayoutContent::Colour) {
        needs.modalities = {kPicture};
    } else if (layout.content != LayoutContent::Copied) {
        needs.modalities = {kPicture, kDepth, kInstance, kSemantic};
    }
    needs.modalities.insert(layout.extra.begin(), layout.extra.end());
    needs.required.assign(layout.required.begin(), layout.required.end());
    needs.copied.assign(layout.copied.begin(), layout.copied.end());
    for (const std::string& name : needs.required) {
        if (isModality(name)) needs.modalities.insert(name);
    }
    needs.everything = layout.content == LayoutContent::Everything;
    needs.check = layout.check;
    needs.mixed_lenses = order.mixed_lenses;
    needs.prove = order.skip_damaged;
    SourceReader reader(needs);
    ReadAhead<Result<verify::StoredDataset>> datasets(
        found.size(), [&](std::size_t i) { return verify::readStoredDataset(found[i].folder); });
    DescriptionStore descriptions(layout);
    Gathered all;
    for (std::size_t i = 0; i < found.size(); ++i) {
        Result<verify::StoredDataset> dataset = datasets.next();
        Result<Source> source = reader.read(dataset, job);
        job.report(static_cast<double>(i + 1) / static_cast<double>(found.size()));
        if (job.cancelled()) return stopped();
        if (source) {
            source->name = found[i].name;
            source->kept = descriptions.keep(std::move(*dataset));
            all.sources.push_back(std::move(*source));
            continue;
        }
        const bool is_damage = source.error().code == ErrorCode::BadInput && reader.wasDamaged();
        if (!order.skip_damaged || !is_damage) return tl::unexpected(source.error());
        log::warn(kSubsystem, fmt::format("left out: {}", describe(source.error())));
        all.skipped.push_back({found[i].name, found[i].folder.string(), describe(source.error())});
    }
    if (all.sources.empty()) {
        return fail(ErrorCode::BadInput, "All datasets are unfinished or damaged.",
                    order.datasets.front());
    }
    const std::vector<std::size_t> scenes = scenesOf(all.sources);
    for (std::size_t i = 0; i < scenes.size(); ++i) all.sources[i].scene_number = scenes[i];
    chooseModalities(order, all);
    tellWhatIsLeftOut(order, all);
    all.conventions = reader.conventions();
    for (const char* modality : {kDepth, kInstance, kSceneFlow, kTracks}) {
        if (!all.modalities.contains(modality)) all.conventions.erase(modality);
    }
    return all;
}

DatasetIdentity identityOf(const GatherOrder& order, const Gathered& all,
                           const std::vector<PartIndex>& part_of) {
    std::string sources;
    std::string parts;
    for (std::size_t i = 0; i < all.sources.size(); ++i) {
        sources += fmt::format("{} {}\n", all.sources[i].name, all.sources[i].card_sha256);
        parts += kParts[part_of[i]][1];  // r, a, e
    }
    for (const SkippedDataset& one : all.skipped) sources += one.name + "\n";
    const nlohmann::json map = order.class_map.value_or(ClassMap());
    return {{"the datasets", sha256Of(std::string_view(sources))},
            {"the format", order.layout->name},
            {"the images", fmt::format("{}", fmt::join(all.modalities, ","))},
            {"the split",
             fmt::format("{} {} {} {}", order.split.by_room, fmt::join(order.split.shares, "/"),
                         order.split.seed, sha256Of(std::string_view(parts)))},
            {"the class map", map.dump()},
            {"the shards", fmt::format("{} {}", order.shards.bytes, order.shards.frames)},
            {"the title", order.title},
            {"the licence", order.license},
            {"the program's version", order.product_version}};
}

/// Whether the folder contains the requested dataset, complete and undamaged. Errors: Usage,
/// BadInput.
Result<bool> isDone(const OutputFolder& out, const GatherOrder& order,
                    const DatasetIdentity& identity, const JobContext& job) {
    const Result<nlohmann::json> card = readBoundedJson(out.folder(), kGatherCard);
    DatasetIdentity found;
    std::string sums_sha256;
    try {
        if (card) found = card->at("identity").get<DatasetIdentity>();
        if (card) sums_sha256 = card->at("files").at("sha256").get<std::string>();
    } catch (const nlohmann::json::exception&) {
        found.clear();  // written by another version, or damaged
    }
    const std::string differing = render::differences(found, identity);
    if (!differing.empty() && order.overwrite) return false;
    if (!differing.empty()) {
        return fail(ErrorCode::Usage,
                    fmt::format("the folder contains another complete dataset (different: {}); "
                                "choose another folder, or give --overwrite",
                                differing),
                    out.path().string());
    }
    const auto check = [&](std::string_view sha256, const std::string& name) -> Status {
        if (job.cancelled()) return stopped();
        if (sha256Within(out.folder(), name, job) == sha256) return {};
        if (job.cancelled()) return stopped();
        return fail(ErrorCode::BadInput,
                    "the file is missing or damaged; gather again with --overwrite",
                    (out.path() / name).string());
    };
    if (Status sound = check(sums_sha256, kSumsFile); !sound) return tl::unexpected(sound.error());
    if (Status sound = forEachSum(out.folder(), kSumsFile, check); !sound) {
        return tl::unexpected(sound.error());
    }
    return true;
}

Status checkSpace(const GatherOrder& order, const OutputFolder& out, const Gathered& all) {
    const std::optional<std::uint64_t> free = out.folder().freeBytes();
    if (!free || order.resume || order.hard_links) return {};
    std::uint64_t bytes = 0;
    for (const Source& one : all.sources) bytes += one.bytes;
    if (bytes <= *free) return {};
    return fail(ErrorCode::CannotWrite,
                fmt::format("about {} MB are needed and {} MB are free; free some space or choose "
                            "another folder",
                            bytes / 1'000'000 + 1, *free / 1'000'000),
                out.path().string());
}

/// Number of frames processed at once: more if they are small. Bytes that were just read are hashed
/// and written while the processor's cache still has them.
std::size_t stepOf(const Source& source) {
    constexpr std::uint64_t kBytes = 4'000'000;
    constexpr std::uint64_t kMost = 64;
    const std::uint64_t per_frame = source.bytes / std::max<std::size_t>(source.frames, 1) + 1;
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(kBytes / per_frame, 1, kMost));
}

/// Writes the frames of all parts and counts their contents.
class PartWriter {
  public:
    PartWriter(const Gathered& all, const std::vector<PartIndex>& part_of,
               const ClassUnion& classes, GatherSummary& summary, JobContext job)
        : all_(all), part_of_(part_of), classes_(classes), summary_(summary), job_(std::move(job)) {
        for (const Source& one : all.sources) total_ += static_cast<int>(one.frames);
    }

    Status write(Layout& layout) {
        std::vector<std::size_t> order;  // of the datasets, part by part
        for (const PartIndex part : partsOf(part_of_)) {
            for (std::size_t i = 0; i < all_.sources.size(); ++i) {
                if (part_of_[i] == part) order.push_back(i);
            }
        }
        ReadAhead<Result<OpenedSource>> opened(order.size(), [&](std::size_t i) {
            return openSource(all_.sources[order[i]], classes_);
        });
        auto next = order.begin();
        for (const PartIndex part : partsOf(part_of_)) {
            if (Status status = layout.beginPart(part); !status) return status;
            std::set<std::size_t> in_part;
            for (; next != order.end() && part_of_[*next] == part; ++next) {
                in_part.insert(all_.sources[*next].scene_number);
                if (Status status = add(layout, opened.next(), summary_.parts[part]); !status) {
                    return status;
                }
            }
            summary_.parts[part].scenes = in_part.size();
            if (Status status = layout.endPart(); !status) return status;
        }
        return layout.finish(partsOf(part_of_));
    }

  private:
    Status add(Layout& layout, const Result<OpenedSource>& opened, PartSummary& part) {
        if (!opened) return tl::unexpected(opened.error());
        const Source& source = opened->source;
        const std::size_t step = stepOf(source);
        for (std::size_t begin = 0; begin < source.frames; begin += step) {
            const std::size_t end = std::min(begin + step, source.frames);
            Status status = job_.cancelled() ? stopped() : layout.add(*opened, begin, end);
            if (status && job_.cancelled()) return stopped();
            if (!status) return status;
            done_ += static_cast<int>(end - begin);
            job_.reportItems(done_, total_);
        }
        ++part.datasets;
        part.frames += source.frames;
        part.boxes_of_class.resize(classes_.classes().size());
        for (const auto& frame : opened->annotations) {
            part.annotations += frame.size();
            for (const Annotation& one : frame) ++part.boxes_of_class[one.class_index];
        }
        return {};
    }

    const Gathered& all_;
    const std::vector<PartIndex>& part_of_;
    const ClassUnion& classes_;
    GatherSummary& summary_;
    JobContext job_;
    int done_ = 0;
    int total_ = 0;
};

Status writeDataset(const GatherOrder& order, OutputFolder& out,
                    std::vector<FinishedShard> finished, GatherCard& card, const Gathered& all,
                    const std::vector<PartIndex>& part_of, GatherSummary& summary,
                    const JobContext& job) {
    Result<OutputFiles> files = OutputFiles::begin(out.staged(), {order.resume, order.hard_links});
    if (!files) return tl::unexpected(files.error());
    if (Status status = writeLicenses(all.sources, *files); !status) return status;
    const std::unique_ptr<Layout> layout =
        order.layout->make({*files, card.classes, all.modalities, order.shards, std::move(finished),
                            [&](const FinishedShard& shard) { return out.note(shard); }, job});
    PartWriter writer(all, part_of, card.classes, summary, job);
    if (Status status = writer.write(*layout); !status) return status;
    if (Status status = files->write("README.md", readmeText(card)); !status) return status;
    Result<std::string> sums_sha256 = files->finish();
    if (!sums_sha256) return tl::unexpected(sums_sha256.error());
    card.sums_sha256 = std::move(*sums_sha256);
    if (Status status = out.staged().syncAll(); !status) return status;
    if (Status status = out.staged().write(kGatherCard, gatherJson(card)); !status) return status;
    return out.finish();
}

}  // namespace

Result<GatherSummary> gatherDatasets(const GatherOrder& order, const JobContext& job) {
    const Result<std::vector<FoundDataset>> found = findDatasets(order.datasets);
    if (!found) return tl::unexpected(found.error());
    if (Status status = checkOut(order, *found); !status) return tl::unexpected(status.error());
    Result<OutputFolder> out = OutputFolder::claim(order.out, order.overwrite);
    if (!out) return tl::unexpected(out.error());
    if (out->isComplete() && !order.overwrite && !order.resume) {
        return fail(ErrorCode::Usage,
                    "the folder contains a complete gathered dataset; choose another folder, "
                    "--overwrite to replace it, or --resume to check that it is the requested one",
                    out->path().string());
    }
    constexpr double kReading = 0.1;  // share of the time
    Result<Gathered> all = readSources(order, *found, job.stage(0.0, kReading, "datasets"));
    if (!all) return tl::unexpected(all.error());
    const Result<ClassUnion> classes = ClassUnion::of(all->sources, order.class_map);
    if (!classes) return tl::unexpected(classes.error());
    const Result<std::vector<PartIndex>> part_of = splitByScene(all->sources, order.split);
    if (!part_of) return tl::unexpected(part_of.error());
    warnOfCopies(all->sources);
    warnOfMissingClasses(all->sources, *classes);

    GatherSummary summary;
    summary.skipped = all->skipped;
    summary.classes = classes->classes().size();
    GatherCard card{order,   all->sources,     *part_of,        *classes,
                    summary, all->conventions, all->modalities, identityOf(order, *all, *part_of),
                    {}};
    if (out->isComplete() && order.resume) {
        const Result<bool> done = isDone(*out, order, card.identity, job);
        if (!done) return tl::unexpected(done.error());
        summary.was_complete = *done;
        if (*done) return summary;
    }
    if (Status status = checkSpace(order, *out, *all); !status) {
        return tl::unexpected(status.error());
    }
    Result<std::vector<FinishedShard>> finished = out->begin(card.identity, order.resume);
    if (!finished) return tl::unexpected(finished.error());
    const Status written = writeDataset(order, *out, std::move(*finished), card, *all, *part_of,
                                        summary, job.stage(kReading, 1.0, "frames"));
    if (!written) return tl::unexpected(written.error());
    warnOfOneClass(summary, *classes);
    if (order.license.empty()) {
        log::warn(kSubsystem,
                  "README.md says 'license: unknown'; give the licence with --license, and check "
                  "the licences of the scenes' models");
    }
    return summary;
}

}  // namespace dollytrack::gather
