#include "render/dataset/dataset_job.h"

#include "engine/core/log.h"
#include "render/dataset/dataset_files.h"
#include "render/dataset/dataset_identity.h"
#include "render/dataset/dataset_resume.h"
#include "render/dataset/frame_drawing.h"
#include "render/dataset/size_estimate.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"
#include "render/pipeline/frame_ledger.h"
#include "render/pipeline/frame_writer.h"
#include "render/rig/rig_files.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

namespace dollytrack::render {
struct DatasetJob::Impl : FrameDrawing {
    using FrameDrawing::FrameDrawing;
    std::optional<DatasetFolder> folder;
    std::optional<RecordedResults> recorded_results;  // the folder contains the complete dataset
    std::optional<FrameLedger> ledger;
    std::optional<FrameWriter> writer;  // its threads report to the ledger

    [[nodiscard]] int frameCount() const { return static_cast<int>(order.contents.frames.size()); }

    /// Prepares the folder. Comes last, because it replaces an earlier dataset's unfinished files.
    Status beginFolder(const DatasetIdentity& identity, JournalContents earlier);

    /// Completes the frames in progress, also after an error, so that the journal has them.
    Status drain() {
        Status status = context->makeCurrent();
        if (status) status = pipeline->countLast(&*ledger);
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
    DatasetNames names =
        namesOf(contents.modalities, order.card.formats, frameCount(), rigFolders(contents.rig));
    if (!order.card.licenses.empty()) names.files.insert(kLicensesFile);
    if (Status status = folder->begin(names, keep); !status) return status;
    order.contents.folder = folder->unfinished().path();
    Result<DatasetJournal> journal =
        earlier.identity
            ? DatasetJournal::resume(folder->folder(), earlier)
            : DatasetJournal::begin(folder->folder(), identity, gl::rendererName(), names);
    if (!journal) return tl::unexpected(journal.error());
    if (Status status = folder->makeFolders(names); !status) return status;
    ledger.emplace(std::move(*journal), frameCount(), std::move(earlier.entries));
    writer.emplace(FrameWriter::Settings{folder->unfinished(), contents.modalities,
                                         order.card.formats, needs()},
                   *frame_context, [this](WrittenFrame written) {
                       return ledger->addWritten(written.index, std::move(written.sha256s),
                                                 std::move(written.masks),
                                                 std::move(written.instances));
                   });
    return {};
}

Result<DatasetSummary> DatasetJob::Impl::finish() {
    DatasetSummary summary;
    summary.frames = frameCount();
    if (order.contents.pictureModality().is_picture) {
        summary.contact_sheet = settings.folder / "contact_sheet.jpg";
    }
    if (recorded_results) {
        summary.counted = recorded_results->captures;
        summary.pictures = recorded_results->pictures;
        if (Status status = folder->release(); !status) return tl::unexpected(status.error());
        return summary;
    }
    if (pipeline->doneCount() != frameCount()) {
        return fail(ErrorCode::Failed, "finish() came before the last frame");
    }
    if (Status status = drain(); !status) return tl::unexpected(status.error());
    if (!folder->isThere()) {  // writing now would create it anew without the images
        return fail(ErrorCode::CannotWrite, "the dataset cannot be finished without its folder",
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
        DatasetFrame& row = contents.frames[i];
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
        log::warn("export", unusable + "; they do not count as captures");
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
    std::unique_ptr<const Scene> varied = FrameDrawing::variedScene(given, settings.light);
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
    EarlierExport earlier;
    if (impl->settings.resume) {
        Result<EarlierExport> found = findEarlierExport(*impl->folder, impl->order, identity,
                                                        job.stage(0.0, 0.3, "checking"));
        if (!found) return tl::unexpected(found.error());
        earlier = std::move(*found);
    }
    if (earlier.complete) {
        impl->recorded_results = earlier.complete;
        return DatasetJob(std::move(impl));
    }
    std::map<int, std::vector<ObjectView>> restored;
    for (const auto& [index, entry] : earlier.journal.entries) restored[index] = entry.views;
    Status status = impl->prepare(rays, trajectory, origin, std::move(restored), job);
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
    if (!folderIsThere()) {  // writing now would go to a deleted or moved folder
        return fail(ErrorCode::CannotWrite, "the export cannot continue without its folder",
                    impl_->settings.folder.string());
    }
    Status status = impl_->context->makeCurrent();
    if (status) {
        status = impl_->pipeline->drawNext(
            [this](FrameRecord frame) { return impl_->writer->write(std::move(frame)); },
            &*impl_->ledger);
    }
    if (!status) return tl::unexpected(status.error());
    return true;
}

Result<DatasetSummary> DatasetJob::finish() {
    return impl_->finish();
}

int DatasetJob::keep() {
    if (!impl_->ledger) return frameCount();
    // A failure here only means that a frame is rendered again.
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
    // The render mode may still come from the scene's project.
    const Available hoped{!settings.rig.empty(), true};
    const auto modalities = chooseModalities(settings.modalities, hoped);
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

namespace {

/// What the chosen images and formats need, as bits of FrameNeeds; unknown names need nothing.
unsigned needsOf(const DatasetSettings& settings) {
    unsigned needs = 0;
    if (const auto modalities =
            chooseModalities(settings.modalities, {!settings.rig.empty(), true})) {
        for (const Modality* one : *modalities) needs |= one->needs;
    }
    if (const auto formats = chooseFormats(settings.formats)) {
        for (const Format* one : *formats) needs |= one->needs;
    }
    return needs;
}

/// The share of an export's progress that its preparation takes; the time left is estimated by it.
/// Light takes about as much time as drawing 60 frames, everything else as drawing 5.
double preparationShare(const DatasetSettings& settings, std::size_t frames) {
    const double prepared = (needsOf(settings) & kNeedsLight) != 0 ? 60.0 : 5.0;
    return std::clamp(prepared / (prepared + static_cast<double>(frames)), 0.05, 0.8);
}

}  // namespace

Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context, const Scene& scene,
                                     const RayCaster& rays, const Trajectory& trajectory,
                                     const CameraParams& camera, DatasetSettings settings,
                                     DatasetOrigin origin, const JobContext& job) {
    const std::size_t count =
        framesOf(settings.range, static_cast<int>(trajectory.frames.size())).size();
    const double prepared = preparationShare(settings, count);
    Result<DatasetJob> dataset =
        DatasetJob::begin(std::move(context), scene, rays, trajectory, camera, std::move(settings),
                          std::move(origin), job.stage(0.0, prepared, ""));
    if (!dataset) return tl::unexpected(dataset.error());
    const JobContext frames = job.stage(prepared, 0.97, "frames");
    const auto stop = [&](Error error) -> tl::unexpected<Error> {
        const int kept = dataset->keep();
        if (kept > 0) {
            error.message += "; " + std::to_string(kept) + " of " +
                             std::to_string(dataset->frameCount()) +
                             " frames are finished; --resume continues after them";
        } else if (!dataset->folderIsThere()) {
            error.message += "; the folder and its finished frames were removed meanwhile";
        }
        return tl::unexpected(std::move(error));
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
