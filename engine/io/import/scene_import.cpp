#include "engine/io/import/scene_import.h"

#include "engine/core/clean_text.h"
#include "engine/core/fold_repeats.h"
#include "engine/core/text_lists.h"
#include "engine/io/format_table/input_check.h"
#include "engine/io/format_table/scene_format.h"
#include "engine/io/import/annotated_objects.h"
#include "engine/io/import/far_objects.h"
#include "engine/io/import/import_notes.h"
#include "engine/io/import/oddity_notes.h"
#include "engine/io/import/propose_import.h"
#include "engine/io/import/redundant_parts.h"
#include "engine/io/import/scene_assembly.h"
#include "engine/io/import/size_warnings.h"
#include "engine/io/import/structure_finder.h"
#include "engine/io/object_parts/material_meshes.h"
#include "engine/io/object_parts/material_split.h"
#include "engine/io/object_parts/numbered_pieces.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/object_parts/piece_merge.h"
#include "engine/io/object_parts/piece_split.h"
#include "engine/io/orientation/frame_guess.h"
#include "engine/io/sandbox/scene_reading.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/io/settings/import_labels.h"
#include "engine/scene/front_directions.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"
#include "engine/scene/object_size.h"
#include "engine/scene/outside_objects.h"
#include "engine/scene/room_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

namespace dollytrack {
namespace {

/// Names the pieces of split meshes after their class or material, with a number.
void nameObjects(std::vector<ObjectDraft>& drafts) {
    std::map<std::string, int> used;
    for (ObjectDraft& draft : drafts) {
        if (!draft.loose) continue;
        std::string base = draft.label.kind == LabelKind::Structure
                               ? std::string(nyu40Name(draft.label.nyu40))
                               : withoutNumber(draft.name);
        if (base.empty()) base = "object";
        draft.name = base + "_" + std::to_string(++used[base]);
    }
}

/// The drafts of annotated objects, which take precedence over estimated ones.
AnnotatedDrafts draftsOfAnnotations(const Annotations& said, const LabelTable& labels,
                                    RawScene& raw, ImportReport& report) {
    if (said.file.empty()) return {};
    const std::string file = cleanText(said.file.string());
    report.notes.push_back("annotations: " + file);
    report.warnings.insert(report.warnings.end(), said.doubts.begin(), said.doubts.end());
    if (said.objects.empty()) return {};
    if (!raw.objects.empty()) {
        report.warnings.push_back(
            "annotations: this scene format defines its own objects, so the object list of " +
            file + " was not used");
        return {};
    }
    AnnotatedDrafts annotated = takeAnnotated(said.objects, labels, raw);
    report.warnings.insert(report.warnings.end(), annotated.warnings.begin(),
                           annotated.warnings.end());
    return annotated;
}

/// Warns about given fronts that are not horizontal.
void noteUprightFronts(const std::vector<ObjectDraft>& drafts, Scene& scene) {
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (!drafts[i].front || scene.objects[i].front_source == FrontSource::Annotation) continue;
        scene.report.warnings.push_back(
            "the front given for \"" + scene.objects[i].name +
            "\" points up or down; the front is found by the object's shape instead");
    }
}

std::vector<bool> structureOf(const std::vector<ObjectDraft>& drafts) {
    std::vector<bool> structure;
    for (const ObjectDraft& draft : drafts) {
        structure.push_back(draft.label.kind == LabelKind::Structure);
    }
    return structure;
}

/// Joins objects that are split by material, or warns of them.
void regroupMaterialSplit(const RawScene& raw, bool regroup, std::vector<ObjectDraft>& drafts,
                          ImportReport& report) {
    const std::vector<bool> structure = structureOf(drafts);
    const auto found = findMaterialSplit(raw, structure, drafts);
    if (!found) return;
    std::optional<std::size_t> objects;
    if (regroup) {
        for (std::size_t i = 0; i < drafts.size(); ++i) {
            // "mat_3" is the name of a material here, not of a door mat.
            if (found->by_material[i] && isMaterialNumber(drafts[i].name)) drafts[i].label = {};
        }
        const std::vector<MergedPiece> merges =
            mergePieces(raw, structure, drafts, found->by_material);
        if (merges.empty()) return;
        noteMerges(merges, drafts, report);
        objects = static_cast<std::size_t>(std::ranges::count(structureOf(drafts), false));
    }
    noteMaterialSplit(*found, objects, report);
}

/// Splits, regroups and merges the drafts of nodes into drafts of objects. Without `regroup`, each
/// draft stays an object.
void findObjects(RawScene& raw, const LabelTable& labels, bool regroup,
                 std::vector<ObjectDraft>& drafts, ImportReport& report) {
    dropNamesOfJoinedScenes(raw, drafts);
    if (const std::size_t joined = regroup ? joinNumberedPieces(raw, drafts) : 0; joined > 0) {
        report.notes.push_back(
            fmt::format("{} numbered pieces of Sweet Home 3D's furniture were joined to objects "
                        "(--keep-meshes leaves them apart)",
                        joined));
    }
    if (const std::size_t joined = regroup ? joinPiecesOfPaths(raw, labels, drafts) : 0;
        joined > 0) {
        report.notes.push_back(
            fmt::format("{} pieces whose names have the same path were joined to objects "
                        "(--keep-meshes leaves them apart)",
                        joined));
    }
    MaterialMeshes meshes = regroupMaterialMeshes(raw, labels, drafts, regroup);
    const std::size_t scattered = regroup ? splitScattered(raw, labels, drafts) : 0;
    if (scattered > 0) {
        report.notes.push_back(
            counted(scattered, "node contained distant parts, which became separate objects",
                    "nodes contained distant parts, which became separate objects"));
    }
    const std::size_t split = regroup ? splitMergedScenes(raw, labels, drafts) : 0;
    if (split > 0) {
        report.warnings.push_back(
            "the file does not separate its objects; they were found as connected pieces; check "
            "them, and split those that hold several things (Split into pieces in the editor, the "
            "operation split of 'dollytrack edit')");
    }
    std::erase_if(meshes.doubtful, [&](const std::string& name) {
        return std::ranges::find(drafts, name, &ObjectDraft::name) == drafts.end();
    });
    noteMaterialMeshes(meshes, regroup, report);
    if (const std::size_t tiles = regroup ? mergeTiles(raw, drafts) : 0; tiles > 0) {
        report.notes.push_back(
            fmt::format("{} boards or tiles were joined to the floor, ceiling or wall that they "
                        "are parts of",
                        tiles));
    }
    const std::vector<bool> structure = findStructure(raw, drafts);
    std::vector<MergedPiece> merges;
    if (regroup) merges = mergePieces(raw, structure, drafts);
    nameObjects(drafts);
    noteMerges(merges, drafts, report);
    regroupMaterialSplit(raw, regroup, drafts, report);
}

/// The draft with the mesh of a whole room in a world of few objects: a detailed mesh that spans
/// most of the world. Its index; nullopt if there is none. Flat grounds do not count.
std::optional<std::size_t> roomOfOneMesh(const RawScene& raw,
                                         const std::vector<ObjectDraft>& drafts) {
    constexpr std::ptrdiff_t kMostObjects = 6;
    constexpr std::size_t kFewestTriangles = 500;
    constexpr float kFlat_m = 0.05F;
    constexpr float kLeastShare = 0.6F;
    constexpr float kLeastWidth_m = 2.5F;
    constexpr float kLeastHeight_m = 1.8F;
    std::vector<Eigen::Vector3f> sizes;
    Eigen::AlignedBox3f all;
    for (const ObjectDraft& draft : drafts) {
        const Eigen::AlignedBox3f box = boundsOf(raw, draft);
        sizes.push_back(box.sizes());
        if (sizes.back().z() >= kFlat_m) all.extend(box);
    }
    const auto standing = std::ranges::count_if(
        sizes, [](const Eigen::Vector3f& size) { return size.z() >= kFlat_m; });
    if (standing == 0 || standing > kMostObjects) return std::nullopt;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        std::size_t triangles = 0;
        for (const std::size_t part : drafts[i].parts)
            triangles += raw.parts[part].triangles.size();
        const Eigen::Vector3f& size = sizes[i];
        if (triangles >= kFewestTriangles && size.z() > kLeastHeight_m &&
            size.head<2>().minCoeff() > kLeastWidth_m &&
            (size.head<2>().array() > kLeastShare * all.sizes().head<2>().array()).all()) {
            return i;
        }
    }
    return std::nullopt;
}

/// Finds the structure of a world whose objects have no classes. If one of them is the mesh of a
/// whole room, its objects are found; the other objects of the world stay as they are.
void findObjectsOfWorld(RawScene& raw, const LabelTable& labels, bool regroup,
                        std::vector<ObjectDraft>& drafts, ImportReport& report) {
    const std::optional<std::size_t> room =
        regroup ? roomOfOneMesh(raw, drafts) : std::optional<std::size_t>();
    if (!room) {
        findUnnamedStructure(raw, drafts);
        return;
    }
    std::vector<ObjectDraft> found = {std::move(drafts[*room])};
    if (found.front().label.pattern.empty() && found.front().label.nyu40 == 0) {
        found.front().label = {};
    }
    findObjects(raw, labels, regroup, found, report);
    const auto at = drafts.erase(drafts.begin() + static_cast<std::ptrdiff_t>(*room));
    drafts.insert(at, std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
}

/// Moves a scene that is more than a kilometre from the origin near it, because maps and
/// single-precision numbers do not extend farther.
void moveNear(const RawScene& raw, Eigen::Affine3d& world_from_source, ImportReport& report) {
    constexpr double kFar_m = 1000.0;
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : raw.parts) {
        if (!part.triangles.empty()) box.extend(part.bounds.cast<double>());
    }
    if (box.isEmpty()) return;
    const Eigen::Vector3d center = world_from_source * box.center();
    // Measured to the nearest part, because a large object such as a sky is not far away.
    const double reach = 0.5 * (world_from_source.linear() * box.sizes()).norm();
    if (center.norm() - reach < kFar_m) return;
    const Eigen::Vector3d moved = -center.array().round();
    world_from_source.pretranslate(moved);
    report.notes.push_back(
        fmt::format("the scene lies {:.0f} m from the origin and was moved by "
                    "({:.0f}, {:.0f}, {:.0f}) m",
                    center.norm(), moved.x(), moved.y(), moved.z()));
}

/// Gives objects outside the building the role Structure, so that they are no targets unless
/// edited. They do not become part of the building, which determines what is inside.
void setOutsideRoles(Scene& scene) {
    const std::vector<int> outside = findOutsideObjects(scene);
    for (const int id : outside) {
        scene.objects[id - 1].role = Role::Structure;
    }
    if (outside.empty()) return;
    scene.report.notes.push_back(
        counted(outside.size(), "object outside the building is not a target; include it if needed",
                "objects outside the building are not targets; include them if needed"));
}

Status checkOptions(const ImportOptions& options) {
    if (options.unit_m && !(*options.unit_m > 0.0 && *options.unit_m < 1e6)) {
        return fail(ErrorCode::Usage, "metres per unit must be above 0 and below 1e6", "unit_m");
    }
    if (options.up_axis && !options.up_axis->isAxis()) {
        return fail(ErrorCode::Usage, fmt::format("the upward axis is {}", kUpAxes), "up_axis");
    }
    return {};
}

FrameChoice frameOf(const RawScene& raw, const SceneFormat& format,
                    const std::vector<ObjectDraft>& drafts, const ImportOptions& options) {
    if (!format.frame_is_specified) {
        return chooseFrame(raw, drafts, options.unit_m, options.up_axis, format.usual_up);
    }
    const UpAxis up = options.up_axis.value_or(raw.file_up_axis);
    FrameChoice frame = chooseFrame(raw, drafts, options.unit_m ? options.unit_m : raw.file_unit_m,
                                    up.isAxis() ? std::optional(up) : std::nullopt);
    if (!options.unit_m) frame.unit_source = "format";
    if (!options.up_axis && up.isAxis()) frame.up_source = "format";
    return frame;
}

/// Chooses unit and upward axis by the objects that lie near each other; the others are left out.
FrameChoice chooseFrameAndDropFar(RawScene& raw, const SceneFormat& format,
                                  std::vector<ObjectDraft>& annotated,
                                  std::vector<ObjectDraft>& drafts, const ImportOptions& options,
                                  ImportReport& report) {
    const auto choose = [&] {
        std::vector<ObjectDraft> all = annotated;
        all.insert(all.end(), drafts.begin(), drafts.end());
        return frameOf(raw, format, all, options);
    };
    FrameChoice frame = choose();
    // Without the farthest objects, the unit may be another, by which more of them are far.
    while (dropFarObjects(raw, frame.unit_m, annotated, drafts, report)) frame = choose();
    return frame;
}

/// Whether the source says what an object is. Worlds of Gazebo and URDF files never do.
bool saysClass(const SourceObject& object) {
    return object.structure || object.nyu40 > 0 || !object.category.empty();
}

void reportFrame(const RawScene& raw, const FrameChoice& frame, ImportReport& report) {
    report.notes.insert(report.notes.end(), raw.notes.begin(), raw.notes.end());
    report.warnings.insert(report.warnings.end(), raw.warnings.begin(), raw.warnings.end());
    report.unit_m = frame.unit_m;
    report.unit_source = frame.unit_source;
    report.up_axis = frame.up_axis.text();
    report.up_source = frame.up_source;
    report.warnings.insert(report.warnings.end(), frame.warnings.begin(), frame.warnings.end());
    noteFarAway(raw, frame.unit_m, report);
}

}  // namespace

Result<Scene> importScene(const std::filesystem::path& path, const ImportOptions& options,
                          const JobContext& job) {
    if (Status ok = checkOptions(options); !ok) return tl::unexpected(ok.error());
    const Result<const SceneFormat*> format = checkSceneFile(path);
    if (!format) return tl::unexpected(format.error());
    const Result<ImportLabels> said_labels = importLabels(options);
    if (!said_labels) return tl::unexpected(said_labels.error());
    const LabelTable* labels = &said_labels->words;
    Result<Annotations> said = findAnnotations(path, options.annotations);
    if (!said) return tl::unexpected(said.error());
    ImportOptions reading = options;
    if (!reading.unit_m) reading.unit_m = said->unit_m;
    if (!reading.up_axis) reading.up_axis = said->up_axis;

    job.report(0.0);
    Result<SceneFileContent> read =
        readSceneFile(**format, path, reading, job.stage(0.0, 0.6, "reading"));
    if (!read) return tl::unexpected(read.error());
    RawScene& raw = read->scene.raw;

    Scene scene;
    scene.name = cleanText(path.stem().string());
    scene.source = path;
    noteRepairs(raw.repairs, scene.report);
    const bool knows_objects = !raw.objects.empty();
    if (!knows_objects) {
        const std::vector<std::string> proxies = dropProxies(raw);
        noteUnseen(proxies, dropDuplicates(raw), scene.report);
    }
    AnnotatedDrafts annotated = draftsOfAnnotations(*said, *labels, raw, scene.report);
    const bool lacks_classes = std::ranges::none_of(raw.objects, saysClass);
    std::vector<ObjectDraft> drafts =
        knows_objects ? draftsOfSource(raw, *labels) : groupByNodes(raw, *labels, annotated.taken);
    if (drafts.empty() && annotated.drafts.empty()) {
        return tl::unexpected(nothingToDraw(raw, path));
    }
    job.report(0.6);

    const FrameChoice frame =
        chooseFrameAndDropFar(raw, **format, annotated.drafts, drafts, reading, scene.report);
    reportFrame(raw, frame, scene.report);
    Eigen::Affine3d world_from_source = frame.worldFromSource();
    moveNear(raw, world_from_source, scene.report);
    scene.source_from_world = raw.file_from_parts * world_from_source.inverse();
    moveToWorld(raw.parts, world_from_source);
    if (!knows_objects) {
        findObjects(raw, *labels, options.regroup, drafts, scene.report);
    } else if (lacks_classes) {
        findObjectsOfWorld(raw, *labels, options.regroup, drafts, scene.report);
    }
    drafts.insert(drafts.begin(), std::make_move_iterator(annotated.drafts.begin()),
                  std::make_move_iterator(annotated.drafts.end()));
    noteSeparatedSides(separateSides(drafts, raw.parts), scene.report);
    job.report(0.7);

    TextureSet& textures = read->scene.textures;
    textures.textures.resize(raw.textures.size());
    scene.textures = std::move(textures.textures);
    scene.report.textures_found = textures.found;
    scene.report.textures_missing = textures.missing;
    if (!textures.missing.empty() && options.model_folders.empty()) {
        scene.report.notes.push_back(
            "missing textures were searched for below the scene's folder; name another folder with "
            "--models");
    }
    for (const std::string& name : textures.broken) {
        scene.report.warnings.push_back("the texture " + name + " cannot be decoded");
    }
    job.report(0.9);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", path.string());

    scene.materials = std::move(raw.materials);
    assembleObjects(raw.parts, drafts, scene);
    noteUprightFronts(drafts, scene);
    std::vector<std::string> left_out;
    scene.room_bounds = findRoomBounds(scene, left_out);
    for (const std::string& name : left_out) {
        scene.report.notes.push_back("\"" + name +
                                     "\" is outside or around the building, so the size of the "
                                     "building does not include it");
    }
    if (!(*format)->frame_is_specified) {
        scene.report.proposal = proposeImport(scene, frame, !knows_objects);
    }
    if (scene.report.proposal.up_unconfirmed && scene.report.up_source == "file") {
        scene.report.up_source += "; nothing in the scene shows whether it is right; --up sets it";
    }
    for (std::string& line : describe(scene.report.proposal)) {
        scene.report.warnings.push_back(std::move(line));
    }
    setOutsideRoles(scene);
    noteOddities(scene, scene.report);
    warnOfUnusualSizes(scene, scene.report);
    findFronts(scene);
    sortBySize(scene.objects, options.small_volume_m3, options.size_ratio);
    scene.class_table = said_labels->classes;
    assignDatasetClasses(scene);

    scene.report.notes = foldRepeats(scene.report.notes);
    scene.report.warnings = foldRepeats(scene.report.warnings);
    scene.source_sha256 = std::move(read->sha256);
    job.report(1.0);
    return scene;
}

}  // namespace dollytrack
