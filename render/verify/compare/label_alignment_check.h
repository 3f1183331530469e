#pragma once

#include "render/verify/compare/finding.h"
#include "render/verify/compare/picture_edges.h"
#include "render/verify/read/object_colours.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Compares one camera's images with the labels of their frames. An image is wrong if mirrored or
/// shifted labels, or those of another frame, fit it better; or if its own labels fit nothing in it
/// and its objects have other colours in the rest of the dataset.
class LabelAlignmentCheck {
  public:
    /// `objects_only` leaves out borders to pixels without object (id 0).
    LabelAlignmentCheck(std::size_t frames, bool objects_only);

    /// Adds a frame's images. Called once per frame, from many threads; unreadable frames are left
    /// out.
    void addFrame(std::size_t frame, const Image8& picture, const Image16& ids);

    /// Functions that read images again; an empty image means failure.
    struct Files {
        std::function<std::string(int frame)> picture_name;  // for findings
        std::function<Image8(int frame)> picture;
        std::function<Image16(int frame)> ids;
    };
    /// Adds a finding for each wrong image. Called after all frames were added.
    void report(const Files& files, Findings& findings);

  private:
    /// Measurements of a frame's images.
    struct FrameMeasurement {
        SmallFrame small;
        bool has_outlines = false;  // enough of them to compare
        bool blank = false;
        double structure = 0.0;
        OutlineAlignment fit = {};
    };
    /// Other frames by how well their labels fit an image's colours, best first.
    struct RankedFrames {
        std::vector<std::size_t> others;
        double better = 0.0;  // share that fits better than its own labels; 0 if unknown
    };

    [[nodiscard]] static bool isUnexplained(const FrameMeasurement& measurement);
    [[nodiscard]] RankedFrames rankedFor(std::size_t frame) const;
    [[nodiscard]] std::string problemOf(std::size_t frame, bool many_unexplained,
                                        const Files& files) const;
    /// Whether an image has no edges at the border of two objects, although their colours in other
    /// frames differ clearly. Objects of similar colour, such as two walls, are not compared,
    /// because the border between them is invisible in a correct image, too.
    [[nodiscard]] bool lacksExpectedEdges(std::size_t frame, const Files& files) const;
    [[nodiscard]] std::string explainedByOther(std::size_t frame,
                                               const std::vector<std::size_t>& others,
                                               const Files& files) const;

    // By frame; null: its images cannot be read.
    std::vector<std::unique_ptr<FrameMeasurement>> measurements_;
    ObjectColours colours_;
    bool objects_only_;
};

}  // namespace dollytrack::verify
