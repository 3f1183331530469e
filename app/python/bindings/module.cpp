// The extension module dollytrack._core, on which the Python package builds. It exchanges plain
// values, arrays and JSON; names, defaults and documentation are in Python.

#include "app/python/bindings/arrays.h"
#include "app/python/bindings/engine_objects.h"
#include "engine/core/field_list.h"
#include "engine/core/program_file.h"
#include "engine/jobs/parallel.h"
#include "planning/plan_params.h"
#include "render/dataset/export_preset.h"
#include "render/dataset/frame_range.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace py = pybind11;
using namespace dollytrack;
using python::OpenScene;
using python::PlanFrames;
using python::ScenePlan;

namespace {

using Names = std::vector<std::string>;

/// All parameters in order: section, name, kind, default, unit, range, text and choices.
py::list parameters() {
    planning::PlanParams defaults;
    py::list rows;
    for (const Field& field : planning::listFields(defaults)) {
        py::object standard;
        std::string kind;
        Names choices;
        if (const auto* choice = std::get_if<Field::Choice>(&field.value)) {
            kind = "str";
            standard = py::str(field.valueText());
            choices.assign(choice->info.names.begin(), choice->info.names.end());
        } else if (const auto* on = std::get_if<Field::Switch>(&field.value)) {
            kind = "bool";
            standard = py::bool_(*on->value);
        } else if (const auto* integer = std::get_if<Field::Integer>(&field.value)) {
            kind = "int";
            standard = py::int_(*integer->value);
        } else {
            kind = "float";
            standard = py::float_(*std::get<Field::Real>(field.value).value);
        }
        rows.append(py::make_tuple(
            field.section, field.name, kind, standard, std::string(field.unit()), field.rangeText(),
            std::string(field.text()), choices, std::string(field.onlyWith())));
    }
    return rows;
}

std::shared_ptr<OpenScene> openScene(const std::string& path, std::optional<double> unit_m,
                                     std::optional<std::string> up_axis,
                                     std::optional<std::string> labels, Names models,
                                     std::optional<std::string> annotations, bool keep_meshes,
                                     bool convert, Names cloud, const py::object& progress) {
    cli::SceneArguments arguments;
    arguments.path = path;
    arguments.unit_m = unit_m;
    arguments.up_axis = std::move(up_axis);
    arguments.labels = std::move(labels);
    arguments.models = std::move(models);
    arguments.annotations = std::move(annotations);
    arguments.keep_meshes = keep_meshes;
    arguments.convert = convert;
    arguments.cloud = std::move(cloud);
    return OpenScene::open(arguments, progress);
}

cli::SceneArguments demands(Names assignments, Names ignore, Names only, std::string start,
                            std::string end, std::optional<double> time_s) {
    cli::SceneArguments arguments;
    arguments.assignments = std::move(assignments);
    arguments.ignore = std::move(ignore);
    arguments.only = std::move(only);
    arguments.start = std::move(start);
    arguments.end = std::move(end);
    arguments.time_s = time_s;
    return arguments;
}

cli::ExportOrder orderOf(const std::string& range, Names modalities, const std::string& backend,
                         bool still) {
    cli::ExportOrder order;
    const Result<render::FrameRange> frames = render::parseFrameRange(range);
    if (!frames) python::raise(frames.error());
    order.settings.range = *frames;
    order.settings.modalities = std::move(modalities);
    order.still = still;
    if (std::ranges::find(gl::kBackendNames, backend) == gl::kBackendNames.end()) {
        python::raise({ErrorCode::Usage, "It must be auto, egl or osmesa.", "gl"});
    }
    order.backend.name = backend;
    return order;
}

std::string exportPlan(const ScenePlan& plan, const std::string& folder, const std::string& preset,
                       Names modalities, Names formats, const std::string& range,
                       std::vector<int> flow_distances, int folds, std::uint64_t fold_seed,
                       const std::string& rig, const Names& cameras, bool still, bool overwrite,
                       bool resume, const std::string& backend, const Names& assignments,
                       const py::object& progress) {
    cli::ExportOrder order = orderOf(range, std::move(modalities), backend, still);
    render::DatasetSettings& settings = order.settings;
    settings.folder = folder;
    settings.formats = std::move(formats);
    if (const Status known = render::applyPreset(preset, settings); !known) {
        python::raise({known.error().code, known.error().message, "preset"});
    }
    settings.flow_distances = std::move(flow_distances);
    settings.folds = {folds, fold_seed};
    settings.overwrite = overwrite;
    settings.resume = resume;
    Result<Rig> cameras_of_rig = cli::rigOf(rig, cameras);
    if (!cameras_of_rig) python::raise(cameras_of_rig.error());
    settings.rig = std::move(*cameras_of_rig);
    return plan.exportTo(order, assignments, progress);
}

template <class Row>
Names namesOf(std::span<const Row> rows) {
    Names names;
    for (const Row& row : rows) names.emplace_back(row.name);
    return names;
}

py::dict classesOf(const OpenScene& scene) {
    py::dict classes;
    for (const DatasetClass& one : scene.scene().classes().classes()) {
        classes[py::int_(one.id)] = python::textOf(one.name);
    }
    return classes;
}

py::array faceObjects(const OpenScene& scene) {
    std::vector<std::uint16_t> ids(scene.scene().triangles.size());
    for (const Object& object : scene.scene().objects) {
        std::fill_n(ids.begin() + object.first_triangle, object.triangle_count,
                    static_cast<std::uint16_t>(object.id));
    }
    const auto count = static_cast<py::ssize_t>(ids.size());
    return python::arrayOf(std::move(ids), {count});
}

void bindScene(py::module_& module) {
    py::class_<OpenScene, std::shared_ptr<OpenScene>>(module, "Scene")
        .def_property_readonly("name", [](const OpenScene& s) { return py::bytes(s.scene().name); })
        .def_property_readonly(
            "source", [](const OpenScene& s) { return py::bytes(s.scene().source.string()); })
        .def_property_readonly("sha256", [](const OpenScene& s) { return s.scene().source_sha256; })
        .def("report", &OpenScene::reportJson)
        .def("objects", &OpenScene::objects)
        .def("classes", &classesOf)
        .def_property_readonly(
            "void_id", [](const OpenScene& s) { return s.scene().classes().voidClass().id; })
        .def("vertices",
             [](const OpenScene& s) {
                 const auto& points = s.scene().positions;
                 return python::viewOf(points.empty() ? nullptr : points.front().data(),
                                       {static_cast<py::ssize_t>(points.size()), 3}, s.shared());
             })
        .def("normals",
             [](const OpenScene& s) {
                 const auto& normals = s.scene().normals;
                 return python::viewOf(normals.empty() ? nullptr : normals.front().data(),
                                       {static_cast<py::ssize_t>(normals.size()), 3}, s.shared());
             })
        .def("faces",
             [](const OpenScene& s) {
                 const auto& faces = s.scene().triangles;
                 return python::viewOf(faces.empty() ? nullptr : faces.front().data(),
                                       {static_cast<py::ssize_t>(faces.size()), 3}, s.shared());
             })
        .def("face_objects", &faceObjects)
        .def(
            "plan",
            [](const std::shared_ptr<OpenScene>& scene, Names assignments, Names ignore, Names only,
               std::string start, std::string end, std::optional<double> time_s,
               const py::object& progress) {
                return ScenePlan::make(
                    scene,
                    demands(std::move(assignments), std::move(ignore), std::move(only),
                            std::move(start), std::move(end), time_s),
                    progress);
            },
            py::arg("assignments"), py::arg("ignore"), py::arg("only"), py::arg("start"),
            py::arg("end"), py::arg("time_s"), py::arg("progress"))
        .def("stored_plan", &ScenePlan::stored, py::arg("progress"))
        .def(
            "judge",
            [](const OpenScene& scene, const py::array& poses, const py::array& times_s,
               const py::array& paths, Names assignments, const py::object& progress) {
                return scene.judge(poses, times_s, paths,
                                   demands(std::move(assignments), {}, {}, "", "", std::nullopt),
                                   progress);
            },
            py::arg("poses"), py::arg("times_s"), py::arg("paths"), py::arg("assignments"),
            py::arg("progress"));
}

void bindPlan(py::module_& module) {
    py::class_<ScenePlan, std::shared_ptr<ScenePlan>>(module, "Plan")
        .def("metrics", &ScenePlan::metricsJson)
        .def("parameters", &ScenePlan::parametersJson)
        .def("poses", &ScenePlan::poses)
        .def("frames", &ScenePlan::frames)
        .def("intrinsics", &ScenePlan::intrinsics)
        .def("explain", &ScenePlan::explain, py::arg("ids"), py::arg("progress"))
        .def("coverage", &ScenePlan::coverage, py::arg("files"), py::arg("progress"))
        .def("save", &ScenePlan::save, py::arg("file"))
        .def("export", &exportPlan, py::arg("folder"), py::arg("preset"), py::arg("modalities"),
             py::arg("formats"), py::arg("range"), py::arg("flow_distances"), py::arg("folds"),
             py::arg("fold_seed"), py::arg("rig"), py::arg("cameras"), py::arg("still"),
             py::arg("overwrite"), py::arg("resume"), py::arg("gl"), py::arg("assignments"),
             py::arg("progress"))
        .def(
            "render",
            [](const std::shared_ptr<ScenePlan>& plan, Names modalities, const std::string& range,
               bool still, const std::string& backend, const Names& assignments,
               const py::object& progress) {
                return std::make_shared<PlanFrames>(
                    plan, orderOf(range, std::move(modalities), backend, still), assignments,
                    progress);
            },
            py::arg("modalities"), py::arg("range"), py::arg("still"), py::arg("gl"),
            py::arg("assignments"), py::arg("progress"));
    py::class_<PlanFrames, std::shared_ptr<PlanFrames>>(module, "Frames")
        .def("count", &PlanFrames::count)
        .def("next", &PlanFrames::next)
        .def("close", &PlanFrames::close);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    (void)ownFile();  // called while relative paths still refer to the starting folder
    python::logToPython();
    python::stopCallsAtExit();
    module.attr("version") = DOLLYTRACK_VERSION;
    module.def("parameters", &parameters);
    module.def("modalities", [] { return namesOf(render::modalities()); });
    module.def("formats", [] { return namesOf(render::formats()); });
    module.def("set_threads", &setThreadCount, py::arg("count"));
    module.def("open_scene", &openScene, py::arg("path"), py::arg("unit_m"), py::arg("up_axis"),
               py::arg("labels"), py::arg("models"), py::arg("annotations"), py::arg("keep_meshes"),
               py::arg("convert"), py::arg("cloud"), py::arg("progress"));
    bindScene(module);
    bindPlan(module);
}
