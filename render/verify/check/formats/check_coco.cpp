// Checks COCO annotations: masks as run lengths and as polygons.
#include "render/verify/check/check_list.h"
#include "render/verify/compare/coco_file.h"
#include "render/verify/compare/filled_mask.h"
#include "render/verify/read/run_lengths.h"

#include <fmt/format.h>

#include <memory>
#include <numeric>

namespace dollytrack::verify {
namespace {

using Mask = std::vector<std::uint8_t>;  // column by column, nonzero inside

/// Adds a finding for the first pixel where the masks differ.
template <class Describe>
void compareMasks(const char* file, const CocoAnnotation& one, int height, const Mask& found,
                  const Mask& expected, int frame, const Describe& describe, Findings& findings) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if ((found[i] != 0) == (expected[i] != 0)) continue;
        const std::array pixel = {static_cast<int>(i) / height, static_cast<int>(i) % height};
        findings.add({file, frame, pixel,
                      fmt::format("annotation {}: {} the mask", one.id,
                                  found[i] != 0 ? "inside" : "outside"),
                      describe(pixel)});
        return;
    }
}

void wrongMask(const char* file, const CocoAnnotation& one, int frame, std::string found,
               std::string expected, Findings& findings) {
    findings.add(
        {file, frame, {}, fmt::format("annotation {}: {}", one.id, found), std::move(expected)});
}

constexpr const char* kRunLengths = "annotations.json";
constexpr const char* kPolygons = "annotations_polygons.json";

void compareRunLengths(const CocoAnnotation& one, const Image16& ids, int frame,
                       Findings& findings) {
    const auto size = one.segmentation.at("size").get<std::array<int, 2>>();
    if (size != std::array{ids.height, ids.width}) {
        return wrongMask(kRunLengths, one, frame, fmt::format("size {} x {}", size[0], size[1]),
                         fmt::format("{} x {}", ids.height, ids.width), findings);
    }
    const auto runs = one.segmentation.at("counts").get<std::string>();
    const Mask mask = maskFrom(readRunLengths(runs), ids.width, ids.height);
    if (mask.empty()) {
        return wrongMask(kRunLengths, one, frame, "run lengths that do not add up to the image",
                         fmt::format("{}", ids.values.size()), findings);
    }
    compareMasks(
        kRunLengths, one, ids.height, mask, shownBy(ids, one.object_id), frame,
        [&](const std::array<int, 2>& pixel) {
            return fmt::format("object {} in the instance image", ids.at(pixel[0], pixel[1]));
        },
        findings);
}

/// Checks that an outline states the object's visible share.
void checkAttributes(const CocoAnnotation& one, int frame, Findings& findings) {
    for (const char* name : {"visible_fraction", "truncation", "occluder_fraction"}) {
        const nlohmann::json share =
            one.attributes.is_object() ? one.attributes.value(name, nlohmann::json()) : nullptr;
        if (share.is_number() && share >= 0.0 && share <= 1.0) continue;
        wrongMask(kPolygons, one, frame, fmt::format("attributes.{} {}", name, share.dump()),
                  "0 to 1", findings);
    }
}

/// Polygons cannot have holes, so they include what the object encloses.
void comparePolygons(const CocoAnnotation& one, const Image16& ids, int frame, Findings& findings) {
    checkAttributes(one, frame, findings);
    Mask mask(ids.values.size());
    for (const nlohmann::json& polygon : one.segmentation) {
        const auto corners = polygon.get<std::vector<double>>();
        if (corners.size() < 6 || corners.size() % 2 != 0) {
            return wrongMask(kPolygons, one, frame, fmt::format("{} numbers", corners.size()),
                             "pairs, three or more", findings);
        }
        fillPolygon(corners, ids.width, ids.height, mask);
    }
    const Mask shown = shownBy(ids, one.object_id);
    const std::size_t parts = partSizes(shown, ids.width, ids.height).size();
    if (one.segmentation.size() != parts) {
        wrongMask(kPolygons, one, frame, fmt::format("{} polygons", one.segmentation.size()),
                  fmt::format("{}, one per visible part", parts), findings);
    }
    compareMasks(
        kPolygons, one, ids.height, mask, withoutHoles(shown, ids.width, ids.height), frame,
        [&](const std::array<int, 2>& pixel) {
            return fmt::format("object {} in the instance image", ids.at(pixel[0], pixel[1]));
        },
        findings);
}

CheckWork begin(const StoredDataset& dataset, const char* file, const CompareMask& compare_mask,
                Findings& findings) {
    std::vector<int> all(dataset.frames.size());
    std::iota(all.begin(), all.end(), 0);
    auto read = readCoco(dataset, file, all, findings);
    if (!read) return {};
    CheckWork work;
    work.frame = [&dataset, file, compare_mask,
                  annotations = std::make_shared<const CocoByFrame>(std::move(*read))](
                     FrameImages& images, Findings& found) {
        compareCoco(dataset, file, (*annotations)[images.frame()], images, compare_mask, found);
    };
    return work;
}

}  // namespace

CheckWork beginCoco(const Subject& subject, Findings& findings) {
    return begin(subject.dataset, kRunLengths, compareRunLengths, findings);
}

CheckWork beginCocoPolygons(const Subject& subject, Findings& findings) {
    return begin(subject.dataset, kPolygons, comparePolygons, findings);
}

}  // namespace dollytrack::verify
