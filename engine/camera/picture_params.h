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

/// What smooth surfaces of drawn pictures show. Path traced ones show all.
enum class Reflections {
    Blurred,  // the room's light
    Mirrors,  // things, in mirrors and smooth metal
    All,      // things, in all that is smooth
};

/// The colour pictures that an export writes.
struct PictureParams {
    RenderMode render_mode = RenderMode::Fast;
    Antialias antialias = Antialias::Samples4;
    Reflections reflections = Reflections::Mirrors;
    int anisotropy = 0;
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
                     "a pixel, which thin things need"});
    visit(
        "reflections", p.reflections,
        ChoiceInfo{{"blurred", "mirrors", "all"},
                   "What smooth surfaces of drawn pictures show: the room's blurred light, things "
                   "in mirrors and smooth metal, or things in all that is smooth, which takes "
                   "longer the more of it is in sight"});
    visit("anisotropy", p.anisotropy,
          FieldInfo{0, 16, "",
                    "Places along its slant that a texture is looked up in, so that floors and "
                    "walls stay sharp far away; 0: 8 on a graphics card, 1 on the processor, "
                    "which takes half as long again for 8"});
    visit("reference_samples", p.reference_samples,
          FieldInfo{1, 65536, "",
                    "Paths a pixel of path traced pictures; noise falls with its "
                    "square root"});
}

}  // namespace dollytrack
