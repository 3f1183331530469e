#include "engine/io/import/import_notes.h"

#include "engine/core/text_lists.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>

#include <limits>
#include <map>

namespace dollytrack {

void noteRepairs(const RepairCounts& repairs, ImportReport& report) {
    const struct {
        std::size_t count;
        std::vector<std::string>& told;
        const char* one;
        const char* many;
    } lines[] = {
        {repairs.bad_numbers, report.warnings, "face with a non-finite corner was dropped",
         "faces with a non-finite corner were dropped"},
        {repairs.too_far, report.warnings,
         "face extends more than 1e9 units from the origin and was dropped",
         "faces extend more than 1e9 units from the origin and were dropped"},
        {repairs.bad_indices, report.warnings, "face that names a missing vertex was dropped",
         "faces that name a missing vertex were dropped"},
        {repairs.no_area, report.notes, "face without area was dropped",
         "faces without area were dropped"},
        {repairs.approximate, report.warnings, "polygon crosses itself and was filled as a fan",
         "polygons cross themselves and were filled as fans"},
        {repairs.lines, report.notes, "point or line was left out",
         "points and lines were left out"},
        {repairs.polygons, report.notes, "polygon was cut into triangles",
         "polygons were cut into triangles"},
        {repairs.made_normals, report.notes,
         "mesh had no normals; they were computed, smooth below 45 degrees",
         "meshes had no normals; they were computed, smooth below 45 degrees"},
        {repairs.mirrored, report.notes, "mesh is mirrored; its faces were turned back",
         "meshes are mirrored; their faces were turned back"},
    };
    for (const auto& line : lines) {
        if (line.count > 0) line.told.push_back(counted(line.count, line.one, line.many));
    }
}

void noteMerges(const std::vector<MergedPiece>& merges, const std::vector<ObjectDraft>& drafts,
                ImportReport& report) {
    if (merges.empty()) return;
    std::map<std::size_t, std::string> named;  // names by the draft they were merged into
    std::size_t nameless = 0;
    for (const MergedPiece& piece : merges) {
        if (piece.name.empty()) {
            ++nameless;
            continue;
        }
        std::string& names = named[piece.whole];
        names += (names.empty() ? "" : ", ") + piece.name;
    }
    std::string list;
    for (const auto& [whole, names] : named) {
        list += (list.empty() ? "" : "; ") + names + " with " + drafts[whole].name;
    }
    if (nameless > 0 && !named.empty()) {
        list += "; " + std::to_string(nameless) + " without a name of their own";
    }
    report.notes.push_back(
        counted(merges.size(), "piece was merged with the object it is attached to",
                "pieces were merged with the objects they are attached to") +
        " (--keep-meshes leaves them apart)" + (list.empty() ? "" : ": " + list));
}

void noteMaterialMeshes(const MaterialMeshes& found, bool regrouped, ImportReport& report) {
    if (!found.doubtful.empty()) {
        report.warnings.push_back(counted(found.doubtful.size(), "mesh", "meshes") +
                                  fmt::format(" may contain several similar, separate objects: {}; "
                                              "split them if so (dollytrack edit)",
                                              fmt::join(found.doubtful, ", ")));
    }
    if (found.names.empty()) return;
    const std::string meshes =
        counted(found.names.size(), "mesh contains", "meshes contain") +
        fmt::format(" parts of several objects: {}; ", fmt::join(found.names, ", "));
    if (regrouped) {
        report.warnings.push_back(
            meshes + fmt::format("they were regrouped into {} (--keep-meshes leaves them)",
                                 counted(found.objects, "object", "objects")));
        if (found.unnamed > 0) {
            report.warnings.push_back(
                counted(found.unnamed, "of the regrouped objects has",
                        "of the regrouped objects have") +
                " no class; set it (dollytrack edit, set_class), or exclude it");
        }
    } else {
        report.warnings.push_back(
            meshes + "leave --keep-meshes out to regroup them, or split and merge them by hand");
    }
}

void noteMaterialSplit(const MaterialSplit& found, std::optional<std::size_t> objects,
                       ImportReport& report) {
    std::string text =
        fmt::format("the meshes look split by material: {} of {} objects lie inside others; ",
                    found.inside, found.drafts);
    if (objects) {
        text += fmt::format(
            "all {} were regrouped into {}; check them (--keep-meshes leaves them as they are)",
            found.drafts, counted(*objects, "object", "objects"));
    } else {
        text += "leave out --keep-meshes to regroup them, or export one mesh per object";
    }
    report.warnings.push_back(std::move(text));
}

void noteUnseen(const std::vector<std::string>& proxies, std::size_t twice, ImportReport& report) {
    if (!proxies.empty()) {
        std::string list;
        for (const std::string& name : proxies) list += (list.empty() ? "" : ", ") + name;
        report.notes.push_back(
            counted(
                proxies.size(),
                "mesh is a collision shape, a navigation mesh or a cutter and was left out: ",
                "meshes are collision shapes, navigation meshes or cutters and were left out: ") +
            list);
    }
    if (twice > 0) {
        report.notes.push_back(
            counted(twice, "mesh occurs twice at the same position and was left out once",
                    "meshes occur twice at the same position and were left out once"));
    }
}

void noteSeparatedSides(std::size_t objects, ImportReport& report) {
    if (objects == 0) return;
    report.notes.push_back(
        counted(objects, "object has faces with another material on each side, drawn 0.5 mm apart",
                "objects have faces with another material on each side, drawn 0.5 mm apart"));
}

void noteFarAway(const RawScene& raw, double unit_m, ImportReport& report) {
    constexpr double kCoarsest_m = 1e-3;
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : raw.parts) {
        if (!part.triangles.empty()) box.extend(part.bounds.cast<double>());
    }
    if (box.isEmpty()) return;
    // Measured to the nearest point, because a large object such as a sky is not far away.
    const double away = box.exteriorDistance(Eigen::Vector3d::Zero());
    const double step_m = unit_m * away * std::numeric_limits<float>::epsilon();
    if (step_m < kCoarsest_m) return;
    report.warnings.push_back(
        fmt::format("the scene is {:.3g} m from the origin, where vertices have a precision of "
                    "only {:.2g} m; move it to the origin and export it again",
                    unit_m * away, step_m));
}

Error nothingToDraw(const RawScene& raw, const std::filesystem::path& path) {
    if (raw.repairs.no_area > 0) {
        return Error{ErrorCode::BadInput,
                     "all its faces have an area of 0; if it is millions of units from the origin, "
                     "where numbers are imprecise, move it to the origin and export it again",
                     path.string()};
    }
    if (raw.repairs.too_far > 0) {
        return Error{ErrorCode::BadInput,
                     "all its faces extend more than 1e9 units from the origin; move the scene to "
                     "the origin, choose a suitable unit, and export it again",
                     path.string()};
    }
    if (raw.repairs.bad_numbers + raw.repairs.bad_indices > 0) {
        return Error{ErrorCode::BadInput,
                     fmt::format("none of its faces can be drawn: {} have a non-finite corner, {} "
                                 "name a missing vertex; the file is damaged, export it again",
                                 raw.repairs.bad_numbers, raw.repairs.bad_indices),
                     path.string()};
    }
    return Error{ErrorCode::BadInput,
                 "the file contains no drawable triangle; export its meshes too", path.string()};
}

}  // namespace dollytrack
