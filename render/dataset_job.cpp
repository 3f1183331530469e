#include "render/dataset_job.h"

#include "engine/core/log.h"
#include "render/capture_counter.h"
#include "render/dataset_files.h"
#include "render/dataset_identity.h"
#include "render/dataset_resume.h"
#include "render/frame_ledger.h"
#include "render/frame_writer.h"
#include "render/scene_hash.h"
#include "render/scene_renderer.h"

#include <array>
#include <optional>

namespace dollytrack::render {
namespace {

Result<nlohmann::json> parseJson(const std::string& text, const char* what) {
    nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
    if (value.is_discarded()) {
        return fail(ErrorCode::Failed, std::string(what) + " handed to the export are no JSON");
    }
    return value;
}

std::vector<DatasetFrame> plannedFrames(const Trajectory& trajectory, const FrameRange& range) {
    std::vector<DatasetFrame> frames;
    for (const int source : framesOf(range, static_cast<int>(trajectory.frames.size()))) {
        DatasetFrame frame;
        frame.camera = trajectory.frames[static_cast<std::size_t>(source)];
        frame.source_frame = source;
        frame.room = "room " + std::to_string(std::max(frame.camera.component, 0) + 1);
        frames.push_back(std::move(frame));
    }
    return frames;
}

bool needMasks(const FormatSet& formats) {
    return std::any_of(formats.begin(), formats.end(),
                       [](const Format* format) { return format->needs_masks; });
}

tl::unexpected<Error> cancelled() {
    return fail(ErrorCode::Cancelled, "the export was cancelled");
}

}  // namespace

struct DatasetJob::Impl {
    DatasetSettings settings;
    DatasetOrigin origin;
    DatasetContents contents;
    DatasetCard card;
    std::optional<DatasetFolder> folder;
    std::optional<CaptureMetrics> already_counted;  // the folder holds the complete dataset

    // In this order, so that OpenGL's things go before the context they live in.
    std::unique_ptr<gl::Context> context;
    std::optional<SceneRenderer> renderer;
    // Two, so that one frame's triangles are set up while the other's pixels are still computed.
    std::array<std::optional<RenderTarget>, 2> targets;

    CaptureCounter counter;
    std::map<int, std::vector<ObjectView>> restored;  // views of the frames of an earlier export
    std::vector<int> to_draw;                         // the other frames
    std::size_t started = 0;                          // of to_draw
    std::size_t drawn = 0;
    int silhouettes_of = -1;  // the frame whose silhouettes are being drawn
    int fed = 0;              // frames below this one are counted, if they were restored
    std::optional<FrameLedger> ledger;
    std::optional<FrameWriter> writer;  // its threads report to the ledger

    Impl(const Scene& scene, const CameraParams& camera, DatasetSettings set, DatasetOrigin from)
        : settings(std::move(set)),
          origin(std::move(from)),
          contents{scene, camera, {}, {}},
          counter(scene, settings.rules) {}
    ~Impl() {
        // Another context may be the current one by now, and would lose its own names.
        if (context && !context->makeCurrent()) {
            log::error("export", "the OpenGL context is gone");
        }
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    [[nodiscard]] int frameCount() const { return static_cast<int>(contents.frames.size()); }
    [[nodiscard]] const DatasetFrame& frame(int index) const {
        return contents.frames[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] View viewOf(int index) const {
        return makeView(contents.camera, frame(index).camera.pose);
    }

    Status describeWanted(const Trajectory& trajectory);
    Result<JournalContents> findEarlier(const DatasetIdentity& identity, const JobContext& job);
    Status prepareDrawing(const RayCaster& rays, const JobContext& job);
    Status beginFolder(const DatasetIdentity& identity, JournalContents earlier);

    Status startNext() {
        if (started == to_draw.size()) return {};
        RenderTarget& target = *targets[started % 2];
        return renderer->draw(viewOf(to_draw[started++]), target);
    }

    Status takeSilhouettes() {
        if (silhouettes_of < 0) return {};
        counter.addSilhouettes(renderer->finishSilhouettes());
        const std::span<const ObjectView> views = counter.lastViews();
        const int index = std::exchange(silhouettes_of, -1);
        return ledger->addCounted(index, {views.begin(), views.end()}, counter.wellShown());
    }

    /// What silhouettes a frame needs depends on the frames before it, so these must be counted in
    /// their order, wherever they come from.
    void countRestored(int before) {
        for (; fed < before; ++fed) {
            const auto views = restored.find(fed);
            if (views != restored.end()) counter.addCounted(views->second);
        }
    }

    Status drawNext() {
        while (started < std::min(drawn + 2, to_draw.size())) {
            if (Status status = startNext(); !status) return status;
        }
        const RenderTarget& target = *targets[drawn % 2];
        FrameRecord record;
        record.index = to_draw[drawn];
        record.time_s = frame(record.index).camera.time_s;
        record.pose = frame(record.index).camera.pose;
        record.width = contents.camera.width_px;
        record.height = contents.camera.height_px;
        target.readIds(record.instance);
        if (Status status = takeSilhouettes(); !status) return status;
        countRestored(record.index);
        const std::vector<int> wanted = counter.addFrame(record);
        if (Status status = renderer->startSilhouettes(viewOf(record.index), wanted); !status) {
            return status;
        }
        silhouettes_of = record.index;
        if (contains(contents.modalities, "rgb")) target.readRgb(record.rgb);
        if (contains(contents.modalities, "depth")) target.readDepth(record.depth_m);
        ++drawn;
        return writer->write(std::move(record));
    }

    /// Ends what is on its way, also after an error: it is in the journal then.
    Status drain() {
        Status status = context->makeCurrent();
        if (status) status = takeSilhouettes();
        Status written = writer->finish();
        return status ? written : status;
    }

    Result<DatasetSummary> finish();
};

Status DatasetJob::Impl::describeWanted(const Trajectory& trajectory) {
    contents.frames = plannedFrames(trajectory, settings.range);
    if (contents.frames.empty()) {
        return fail(ErrorCode::Usage,
                    "the range holds none of the trajectory's " +
                        std::to_string(trajectory.frames.size()) + " frames",
                    "--range");
    }
    Result<ModalitySet> modalities = chooseModalities(settings.modalities);
    if (!modalities) return tl::unexpected(modalities.error());
    contents.modalities = std::move(*modalities);
    Result<FormatSet> formats = chooseFormats(settings.formats);
    if (!formats) return tl::unexpected(formats.error());
    card.formats = std::move(*formats);
    Result<nlohmann::json> parameters = parseJson(origin.parameters_json, "the parameters");
    if (!parameters) return tl::unexpected(parameters.error());
    card.parameters = std::move(*parameters);
    Result<nlohmann::json> metrics = parseJson(origin.planned_metrics_json, "the metrics");
    if (!metrics) return tl::unexpected(metrics.error());
    card.planned_metrics = std::move(*metrics);
    card.product_version = origin.product_version;
    card.seed = origin.seed;
    card.geometry_sha256 = geometryHash(contents.scene);
    card.appearance_sha256 = appearanceHash(contents.scene);
    return {};
}

/// The frames that need not be rendered again, by the journal they are in.
Result<JournalContents> DatasetJob::Impl::findEarlier(const DatasetIdentity& identity,
                                                      const JobContext& job) {
    if (!settings.resume) return JournalContents{};
    JournalContents earlier = readJournal(folder->journal());
    if (!earlier.identity && folder->isComplete()) {
        const Result<CaptureMetrics> counted = checkComplete(*folder, contents, card, job);
        if (!counted) return tl::unexpected(counted.error());
        already_counted = *counted;
        return JournalContents{};
    }
    if (!earlier.identity) {
        log::info("export", "there is nothing to continue in the folder: beginning anew");
        return JournalContents{};
    }
    if (*earlier.identity != identity) {
        return fail(ErrorCode::Usage,
                    "the unfinished dataset in the folder is another one (it differs in " +
                        differences(*earlier.identity, identity) +
                        "); continue it as it was begun, or leave out --resume to begin anew",
                    folder->path().string());
    }
    const std::size_t listed = earlier.entries.size();
    earlier.entries = wholeFrames(*folder, std::move(earlier.entries), contents.modalities, job);
    if (job.cancelled()) return cancelled();
    const std::size_t found = earlier.entries.size();
    log::info("export", "continuing: " + std::to_string(found) + " of " +
                            std::to_string(frameCount()) + " frames are finished");
    if (found < listed) {
        log::warn("export", std::to_string(listed - found) +
                                " finished frames are missing or damaged: rendering them again");
    }
    return earlier;
}

Status DatasetJob::Impl::prepareDrawing(const RayCaster& rays, const JobContext& job) {
    const LightVolume light = bakeLightVolume(
        contents.scene, rays, makeLightRig(contents.scene, rays, origin.rooms), {}, job);
    if (job.cancelled()) return cancelled();
    Result<SceneRenderer> created = SceneRenderer::create(contents.scene, light);
    if (!created) return tl::unexpected(created.error());
    renderer.emplace(std::move(*created));
    for (auto& target : targets) {
        Result<RenderTarget> image =
            RenderTarget::create(contents.camera.width_px, contents.camera.height_px);
        if (!image) return tl::unexpected(image.error());
        target.emplace(std::move(*image));
    }
    return {};
}

/// An earlier dataset in the folder goes here, when nothing is left that could fail early.
Status DatasetJob::Impl::beginFolder(const DatasetIdentity& identity, JournalContents earlier) {
    const std::set<std::string> keep = filesOf(earlier.entries);
    const std::uint64_t bytes = estimateBytes(contents.modalities, static_cast<int>(to_draw.size()),
                                              contents.camera.width_px, contents.camera.height_px);
    if (Status status = folder->checkSpace(bytes, keep); !status) return status;
    if (Status status = folder->begin(contents.modalities, keep); !status) return status;
    Result<DatasetJournal> journal = earlier.identity
                                         ? DatasetJournal::resume(folder->journal(), earlier)
                                         : DatasetJournal::begin(folder->journal(), identity);
    if (!journal) return tl::unexpected(journal.error());
    ledger.emplace(std::move(*journal), frameCount(), std::move(earlier.entries));
    writer.emplace(
        FrameWriter::Settings{folder->path(), contents.modalities, needMasks(card.formats)},
        contents.scene, [this](WrittenFrame written) {
            return ledger->addWritten(written.index, std::move(written.sha256s),
                                      std::move(written.masks));
        });
    return {};
}

Result<DatasetSummary> DatasetJob::Impl::finish() {
    DatasetSummary summary;
    summary.frames = frameCount();
    summary.contact_sheet = settings.folder / "contact_sheet.jpg";
    if (already_counted) {
        summary.counted = *already_counted;
        return summary;
    }
    if (drawn != to_draw.size()) {
        return fail(ErrorCode::Failed, "finish() came before the last frame");
    }
    if (Status status = drain(); !status) return tl::unexpected(status.error());
    countRestored(frameCount());
    summary.captures = bestCaptures(contents.scene, counter.views(), settings.rules);
    summary.counted = summarize(contents.scene, summary.captures);
    card.counted = summary.counted;
    card.captures = summary.captures;
    for (int i = 0; i < frameCount(); ++i) {
        const JournalEntry& entry = ledger->entry(i);
        DatasetFrame& row = contents.frames[static_cast<std::size_t>(i)];
        row.well_shown = entry.well_shown;
        row.masks = entry.masks;
        card.sha256s.insert(entry.sha256s.begin(), entry.sha256s.end());
    }
    std::array<char, 160> title{};
    std::snprintf(title.data(), title.size(), ": %d frames, %d of %d objects captured, %d well",
                  summary.frames, summary.counted.captured, summary.counted.objects,
                  summary.counted.well_captured);
    Status status =
        writeDatasetFiles(settings.folder, contents, card, contents.scene.name + title.data());
    if (status) status = folder->release();
    if (!status) return tl::unexpected(status.error());
    return summary;
}

DatasetJob::DatasetJob(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DatasetJob::~DatasetJob() = default;
DatasetJob::DatasetJob(DatasetJob&&) noexcept = default;
DatasetJob& DatasetJob::operator=(DatasetJob&&) noexcept = default;

Result<DatasetJob> DatasetJob::begin(std::unique_ptr<gl::Context> context, const Scene& scene,
                                     const RayCaster& rays, const Trajectory& trajectory,
                                     const CameraParams& camera, DatasetSettings settings,
                                     DatasetOrigin origin, const JobContext& job) {
    auto impl = std::make_unique<Impl>(scene, camera, std::move(settings), std::move(origin));
    impl->context = std::move(context);
    if (Status status = impl->describeWanted(trajectory); !status) {
        return tl::unexpected(status.error());
    }
    Result<DatasetFolder> folder =
        DatasetFolder::claim(impl->settings.folder, impl->settings.overwrite);
    if (!folder) return tl::unexpected(folder.error());
    impl->folder.emplace(std::move(*folder));

    const DatasetIdentity identity =
        identityOf(impl->contents, impl->card, impl->settings, impl->origin);
    Result<JournalContents> earlier = impl->findEarlier(identity, job.stage(0.0, 0.3, "checking"));
    if (!earlier) return tl::unexpected(earlier.error());
    if (impl->already_counted) return DatasetJob(std::move(impl));
    for (int i = 0; i < impl->frameCount(); ++i) {
        const auto entry = earlier->entries.find(i);
        if (entry == earlier->entries.end()) {
            impl->to_draw.push_back(i);
        } else {
            impl->restored[i] = entry->second.views;
        }
    }
    if (!impl->to_draw.empty()) {
        if (Status status = impl->prepareDrawing(rays, job.stage(0.3, 1.0, "light")); !status) {
            return tl::unexpected(status.error());
        }
    }
    if (Status status = impl->beginFolder(identity, std::move(*earlier)); !status) {
        return tl::unexpected(status.error());
    }
    return DatasetJob(std::move(impl));
}

int DatasetJob::frameCount() const {
    return impl_->frameCount();
}

int DatasetJob::framesDone() const {
    return frameCount() - static_cast<int>(impl_->to_draw.size() - impl_->drawn);
}

Result<bool> DatasetJob::step() {
    if (framesDone() == frameCount()) return false;
    if (Status status = impl_->context->makeCurrent(); !status) {
        return tl::unexpected(status.error());
    }
    if (Status status = impl_->drawNext(); !status) return tl::unexpected(status.error());
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
    return impl_->ledger->finishedCount();
}

Status checkSettings(const DatasetSettings& settings) {
    if (const auto modalities = chooseModalities(settings.modalities); !modalities) {
        return tl::unexpected(modalities.error());
    }
    if (const auto formats = chooseFormats(settings.formats); !formats) {
        return tl::unexpected(formats.error());
    }
    const Result<DatasetFolder> folder = DatasetFolder::claim(settings.folder, settings.overwrite);
    if (!folder) return tl::unexpected(folder.error());
    return {};
}

Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context, const Scene& scene,
                                     const RayCaster& rays, const Trajectory& trajectory,
                                     const CameraParams& camera, DatasetSettings settings,
                                     DatasetOrigin origin, const JobContext& job) {
    Result<DatasetJob> dataset =
        DatasetJob::begin(std::move(context), scene, rays, trajectory, camera, std::move(settings),
                          std::move(origin), job.stage(0.0, 0.05, ""));
    if (!dataset) return tl::unexpected(dataset.error());
    const JobContext frames = job.stage(0.05, 1.0, "frames");
    const auto stop = [&](Error error) -> tl::unexpected<Error> {
        const int kept = dataset->keep();
        if (kept > 0) {
            error.message += "; " + std::to_string(kept) + " of " +
                             std::to_string(dataset->frameCount()) +
                             " frames are finished, --resume continues after them";
        }
        return tl::unexpected<Error>(std::move(error));
    };
    while (true) {
        frames.reportItems(dataset->framesDone(), dataset->frameCount());
        if (job.cancelled()) return stop(cancelled().value());
        const Result<bool> more = dataset->step();
        if (!more) return stop(more.error());
        if (*more) continue;
        Result<DatasetSummary> summary = dataset->finish();
        if (!summary) return stop(std::move(summary.error()));
        return summary;
    }
}

}  // namespace dollytrack::render
