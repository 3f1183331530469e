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
                     "How colour images are made: fast: by OpenGL; reference: path traced, "
                     "physically correct, minutes per frame"});
    visit("antialias", p.antialias,
          ChoiceInfo{{"edges", "4x", "8x"},
                     "Antialiasing of fast images: edges: jagged edges are blurred; 4x, 8x: "
                     "samples per pixel, better for thin objects"});
    visit("reflections", p.reflections,
          ChoiceInfo{{"blurred", "mirrors", "all"},
                     "What smooth surfaces reflect in fast images: blurred: the room's light, "
                     "blurred; mirrors: objects too, in mirrors and smooth metal; all: objects in "
                     "all smooth surfaces (slower)"});
    visit("anisotropy", p.anisotropy,
          FieldInfo{0, 16, "",
                    "Samples of anisotropic texture filtering, which keeps distant floors and "
                    "walls sharp; 0: 8 on a GPU, 1 on the CPU, where 8 take 50 % more time"});
    visit("reference_samples", p.reference_samples,
          FieldInfo{1, 65536, "",
                    "Paths per pixel of path-traced images; noise falls with the square root"});
}

}  // namespace dollytrack
