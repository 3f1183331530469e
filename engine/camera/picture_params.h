#pragma once

#include "engine/core/field_list.h"

namespace dollytrack {

/// How the colour pictures of a dataset come to be; depth, labels and all else are the same.
enum class RenderMode {
    Fast,       // drawn, lit by light computed once for the scene
    Reference,  // path traced
};

/// How drawn pictures get smooth edges. Labels and depth are those of pixels' centres always.
enum class Antialias {
    Edges,     // one look a pixel, steps in the picture are blurred along; fast
    Samples4,  // the mean of so many looks a pixel
    Samples8,
};

/// The colour pictures that an export writes.
struct PictureParams {
    RenderMode render_mode = RenderMode::Fast;
    Antialias antialias = Antialias::Samples4;
    int reference_samples = 64;

    bool operator==(const PictureParams&) const = default;
};

template <class Params, class Visitor>
void visitPictureParams(Params& p, Visitor&& visit) {
    visit("render_mode", p.render_mode,
          ChoiceInfo{{"fast", "reference"},
                     "How colour pictures are made: drawn, or path traced, which takes minutes a "
                     "frame and is what the light would really do"});
    visit("antialias", p.antialias,
          ChoiceInfo{{"edges", "4x", "8x"},
                     "Smooth edges of drawn pictures: stairs blurred, or the mean of so many looks "
                     "a pixel, which thin things and textures need"});
    visit("reference_samples", p.reference_samples,
          FieldInfo{1, 65536, "",
                    "Paths a pixel of path traced pictures; noise falls with its "
                    "square root"});
}

}  // namespace dollytrack
