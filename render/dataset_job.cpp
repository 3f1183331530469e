#include "render/dataset_job.h"

#include "engine/io/durable_file.h"
#include "engine/io/sha256.h"
#include "render/capture_counter.h"
#include "render/contact_sheet.h"
#include "render/dataset_folder.h"
#include "render/formats/camera_json.h"
#include "render/formats/coco.h"
#include "render/formats/dataset_card.h"
#include "render/frame_writer.h"
#include "render/scene_renderer.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace dollytrack::render {
namespace {

std::vector<int> framesOf(const FrameRange& range, int available) {
    std::vector<int> frames;
    const int end = std::min(range.end.value_or(available), available);
    for (std::int64_t i = range.begin; i < end; i += range.step) {
        frames.push_back(static_cast<int>(i));
    }
    return frames;
}

std::vector<bool> areKeys(const Trajectory& trajectory, const std::vector<int>& frames) {
    std::vector<bool> keys;
    for (const int frame : frames) {
        keys.push_back(trajectory.frames[static_cast<std::size_t>(frame)].position_point >= 0);
    }
    return keys;
}

Result<nlohmann::json> parseJson(const std::string& text, const char* what) {
    nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
    if (value.is_discarded()) {
        return fail(ErrorCode::Failed, std::string(what) + " handed to the export are no JSON");
    }
    return value;
}

}  // namespace

Result<FrameRange> parseFrameRange(const std::string& text) {
    const auto refuse = [&] {
        return fail(
            ErrorCode::Usage,
            "\"" + text + "\" is no range; write first:end:step, for example 0:100:2 or ::5",
            "--range");
    };
    std::array<std::optional<int>, 3> parts;
    std::size_t start = 0;
    std::size_t count = 0;
    while (start <= text.size()) {
        if (count == parts.size()) return refuse();
        const std::size_t colon = std::min(text.find(':', start), text.size());
        if (colon > start) {
            int value = 0;
            const char* last = text.data() + colon;
            const auto [end, error] = std::from_chars(text.data() + start, last, value);
            if (error != std::errc() || end != last || value < 0) return refuse();
            parts[count] = value;
        }
        ++count;
        start = colon + 1;
    }
    // A single number would be read as "from" by some and as "only" by others.
    if (count < 2) return refuse();
    FrameRange range;
    range.begin = parts[0].value_or(0);
    range.end = parts[1];
    range.step = parts[2].value_or(1);
    if (range.step < 1 || (range.end && *range.end <= range.begin)) return refuse();
    return range;
}

struct DatasetJob::Impl {
    const Scene& scene;
    const Trajectory& trajectory;
    CameraParams camera;
    DatasetSettings settings;
    DatasetOrigin origin;
    nlohmann::json parameters;
    nlohmann::json planned_metrics;
    std::vector<int> frames;  // indices into the trajectory

    // In this order, so that OpenGL's things go before the context they live in.
    std::unique_ptr<gl::Context> context;
    std::optional<SceneRenderer> renderer;
    // Two, so that one frame's triangles are set up while the other's pixels are still computed.
    std::array<std::optional<RenderTarget>, 2> targets;

    CaptureCounter counter;
    std::vector<std::vector<int>> well_shown;  // by frame of the dataset
    bool silhouettes_pending = false;
    ContactSheet sheet;
    std::optional<FrameWriter> writer;
    int started = 0;
    int done = 0;

    Impl(const Scene& s, const Trajectory& t, const CameraParams& c, DatasetSettings set,
         DatasetOrigin from)
        : scene(s),
          trajectory(t),
          camera(c),
          settings(std::move(set)),
          origin(std::move(from)),
          frames(framesOf(settings.range, static_cast<int>(t.frames.size()))),
          counter(s, settings.rules),
          well_shown(frames.size()),
          sheet(areKeys(t, frames), c.width_px, c.height_px) {}

    [[nodiscard]] const TrajectoryFrame& frameAt(int index) const {
        return trajectory.frames[static_cast<std::size_t>(frames[static_cast<std::size_t>(index)])];
    }

    [[nodiscard]] View viewAt(int index) const {
        View view;
        view.intrinsics = makeIntrinsics(camera);
        view.pose = frameAt(index).pose;
        view.near_m = camera.near_m;
        return view;
    }

    [[nodiscard]] RenderTarget& target(int index) {
        return *targets[static_cast<std::size_t>(index % 2)];
    }

    [[nodiscard]] static std::string roomOf(const TrajectoryFrame& frame) {
        return "room " + std::to_string(std::max(frame.component, 0) + 1);
    }

    Status start(int index) { return renderer->draw(viewAt(index), target(index)); }

    void takeSilhouettes(int index) {
        if (!silhouettes_pending) return;
        counter.addSilhouettes(renderer->finishSilhouettes());
        well_shown[static_cast<std::size_t>(index)] = counter.wellShown();
        silhouettes_pending = false;
    }

    Status processNext() {
        if (started == done) {
            if (Status status = start(started++); !status) return status;
        }
        if (started < static_cast<int>(frames.size())) {
            if (Status status = start(started++); !status) return status;
        }
        const int index = done;
        FrameRecord frame;
        frame.index = index;
        frame.time_s = frameAt(index).time_s;
        frame.pose = frameAt(index).pose;
        frame.width = camera.width_px;
        frame.height = camera.height_px;
        target(index).readIds(frame.instance);
        if (index > 0) takeSilhouettes(index - 1);
        const std::vector<int> wanted = counter.addFrame(frame);
        if (Status status = renderer->startSilhouettes(viewAt(index), wanted); !status) {
            return status;
        }
        silhouettes_pending = true;
        target(index).readRgb(frame.rgb);
        target(index).readDepth(frame.depth_m);
        if (sheet.wants(index)) {
            std::array<char, 64> caption{};
            std::snprintf(caption.data(), caption.size(), "%d   %.1f s   %s", index, frame.time_s,
                          roomOf(frameAt(index)).substr(0, 24).c_str());
            sheet.add(frame, caption.data());
        }
        ++done;
        return writer->write(std::move(frame));
    }

    Result<DatasetSummary> finish();
};

Result<DatasetSummary> DatasetJob::Impl::finish() {
    if (done != static_cast<int>(frames.size())) {
        return fail(ErrorCode::Failed, "finish() came before the last frame");
    }
    if (Status current = context->makeCurrent(); !current) return tl::unexpected(current.error());
    takeSilhouettes(done - 1);
    Result<std::vector<WrittenFrame>> written = writer->finish();
    if (!written) return tl::unexpected(written.error());

    DatasetSummary summary;
    summary.frames = done;
    summary.captures = bestCaptures(scene, counter.views(), settings.rules);
    summary.counted = summarize(scene, summary.captures);
    summary.contact_sheet = settings.folder / "contact_sheet.jpg";

    DatasetCard card;
    std::vector<CameraEntry> entries;
    std::vector<CocoFrame> coco;
    double far_m = 0.0;
    for (int i = 0; i < done; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const TrajectoryFrame& frame = frameAt(i);
        card.frames.push_back(frame);
        CameraEntry entry{frame, roomOf(frame), {}};
        for (const int id : well_shown[at]) entry.targets.push_back(scene.object(id).name);
        entries.push_back(std::move(entry));
        coco.push_back({i, frameFile("rgb", i), std::move((*written)[at].masks)});
        for (const auto& [file, hash] : (*written)[at].sha256s) card.sha256s[file] = hash;
        // The farthest a camera can see of the building; there is no far plane in the drawing.
        for (int corner = 0; corner < 8 && !scene.room_bounds.isEmpty(); ++corner) {
            const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
            far_m = std::max(far_m, (scene.room_bounds.corner(type) - frame.pose.position).norm());
        }
    }
    const auto put = [&](const char* name, std::span<const std::uint8_t> bytes) -> Status {
        card.sha256s[name] = io::sha256Of(bytes);
        return io::writeWhole(settings.folder / name, bytes, io::Durability::Renamed);
    };
    const auto putText = [&](const char* name, const std::string& text) -> Status {
        return put(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    Status status =
        putText("camera.json", cameraJsonText(scene, camera, std::ceil(far_m + 1.0), entries));
    if (!status) return tl::unexpected(status.error());
    status = putText("annotations.json", cocoText(scene, camera.width_px, camera.height_px, coco));
    if (!status) return tl::unexpected(status.error());
    std::array<char, 160> title{};
    std::snprintf(title.data(), title.size(), ": %d frames, %d of %d objects captured, %d well",
                  done, summary.counted.captured, summary.counted.objects,
                  summary.counted.well_captured);
    const auto page = sheet.encode(scene.name + title.data());
    if (!page) return tl::unexpected(page.error());
    if (status = put("contact_sheet.jpg", *page); !status) return tl::unexpected(status.error());

    card.product_version = origin.product_version;
    card.seed = origin.seed;
    card.parameters = parameters;
    card.planned_metrics = planned_metrics;
    card.counted = summary.counted;
    card.captures = summary.captures;
    card.camera = camera;
    card.source_frames = frames;
    const std::string text = datasetCardText(scene, card);
    // Everything it vouches for is on the disk before it appears.
    if (status = io::syncFolder(settings.folder); !status) return tl::unexpected(status.error());
    status = io::writeWhole(settings.folder / "dataset.json", text);
    if (!status) return tl::unexpected(status.error());
    if (status = releaseDatasetFolder(settings.folder); !status) {
        return tl::unexpected(status.error());
    }
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
    auto impl =
        std::make_unique<Impl>(scene, trajectory, camera, std::move(settings), std::move(origin));
    impl->context = std::move(context);
    if (impl->frames.empty()) {
        return fail(ErrorCode::Usage,
                    "the range holds none of the trajectory's " +
                        std::to_string(trajectory.frames.size()) + " frames",
                    "--range");
    }
    Result<nlohmann::json> parameters = parseJson(impl->origin.parameters_json, "the parameters");
    if (!parameters) return tl::unexpected(parameters.error());
    impl->parameters = std::move(*parameters);
    Result<nlohmann::json> metrics = parseJson(impl->origin.planned_metrics_json, "the metrics");
    if (!metrics) return tl::unexpected(metrics.error());
    impl->planned_metrics = std::move(*metrics);

    const LightVolume light =
        bakeLightVolume(scene, rays, makeLightRig(scene, rays, impl->origin.rooms), {}, job);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "the export was cancelled");
    Result<SceneRenderer> renderer = SceneRenderer::create(scene, light);
    if (!renderer) return tl::unexpected(renderer.error());
    impl->renderer.emplace(std::move(*renderer));
    for (auto& target : impl->targets) {
        Result<RenderTarget> created = RenderTarget::create(camera.width_px, camera.height_px);
        if (!created) return tl::unexpected(created.error());
        target.emplace(std::move(*created));
    }
    // An earlier dataset in the folder goes only when nothing is left that could fail early.
    const int count = static_cast<int>(impl->frames.size());
    if (Status status =
            prepareDatasetFolder(impl->settings.folder, impl->settings.overwrite,
                                 estimateBytes(count, camera.width_px, camera.height_px));
        !status) {
        return tl::unexpected(status.error());
    }
    impl->writer.emplace(impl->settings.folder, scene, count);
    return DatasetJob(std::move(impl));
}

int DatasetJob::frameCount() const {
    return static_cast<int>(impl_->frames.size());
}
int DatasetJob::framesDone() const {
    return impl_->done;
}

Result<bool> DatasetJob::step() {
    if (framesDone() == frameCount()) return false;
    if (Status status = impl_->context->makeCurrent(); !status) {
        return tl::unexpected(status.error());
    }
    if (Status status = impl_->processNext(); !status) return tl::unexpected(status.error());
    return true;
}

Result<DatasetSummary> DatasetJob::finish() {
    return impl_->finish();
}

Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context, const Scene& scene,
                                     const RayCaster& rays, const Trajectory& trajectory,
                                     const CameraParams& camera, DatasetSettings settings,
                                     DatasetOrigin origin, const JobContext& job) {
    Result<DatasetJob> dataset =
        DatasetJob::begin(std::move(context), scene, rays, trajectory, camera, std::move(settings),
                          std::move(origin), job.stage(0.0, 0.05, "light"));
    if (!dataset) return tl::unexpected(dataset.error());
    const JobContext frames = job.stage(0.05, 1.0, "frames");
    while (true) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "the export was cancelled");
        const Result<bool> more = dataset->step();
        if (!more) return tl::unexpected(more.error());
        if (!*more) return dataset->finish();
        frames.report(static_cast<double>(dataset->framesDone()) / dataset->frameCount());
    }
}

}  // namespace dollytrack::render
