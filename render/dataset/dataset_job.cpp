#include "render/dataset/dataset_job.h"

#include "engine/core/log.h"
#include "engine/plan/frame_series.h"
#include "engine/scene/varied_materials.h"
#include "render/dataset/dataset_files.h"
#include "render/dataset/dataset_identity.h"
#include "render/dataset/dataset_resume.h"
#include "render/dataset/size_estimate.h"
#include "render/frames/frame_ledger.h"
#include "render/frames/frame_pipeline.h"
#include "render/frames/frame_writer.h"
#include "render/rig/rig_clearance.h"
#include "render/rig/rig_files.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <optional>

namespace dollytrack::render {
namespace {

unsigned needsOf(const ModalitySet& modalities, const FormatSet& formats) {
    unsigned needs = 0;
    for (const Modality* modality : modalities) needs |= modality->needs;
    for (const Format* format : formats) needs |= format->needs;
    return needs;
}

/// The plan kept clear of things as they were at one time.
void warnOfTouching(const DatasetContents& contents) {
    const double radius = contents.camera.camera_radius_m;
    const auto first = std::ranges::find_if(
        contents.frames, [&](const DatasetFrame& frame) { return frame.clearance_m < radius; });
    if (first == contents.frames.end()) return;
    const auto count = std::ranges::count_if(
        contents.frames, [&](const DatasetFrame& frame) { return frame.clearance_m < radius; });
    log::warn("export", "things that move come nearer to the camera than its radius in " +
                            std::to_string(count) + " frames, first in frame " +
                            std::to_string(first->source_frame) +
                            "; plan with them elsewhere (--time), or export with --still");
}

/// Labels are those of the clean pictures.
void warnOfBentOutlines(const SensorLens& lens, const FormatSet& formats) {
    std::string names;
    for (const Format* format : formats) {
        if (format->outlines_things)
            names += (names.empty() ? "" : ", ") + std::string(format->name);
    }
    if (names.empty() || lens.largestShift_px() < 0.05) return;
    log::warn(
        "export",
        fmt::format("boxes and masks of {} belong to the clean pictures (rgb): in rgb_sensor, "
                    "whose lens bends them, things lie up to {:.1f} px beside",
                    names, lens.largestShift_px()));
}

/// Paths are traced through things as they are at a frame's time.
void warnOfUnblurred(const DatasetSettings& settings, const DatasetOrigin& origin) {
    const bool lasts = settings.sensor.shutter_s > 0.0 || settings.sensor.readout_s > 0.0;
    if (settings.picture.render_mode != RenderMode::Reference || origin.motions.empty() || !lasts) {
        return;
    }
    log::warn("export",
              "path traced sensor pictures show things that move where they are at the frame's "
              "time, blurred by the camera's motion alone; render_mode=fast blurs both");
}

}  // namespace

struct DatasetJob::Impl {
    DatasetSettings settings;
    std::unique_ptr<const Scene> varied;  // where materials vary; `order` is of it then
    DatasetOrder order;
    std::optional<DatasetFolder> folder;
    std::optional<Counted> already_counted;  // the folder holds the complete dataset

    // In this order, so that OpenGL's things go before the context they live in.
    std::unique_ptr<gl::Context> context;
    std::optional<MovingObjects> moving;
    std::optional<ObjectPaths> object_paths;  // where the sensor's pictures are wanted
    std::optional<SensorLens> sensor_lens;
    std::optional<FrameContext> frame_context;
    std::optional<FramePipeline> pipeline;
    std::optional<FrameLedger> ledger;
    std::optional<FrameWriter> writer;  // its threads report to the ledger

    Impl(DatasetSettings set, std::unique_ptr<const Scene> changed, DatasetOrder wanted)
        : settings(std::move(set)), varied(std::move(changed)), order(std::move(wanted)) {}
    ~Impl() {
        // Another context may be the current one by now, and would lose its own names.
        if (context && !context->makeCurrent()) {
            log::error("export", "the OpenGL context is gone");
        }
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    [[nodiscard]] int frameCount() const { return static_cast<int>(order.contents.frames.size()); }

    /// An earlier dataset in the folder goes here, when nothing is left that could fail early.
    Status beginFolder(const DatasetIdentity& identity, JournalContents earlier);

    /// Ends what is on its way, also after an error: it is in the journal then.
    Status drain() {
        Status status = context->makeCurrent();
        if (status) status = pipeline->countLast(*ledger);
        Status written = writer->finish();
        return status ? written : status;
    }

    Result<DatasetSummary> finish();
};

Status DatasetJob::Impl::beginFolder(const DatasetIdentity& identity, JournalContents earlier) {
    const DatasetContents& contents = order.contents;
    const std::set<std::string> keep = filesOf(earlier.entries);
    const std::uint64_t bytes =
        estimateBytes(contents, order.card.formats, pipeline->missingCount());
    if (Status status = folder->checkSpace(bytes, keep); !status) return status;
    const DatasetNames names =
        namesOf(contents.modalities, order.card.formats, frameCount(), rigFolders(contents.rig));
    if (Status status = folder->begin(names, keep); !status) return status;
    order.contents.folder = folder->unfinished().path();
    Result<DatasetJournal> journal =
        earlier.identity
            ? DatasetJournal::resume(folder->folder(), earlier)
            : DatasetJournal::begin(folder->folder(), identity, gl::rendererName(), names);
    if (!journal) return tl::unexpected(journal.error());
    ledger.emplace(std::move(*journal), frameCount(), std::move(earlier.entries));
    writer.emplace(
        FrameWriter::Settings{folder->unfinished(), contents.modalities, order.card.formats,
                              needsOf(contents.modalities, order.card.formats)},
        *frame_context, [this](WrittenFrame written) {
            return ledger->addWritten(written.index, std::move(written.sha256s),
                                      std::move(written.masks), std::move(written.instances));
        });
    return {};
}

Result<DatasetSummary> DatasetJob::Impl::finish() {
    DatasetSummary summary;
    summary.frames = frameCount();
    if (order.contents.pictureModality().is_picture) {
        summary.contact_sheet = settings.folder / "contact_sheet.jpg";
    }
    if (already_counted) {
        summary.counted = already_counted->captures;
        summary.pictures = already_counted->pictures;
        if (Status status = folder->release(); !status) return tl::unexpected(status.error());
        return summary;
    }
    if (pipeline->doneCount() != frameCount()) {
        return fail(ErrorCode::Failed, "finish() came before the last frame");
    }
    if (Status status = drain(); !status) return tl::unexpected(status.error());
    if (!folder->isThere()) {  // what is written now would make it again, without pictures
        return fail(ErrorCode::CannotWrite, "the dataset cannot be finished",
                    settings.folder.string());
    }
    DatasetContents& contents = order.contents;
    DatasetCard& card = order.card;
    summary.captures = bestCaptures(contents.scene, pipeline->views(), settings.rules);
    summary.counted = summarize(contents.scene, summary.captures);
    card.counted = summary.counted;
    card.captures = summary.captures;
    for (int i = 0; i < frameCount(); ++i) {
        JournalEntry entry = ledger->take(i);
        DatasetFrame& row = contents.frames[static_cast<std::size_t>(i)];
        row.well_shown = std::move(entry.well_shown);
        row.quality = entry.quality;
        if (row.quality) card.pictures.add(i, *row.quality);
        row.masks = std::move(entry.masks);
        row.instances = std::move(entry.instances);
        card.sha256s.insert(entry.sha256s.begin(), entry.sha256s.end());
    }
    summary.pictures = card.pictures;
    std::array<char, 160> title{};
    std::snprintf(title.data(), title.size(), ": %d frames, %d of %d objects captured, %d well",
                  summary.frames, summary.counted.captured, summary.counted.objects,
                  summary.counted.well_captured);
    Status status =
        writeDatasetFiles(folder->unfinished(), contents, card, contents.scene.name + title.data());
    if (status) status = folder->finish();
    if (!status) return tl::unexpected(status.error());
    if (const std::string unusable = unusableText(summary.pictures); !unusable.empty()) {
        log::warn("export", unusable + "; they capture nothing");
    }
    return summary;
}

DatasetJob::DatasetJob(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DatasetJob::~DatasetJob() = default;
DatasetJob::DatasetJob(DatasetJob&&) noexcept = default;
DatasetJob& DatasetJob::operator=(DatasetJob&&) noexcept = default;

Result<DatasetJob> DatasetJob::begin(std::unique_ptr<gl::Context> context, const Scene& given,
                                     const RayCaster& rays, const Trajectory& trajectory,
                                     const CameraParams& camera, DatasetSettings settings,
                                     DatasetOrigin origin, const JobContext& job) {
    std::unique_ptr<Scene> varied;
    if (settings.light.light_variation > 0.0) {
        varied = std::make_unique<Scene>(given);
        varyMaterials(*varied, settings.light);
    }
    const Scene& scene = varied ? *varied : given;
    Result<DatasetOrder> order = describeOrder(scene, camera, trajectory, settings, origin);
    if (!order) return tl::unexpected(order.error());
    auto impl = std::make_unique<Impl>(std::move(settings), std::move(varied), std::move(*order));
    impl->context = std::move(context);
    Result<DatasetFolder> folder =
        DatasetFolder::claim(impl->settings.folder, impl->settings.overwrite, impl->settings.root);
    if (!folder) return tl::unexpected(folder.error());
    impl->folder.emplace(std::move(*folder));
    if (!impl->settings.overwrite && !impl->settings.resume) {
        if (Status status = impl->folder->checkNotComplete(); !status) {
            return tl::unexpected(status.error());
        }
    }

    const DatasetIdentity identity = identityOf(impl->order, impl->settings, origin);
    Earlier earlier;
    if (impl->settings.resume) {
        Result<Earlier> found =
            findEarlier(*impl->folder, impl->order, identity, job.stage(0.0, 0.3, "checking"));
        if (!found) return tl::unexpected(found.error());
        earlier = std::move(*found);
    }
    if (earlier.complete) {
        impl->already_counted = earlier.complete;
        return DatasetJob(std::move(impl));
    }
    DatasetContents& contents = impl->order.contents;
    const MovingObjects& moving = impl->moving.emplace(contents.scene, rays, contents.motions);
    impl->frame_context.emplace(FrameContext{contents, moving});
    if (contains(contents.modalities, kRgbSensor)) {
        impl->object_paths.emplace(scene, trajectory, origin.motions);
        impl->frame_context->sensor_lens =
            &impl->sensor_lens.emplace(contents.camera, contents.sensor);
        warnOfBentOutlines(*impl->sensor_lens, impl->order.card.formats);
        warnOfUnblurred(impl->settings, origin);
    }
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        DatasetFrame& frame = contents.frames[i];
        frame.clearance_m =
            clearanceAt(*moving.raysAt(static_cast<int>(i)), frame.camera.pose.position);
    }
    if (moving.any()) warnOfTouching(contents);
    for (const std::string& warning : rigWarnings(*impl->frame_context))
        log::warn("export", warning);
    std::map<int, std::vector<ObjectView>> restored;
    for (const auto& [index, entry] : earlier.journal.entries) restored[index] = entry.views;
    FramePipeline& pipeline =
        impl->pipeline.emplace(*impl->frame_context, impl->settings.rules,
                               needsOf(contents.modalities, impl->order.card.formats),
                               impl->settings.picture, std::move(restored));
    Status status =
        pipeline.prepare(rays, origin.rooms, impl->object_paths ? &*impl->object_paths : nullptr,
                         job.stage(0.3, 1.0, "light"));
    if (status) status = impl->beginFolder(identity, std::move(earlier.journal));
    if (!status) return tl::unexpected(status.error());
    return DatasetJob(std::move(impl));
}

int DatasetJob::frameCount() const {
    return impl_->frameCount();
}

int DatasetJob::framesDone() const {
    return impl_->pipeline ? impl_->pipeline->doneCount() : frameCount();
}

Result<bool> DatasetJob::step() {
    if (framesDone() == frameCount()) return false;
    if (!folderIsThere()) {  // what is written now would be lost, or go where the folder went
        return fail(ErrorCode::CannotWrite, "the dataset cannot be written on",
                    impl_->settings.folder.string());
    }
    Status status = impl_->context->makeCurrent();
    if (status) status = impl_->pipeline->drawNext(*impl_->writer, *impl_->ledger);
    if (!status) return tl::unexpected(status.error());
    return true;
}

Result<DatasetSummary> DatasetJob::finish() {
    return impl_->finish();
}

int DatasetJob::keep() {
    if (!impl_->ledger) return frameCount();
    // What fails here failed before, or costs a frame that is rendered again.
    const Status drained = impl_->drain();
    const Status synced = impl_->ledger->sync();
    if (!drained) log::debug("export", describe(drained.error()));
    if (!synced) log::debug("export", describe(synced.error()));
    return folderIsThere() ? impl_->ledger->finishedCount(impl_->folder->unfinished()) : 0;
}

bool DatasetJob::folderIsThere() const {
    return impl_->folder->isThere();
}

Status checkChoices(const DatasetSettings& settings) {
    const auto modalities = chooseModalities(settings.modalities, !settings.rig.empty());
    if (!modalities) return tl::unexpected(modalities.error());
    if (Status status = validate(settings.rig); !status) return status;
    const auto formats = chooseFormats(settings.formats);
    if (!formats) return tl::unexpected(formats.error());
    return checkNeeds(*formats, *modalities);
}

Status checkSettings(const DatasetSettings& settings) {
    if (Status status = checkChoices(settings); !status) return status;
    const Result<DatasetFolder> folder =
        DatasetFolder::claim(settings.folder, settings.overwrite, settings.root);
    if (!folder) return tl::unexpected(folder.error());
    return settings.overwrite || settings.resume ? Status() : folder->checkNotComplete();
}

Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context, const Scene& scene,
                                     const RayCaster& rays, const Trajectory& trajectory,
                                     const CameraParams& camera, DatasetSettings settings,
                                     DatasetOrigin origin, const JobContext& job) {
    Result<DatasetJob> dataset =
        DatasetJob::begin(std::move(context), scene, rays, trajectory, camera, std::move(settings),
                          std::move(origin), job.stage(0.0, 0.05, ""));
    if (!dataset) return tl::unexpected(dataset.error());
    const JobContext frames = job.stage(0.05, 0.97, "frames");
    const auto stop = [&](Error error) -> tl::unexpected<Error> {
        const int kept = dataset->keep();
        if (kept > 0) {
            error.message += "; " + std::to_string(kept) + " of " +
                             std::to_string(dataset->frameCount()) +
                             " frames are finished, --resume continues after them";
        } else if (!dataset->folderIsThere()) {
            error.message += "; the folder was removed meanwhile, and what was finished with it";
        }
        return tl::unexpected<Error>(std::move(error));
    };
    while (true) {
        frames.reportItems(dataset->framesDone(), dataset->frameCount());
        if (job.cancelled()) return stop({ErrorCode::Cancelled, "the export was cancelled", {}});
        const Result<bool> more = dataset->step();
        if (!more) return stop(more.error());
        if (*more) continue;
        job.stage(0.97, 1.0, "finishing").report(0.0);
        Result<DatasetSummary> summary = dataset->finish();
        if (!summary) return stop(std::move(summary.error()));
        return summary;
    }
}

}  // namespace dollytrack::render
