#include "app/python/bindings/engine_objects.h"

#include "app/cli/export/export_warnings.h"
#include "app/cli/plan/baseline_plan.h"
#include "app/cli/plan/coverage_output.h"
#include "app/cli/plan/metrics_table.h"
#include "app/python/bindings/arrays.h"
#include "engine/camera/intrinsics.h"
#include "engine/core/field_list.h"
#include "engine/io/settings/project_file.h"
#include "engine/plan/ledger_json.h"
#include "engine/scene/scene_report.h"
#include "planning/analysis/coverage_curve.h"
#include "planning/remedies/remedies.h"
#include "render/encoders/modalities.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <utility>

namespace py = pybind11;

namespace dollytrack::python {
namespace {

py::array_t<double> vectorOf(const Eigen::Vector3d& v) {
    return py::array_t<double>(3, v.data());
}

/// Only one OpenGL context may be in use at a time.
std::timed_mutex& drawing() {
    static std::timed_mutex mutex;
    return mutex;
}

/// Waits until no other thread renders. Error: Cancelled.
Result<std::unique_lock<std::timed_mutex>> turnToDraw(const JobContext& job) {
    std::unique_lock lock(drawing(), std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(20))) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "rendering was cancelled");
    }
    return lock;
}

Result<Trajectory> trajectoryOf(const py::array& given_poses, const py::array& given_times,
                                const py::array& given_paths) {
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
    const Doubles poses(given_poses);
    const Doubles times(given_times);
    const py::array_t<int, py::array::c_style | py::array::forcecast> paths(given_paths);
    const bool fits = poses.ndim() == 3 && poses.shape(1) == 4 && poses.shape(2) == 4 &&
                      times.ndim() == 1 && times.shape(0) == poses.shape(0) && paths.ndim() == 1 &&
                      paths.shape(0) == poses.shape(0);
    if (!fits) return fail(ErrorCode::Usage, "Poses are N x 4 x 4, with N times and N paths.");
    Trajectory trajectory;
    for (py::ssize_t i = 0; i < poses.shape(0); ++i) {
        const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(
            poses.data(i, 0, 0));
        TrajectoryFrame& frame = trajectory.frames.emplace_back();
        frame.time_s = times.at(i);
        frame.path = paths.at(i);
        frame.pose.position = matrix.block<3, 1>(0, 3);
        frame.pose.rotation = Eigen::Quaterniond(Eigen::Matrix3d(matrix.block<3, 3>(0, 0)));
        frame.pose.rotation.normalize();
        frame.target_in_world = frame.pose.position + frame.pose.forward();
    }
    trajectory.frame_interval_s =
        medianStep_s(trajectory.frames).value_or(trajectory.frame_interval_s);
    return trajectory;
}

/// Stores a result's value and returns its status.
template <class T, class U>
Status put(Result<T> result, U& value) {
    if (!result) return tl::unexpected(std::move(result.error()));
    value = std::move(*result);
    return {};
}

}  // namespace

std::shared_ptr<OpenScene> OpenScene::open(const cli::SceneArguments& arguments,
                                           const py::object& progress) {
    std::shared_ptr<OpenScene> scene;
    waitFor(progress, [&](const JobContext& job) -> Status {
        if (Status status = cli::checkArguments(arguments); !status) return status;
        Result<cli::OpenedScene> opened = cli::openScene(arguments, job.stage(0.0, 1.0, "loading"));
        if (!opened) return tl::unexpected(std::move(opened.error()));
        scene = std::make_shared<OpenScene>(std::move(*opened));
        return {};
    });
    return scene;
}

std::string OpenScene::reportJson() const {
    return cli::jsonText(toJson(scene()));
}

py::list OpenScene::objects() const {
    py::list rows;
    for (const Object& object : scene().objects) {
        const DatasetClass& of = scene().classes().classOf(object);
        std::vector<double> corners;
        for (const Eigen::Vector3d& corner : object.box.corners()) {
            corners.insert(corners.end(), corner.data(), corner.data() + 3);
        }
        rows.append(py::dict(
            py::arg("id") = object.id, py::arg("name") = textOf(object.name),
            py::arg("class_id") = of.id, py::arg("class_name") = textOf(of.name),
            py::arg("role") = std::string(roleName(object.role)), py::arg("large") = object.large,
            py::arg("center") = vectorOf(object.box.center),
            py::arg("size") = vectorOf(2.0 * object.box.half_size), py::arg("yaw") = object.box.yaw,
            py::arg("front") = vectorOf(object.front),
            py::arg("corners") = arrayOf(std::move(corners), {8, 3}),
            py::arg("faces") = py::slice(object.first_triangle,
                                         object.first_triangle + object.triangle_count, 1)));
    }
    return rows;
}

std::string OpenScene::judge(const py::array& poses, const py::array& times_s,
                             const py::array& paths, const cli::SceneArguments& arguments,
                             const py::object& progress) const {
    const Result<Trajectory> trajectory = trajectoryOf(poses, times_s, paths);
    if (!trajectory) raise(trajectory.error());
    nlohmann::json metrics;
    waitFor(progress, [&](const JobContext& job) -> Status {
        Result<cli::OpenedScene> opened = cli::openedWith(opened_, arguments);
        if (!opened) return tl::unexpected(std::move(opened.error()));
        return put(cli::evaluateTrajectory(*opened, *trajectory, job), metrics);
    });
    return cli::jsonText(metrics);
}

Status OpenScene::withPipeline(const std::shared_ptr<const Scene>& scene,
                               const std::function<Status(planning::Pipeline&)>& work) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || scene != shared()) {
        planning::Pipeline pipeline(scene);
        return work(pipeline);
    }
    if (!pipeline_) pipeline_.emplace(scene);
    return work(*pipeline_);
}

std::shared_ptr<ScenePlan> ScenePlan::make(std::shared_ptr<OpenScene> scene,
                                           const cli::SceneArguments& arguments,
                                           const py::object& progress) {
    std::shared_ptr<ScenePlan> plan;
    waitFor(progress, [&](const JobContext& job) -> Status {
        Result<cli::OpenedScene> opened = cli::openedWith(scene->opened(), arguments);
        if (!opened) return tl::unexpected(std::move(opened.error()));
        return scene->withPipeline(opened->scene, [&](planning::Pipeline& pipeline) -> Status {
            auto planned = cli::planScene(*opened, pipeline, job.stage(0.0, 1.0, "planning"));
            if (!planned) return tl::unexpected(std::move(planned.error()));
            plan = std::make_shared<ScenePlan>(scene, std::move(*opened), std::move(*planned));
            return {};
        });
    });
    return plan;
}

std::shared_ptr<ScenePlan> ScenePlan::stored(std::shared_ptr<OpenScene> scene,
                                             const py::object& progress) {
    if (scene->opened().stored_result.is_null()) return nullptr;
    std::shared_ptr<ScenePlan> plan;
    waitFor(progress, [&](const JobContext& job) -> Status {
        auto planned = cli::planOrReuse(scene->opened(), job);
        if (!planned) return tl::unexpected(std::move(planned.error()));
        plan = std::make_shared<ScenePlan>(scene, scene->opened(), std::move(*planned));
        return {};
    });
    return plan;
}

std::string ScenePlan::metricsJson() const {
    return cli::jsonText(planned_.metrics);
}

std::string ScenePlan::parametersJson() const {
    planning::PlanParams params = planned_.params;
    return cli::jsonText(toJson(planning::listFields(params)));
}

py::array ScenePlan::poses() const {
    std::vector<double> values;
    for (const TrajectoryFrame& frame : planned_.trajectory.frames) {
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix =
            frame.pose.worldFromCamera().matrix();
        values.insert(values.end(), matrix.data(), matrix.data() + 16);
    }
    const auto count = static_cast<py::ssize_t>(planned_.trajectory.frames.size());
    return arrayOf(std::move(values), {count, 4, 4});
}

py::dict ScenePlan::frames() const {
    std::vector<double> times;
    std::vector<int> paths;
    std::vector<std::uint8_t> keys;
    for (const TrajectoryFrame& frame : planned_.trajectory.frames) {
        times.push_back(frame.time_s);
        paths.push_back(frame.path);
        keys.push_back(frame.position_point >= 0 ? 1 : 0);
    }
    const auto count = static_cast<py::ssize_t>(times.size());
    return py::dict(py::arg("times") = arrayOf(std::move(times), {count}),
                    py::arg("paths") = arrayOf(std::move(paths), {count}),
                    py::arg("keys") = arrayOf(std::move(keys), {count}));
}

py::tuple ScenePlan::intrinsics() const {
    const Intrinsics camera = makeIntrinsics(planned_.params.camera);
    return py::make_tuple(camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy);
}

Status ScenePlan::checkOwn() const {
    if (planned_.plan) return {};
    return fail(ErrorCode::Usage,
                "A project stores only the result of a plan, not the data of its search; plan the "
                "scene again.");
}

std::string ScenePlan::explain(const std::vector<int>& ids, const py::object& progress) const {
    nlohmann::json rows;
    waitFor(progress, [&](const JobContext& job) -> Status {
        if (Status status = checkOwn(); !status) return status;
        std::vector<LedgerRow> asked;
        for (const LedgerRow& row : planned_.plan->ledger) {
            if (std::ranges::find(ids, row.object_id) != ids.end()) asked.push_back(row);
        }
        auto found = planning::findRemedies(opened_.scene, opened_.params, opened_.plan_edits,
                                            *planned_.plan, std::move(asked),
                                            job.stage(0.0, 1.0, "remedies"));
        if (!found) return tl::unexpected(std::move(found.error()));
        rows = ledgerJson(*opened_.scene, *found);
        return {};
    });
    return cli::jsonText(rows);
}

std::string ScenePlan::coverage(const std::vector<std::string>& files,
                                const py::object& progress) const {
    std::string table;
    waitFor(progress, [&](const JobContext& job) -> Status {
        if (Status status = checkOwn(); !status) return status;
        if (Status status = cli::checkCoverageFiles(files); !status) return status;
        return scene_->withPipeline(opened_.scene, [&](planning::Pipeline& pipeline) -> Status {
            const auto curves =
                planning::coverageCurves(pipeline, opened_.params, opened_.plan_edits,
                                         *planned_.plan, job.stage(0.0, 1.0, "coverage"));
            if (!curves) return tl::unexpected(curves.error());
            const std::string title =
                opened_.scene->source.filename().string() + ": coverage by budget";
            for (const std::string& file : files) {
                if (Status status = cli::writeCoverage(title, *curves, file); !status) {
                    return status;
                }
            }
            table = cli::coverageCsv(*curves);
            return {};
        });
    });
    return table;
}

void ScenePlan::save(const std::string& file) const {
    waitFor(py::none(), [&](const JobContext&) -> Status {
        if (std::filesystem::path(file).extension() != ".dolly") {
            return fail(ErrorCode::Usage, "A project's name must end in .dolly.", file);
        }
        ProjectFile project = cli::projectOf(opened_);
        project.result = planned_.result;
        return saveProject(project, file);
    });
}

Result<std::pair<cli::OpenedScene, cli::PlannedScene>> ScenePlan::with(
    const std::vector<std::string>& assignments, const render::DatasetSettings& settings) const {
    if (Status status = cli::checkSensor(assignments, settings); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    std::pair<cli::OpenedScene, cli::PlannedScene> changed{opened_, planned_};
    planning::PlanParams& params = changed.first.params;
    if (!assignments.empty()) {
        cli::SceneArguments arguments;
        arguments.assignments = assignments;
        Result<cli::OpenedScene> opened = cli::openedWith(opened_, arguments);
        if (!opened) return tl::unexpected(std::move(opened.error()));
        if (!planning::makeSamePlan(opened_.params, opened->params)) {
            return fail(ErrorCode::Usage,
                        "Only parameters of picture, light and sensor can be changed here; pass "
                        "the others to plan().");
        }
        params = opened->params;
    }
    if (Status status = cli::fitSensor(changed.first, settings); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    cli::warnOfExport(params, settings);
    changed.second.params = params;
    return changed;
}

std::string ScenePlan::exportTo(const cli::ExportOrder& order,
                                const std::vector<std::string>& assignments,
                                const py::object& progress) const {
    nlohmann::json summary;
    const auto cancel_flag = std::make_shared<std::atomic<bool>>(false);
    const auto work = [&](const JobContext& job) -> Status {
        if (Status status = render::checkChoices(order.settings); !status) return status;
        if (Status status = cli::checkFolder(order.settings); !status) return status;
        auto changed = with(assignments, order.settings);
        if (!changed) return tl::unexpected(std::move(changed.error()));
        const auto turn = turnToDraw(job);
        if (!turn) return tl::unexpected(turn.error());
        auto context = order.backend.createContext();
        if (!context) return tl::unexpected(std::move(context.error()));
        const auto datasets = cli::exportPlanned(
            changed->first, changed->second, order, std::move(*context),
            [](const cli::ExportedDataset&) {}, cancel_flag, job);
        if (!datasets) return tl::unexpected(datasets.error());
        summary = cli::exportJson(order, *datasets, changed->second.metrics);
        return {};
    };
    waitFor(progress, work, cancel_flag);
    return cli::jsonText(summary);
}

namespace {

std::vector<float> flat(const std::vector<Eigen::Vector3f>& image) {
    std::vector<float> values;
    values.reserve(3 * image.size());
    for (const Eigen::Vector3f& value : image) {
        values.insert(values.end(), value.data(), value.data() + 3);
    }
    return values;
}

/// An image of a rendered frame as array; None for an unknown name.
py::object imageOf(render::FrameRecord& frame, const std::string& name) {
    const Shape plain = {frame.height, frame.width};
    const Shape colour = {frame.height, frame.width, 3};
    if (name == "rgb") return arrayOf(std::move(frame.rgb), colour);
    if (name == "depth") return arrayOf(std::move(frame.depth_m), plain);
    if (name == "instance") return arrayOf(std::move(frame.instance), plain);
    if (name == "semantic") return arrayOf(std::move(frame.semantic), plain);
    if (name == "albedo") return arrayOf(std::move(frame.albedo), colour);
    if (name == "rgb_right") return arrayOf(std::move(frame.rgb_right), colour);
    if (name == "depth_right") return arrayOf(std::move(frame.depth_right_m), plain);
    if (name != "normal_world" && name != "normal_camera") {
        const std::vector<Eigen::Vector3f> light = frame.layers.named(name);
        if (light.empty()) return py::none();
        return arrayOf(flat(light), colour);
    }
    Eigen::Matrix3f turn = Eigen::Matrix3f::Identity();
    if (name == "normal_camera") {
        turn = frame.pose.rotation.conjugate().toRotationMatrix().cast<float>();
    }
    std::vector<Eigen::Vector3f> normals = frame.normals_in_world;
    for (Eigen::Vector3f& normal : normals) normal = (turn * normal).eval();
    return arrayOf(flat(normals), colour);
}

Status checkDrawable(const std::vector<std::string>& names) {
    constexpr std::array kDrawn = {"rgb",
                                   "depth",
                                   "instance",
                                   "semantic",
                                   "normal_world",
                                   "normal_camera",
                                   "albedo",
                                   "rgb_right",
                                   "depth_right",
                                   "hdr",
                                   "diffuse_reflectance",
                                   "diffuse_illumination",
                                   "direct_illumination",
                                   "indirect_illumination",
                                   "residual"};
    for (const std::string& name : names) {
        if (std::ranges::find(kDrawn, name) != kDrawn.end()) continue;
        const std::vector<std::string> known(kDrawn.begin(), kDrawn.end());
        const bool exported = render::chooseModalities({name}).has_value();
        const std::string close = closestName(name, known);
        if (!exported && !close.empty()) {
            return fail(ErrorCode::Usage, "There is no such image; did you mean '" + close + "'?",
                        name);
        }
        std::string all;
        for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
        return fail(ErrorCode::Usage, "render() has " + all + "; export() writes the others.",
                    name);
    }
    return {};
}

}  // namespace

PlanFrames::PlanFrames(const std::shared_ptr<ScenePlan>& plan, cli::ExportOrder order,
                       const std::vector<std::string>& assignments, const py::object& progress)
    : plan_(plan), thread_(std::make_unique<WorkThread>()) {
    for (const std::string& name : order.settings.modalities) {
        if (std::ranges::find(modalities_, name) == modalities_.end()) modalities_.push_back(name);
    }
    const auto work = [&](const JobContext& job) -> Status {
        if (Status status = checkDrawable(modalities_); !status) return status;
        auto changed = plan->with(assignments, order.settings);
        if (!changed) return tl::unexpected(std::move(changed.error()));
        planned_ = std::move(changed->second);
        const auto turn = turnToDraw(job);
        if (!turn) return tl::unexpected(turn.error());
        auto context = order.backend.createContext();
        if (!context) return tl::unexpected(std::move(context.error()));
        rays_ = std::make_unique<const RayCaster>(*planned_.scene);
        auto series = cli::beginFrames(changed->first, planned_, *rays_, std::move(order),
                                       std::move(*context), job);
        if (!series) return tl::unexpected(std::move(series.error()));
        series_.emplace(std::move(*series));
        count_ = static_cast<int>(series_->contents().frames.size());
        return {};
    };
    try {
        waitFor(progress, work, *thread_, cancel_flag_);
    } catch (...) {
        close();
        throw;
    }
}

PlanFrames::~PlanFrames() {
    close();
}

py::object PlanFrames::next() {
    if (busy_)
        raise({ErrorCode::Usage, "Another thread is rendering with this object; wait for it.", {}});
    if (!thread_) return py::none();
    std::optional<render::FrameRecord> frame;
    busy_ = true;
    try {
        waitFor(
            py::none(),
            [&](const JobContext& job) -> Status {
                const auto turn = turnToDraw(job);
                if (!turn) return tl::unexpected(turn.error());
                return put(series_->next(), frame);
            },
            *thread_, cancel_flag_);
    } catch (...) {
        busy_ = false;
        close();
        throw;
    }
    busy_ = false;
    if (!frame) {
        close();
        return py::none();
    }
    const render::DatasetFrame& of = series_->contents().frames[frame->index];
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose =
        frame->pose.worldFromCamera().matrix();
    py::dict images;
    for (const std::string& name : modalities_) images[py::str(name)] = imageOf(*frame, name);
    return py::make_tuple(of.source_frame, frame->time_s,
                          arrayOf(std::vector<double>(pose.data(), pose.data() + 16), {4, 4}),
                          std::move(images));
}

void PlanFrames::close() {
    if (busy_) cancel_flag_->store(true);  // the rendering thread closes it
    if (busy_ || !thread_) return;
    std::unique_ptr<WorkThread> thread = std::move(thread_);
    // The context's objects are destroyed on its own thread, which then ends.
    thread->post(
        [series = std::make_shared<std::optional<render::FrameSeries>>(std::move(series_))] {
            const std::lock_guard lock(drawing());
            series->reset();
        });
    series_.reset();
    const py::gil_scoped_release release;
    thread.reset();
}

}  // namespace dollytrack::python
