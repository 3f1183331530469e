#pragma once

#include "app/statistics/quantity.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/pictures/picture_quality.h"
#include "render/verify/read/stored_dataset.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::statistics {

/// How often a class occurs.
struct ClassStatistics {
    int id = 0;
    std::string name;
    std::size_t boxes = 0;    // instances: one for each object in each frame
    std::size_t frames = 0;   // with at least one box
    std::size_t objects = 0;  // distinct objects with a box
    std::size_t targets = 0;  // objects in the scene that should be captured
    std::size_t captured = 0;
    std::size_t well_captured = 0;
};

/// Numbers of box centres over a grid of the image, row by row from the top.
struct HeatMap {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint64_t> boxes;
};

/// A box that is drawn on an example frame.
struct ExampleBox {
    std::array<double, 4> box = {};  // x, y, width, height, px
    std::string object;
    std::string class_name;
    std::array<std::uint8_t, 3> color = {};  // of the class, sRGB
};

/// A frame that is shown on the page.
struct ExampleFrame {
    std::string dataset;  // its name, among several that are counted together
    int frame = 0;
    std::size_t boxes = 0;
    std::vector<ExampleBox> shown_boxes;  // at most kMostExampleBoxes
    std::vector<std::uint8_t> jpeg;       // empty if the image does not exist or is damaged
};
inline constexpr std::size_t kMostExampleBoxes = 40;

/// The numbers of one dataset, or of several that are counted together.
struct DatasetStatistics {
    std::string name;          // of its folder
    std::size_t datasets = 1;  // counted together
    std::string scene;         // file name; empty if the datasets have different ones
    int width_px = 0;
    int height_px = 0;
    std::size_t frames = 0;
    double duration_s = 0.0;
    std::optional<double> path_length_m;  // nothing without speeds in frames.csv
    bool has_boxes = false;               // whether there is an annotations.json
    std::size_t boxes = 0;
    std::size_t boxes_at_border = 0;       // that touch the border of the image
    std::vector<ClassStatistics> classes;  // that have boxes or targets, in the table's order
    HeatMap heat_map;                      // of all boxes
    render::PictureTally pictures;         // as counted by the export, by frame of its dataset
    std::size_t image_frames = 0;          // whose images were read
    std::size_t images_unreadable = 0;     // images that are missing or damaged
    std::vector<ExampleFrame> examples;
    std::array<std::vector<double>, kQuantities> values;  // by quantity

    [[nodiscard]] std::vector<double>& valuesOf(Quantity quantity) {
        return values[static_cast<std::size_t>(quantity)];
    }
    [[nodiscard]] const std::vector<double>& valuesOf(Quantity quantity) const {
        return values[static_cast<std::size_t>(quantity)];
    }
};

/// Numbers of evenly spaced frames of a dataset.
struct FrameSamples {
    std::size_t measured = 0;  // frames whose images are read
    std::size_t shown = 0;     // example frames
    double single_at = 0.0;    // where a single example frame is taken: 0 first, 1 end
};

/// Reads the tables, annotations and some images of a dataset. Equal input gives equal numbers,
/// whatever the number of threads. Errors: BadInput, with the file, if a table or the annotations
/// are damaged; Cancelled.
[[nodiscard]] Result<DatasetStatistics> collectStatistics(const verify::StoredDataset& dataset,
                                                          const FrameSamples& samples,
                                                          const JobContext& job);

/// Adds the numbers of `more`, whose images have the same size, to `sum`. Classes are matched by
/// name. Boxes, and the length of the path, are known if both know them.
void addStatistics(DatasetStatistics more, DatasetStatistics& sum);

}  // namespace dollytrack::statistics
