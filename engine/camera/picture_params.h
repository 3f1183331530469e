#pragma once

#include "engine/core/field_list.h"

namespace dollytrack {

/// How the colour images of a dataset are rendered. Depth, labels and all other images do not
/// depend on it.
enum class RenderMode {
    Fast,       // rasterized, with light computed once for the scene
    Reference,  // path traced, not denoised
    Traced,     // path traced with few samples and denoised
};

/// Antialiasing of rasterized images. Labels and depth are always those of pixel centres.
enum class Antialias {
    Edges,     // one sample per pixel, jagged edges are blurred; fast
    Samples4,  // mean of this many samples per pixel
    Samples8,
};

/// Reflections in smooth surfaces of rasterized images. Path-traced images have all reflections.
enum class Reflections {
    Blurred,  // the room's light
    Mirrors,  // objects, in mirrors and smooth metal
    All,      // objects, in all smooth surfaces
};

/// Parameters of the colour images that an export writes.
struct PictureParams {
    RenderMode render_mode = RenderMode::Fast;
    Antialias antialias = Antialias::Samples4;
    Reflections reflections = Reflections::Mirrors;
    int anisotropy = 0;
    int traced_samples = 16;
    int reference_samples = 64;

    bool operator==(const PictureParams&) const = default;
};

template <class Params, class Visitor>
void visitPictureParams(Params& p, Visitor&& visit) {
    visit("render_mode", p.render_mode,
          ChoiceInfo{{"fast", "reference", "traced"},
                     "How colour images are made: fast: by OpenGL; traced: path traced with few "
                     "samples and denoised, realistic, seconds per frame; reference: path traced "
                     "without denoising, minutes per frame"});
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
    visit("traced_samples", p.traced_samples,
          FieldInfo{2, 4096, "", "Paths per pixel of traced images, before denoising"}.onlyWith(
              "render_mode=traced"));
    visit("reference_samples", p.reference_samples,
          FieldInfo{1, 65536, "",
                    "Paths per pixel of reference images; noise falls with the square root"}
              .onlyWith("render_mode=reference"));
}

}  // namespace dollytrack
