#pragma once

#include "render/verify/finding.h"
#include "render/verify/picture_edges.h"
#include "render/verify/read/object_colours.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Judges the pictures that one camera made in a dataset by the labels of their frames. One is
/// wrong where something else explains it better, the labels mirrored or moved, or those of another
/// frame; or where its own explain nothing of it and the things that they name have other colours
/// in the rest of the dataset.
class PictureJudge {
  public:
    /// Of so many frames. `of_things_alone` leaves borders with nothing (id 0) out.
    PictureJudge(std::size_t frames, bool of_things_alone);

    /// Called once a frame, from many threads; a frame that cannot be read is left out.
    void look(std::size_t frame, const Image8& picture, const Image16& ids);

    /// How to read images again; empty where that fails.
    struct Files {
        std::function<std::string(int frame)> picture_name;  // for findings
        std::function<Image8(int frame)> picture;
        std::function<Image16(int frame)> ids;
    };
    /// Called after all frames.
    void judge(const Files& files, Findings& findings);

  private:
    /// What is known of a frame once its images were read.
    struct Seen {
        SmallFrame small;
        bool judged = false;  // it has outlines enough
        bool blank = false;
        double structure = 0.0;
        OwnFit fit = {};
    };
    /// Frames by how well their labels fit the colours of a picture, the best first.
    struct Ranked {
        std::vector<std::size_t> others;
        double better = 0.0;  // share of them that fit better than its own; 0 where none is known
    };

    [[nodiscard]] static bool isUnexplained(const Seen& seen);
    [[nodiscard]] Ranked rankedFor(std::size_t frame) const;
    [[nodiscard]] std::string ask(std::size_t frame, bool many_unexplained,
                                  const Files& files) const;
    [[nodiscard]] std::string explainedByOther(std::size_t frame,
                                               const std::vector<std::size_t>& others,
                                               const Files& files) const;

    std::vector<std::unique_ptr<Seen>> seen_;  // by frame; null: its images cannot be read
    ObjectColours colours_;
    bool of_things_alone_;
};

}  // namespace dollytrack::verify
