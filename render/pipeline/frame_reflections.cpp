#include "render/pipeline/frame_reflections.h"

#include <optional>

namespace dollytrack::render {

struct FrameReflections::Still {
    std::shared_ptr<const RayCaster> rays;
    std::optional<MovedShape> shape;
    LightVolume light;
    std::optional<TracedReflections> reflections;
    int frame = 0;
};

FrameReflections::FrameReflections(const FrameContext& context, const FrameLights& lights,
                                   Reflections which)
    : context_(context),
      lights_(lights),
      any_(TracedReflections::any(context.contents.scene, which)) {}

const TracedReflections* FrameReflections::at(int frame) {
    if (!any_) return nullptr;
    const bool always_alike = !context_.moving.any() && !lights_.vary();
    std::shared_ptr<Still>& place = stills_[always_alike ? 0 : static_cast<unsigned>(frame) % 2];
    if (place && (always_alike || place->frame == frame)) return &*place->reflections;
    auto still = std::make_shared<Still>();
    still->frame = frame;
    still->rays = context_.moving.raysAt(frame);
    still->shape = context_.moving.wholeShapeAt(frame);
    still->light =
        lights_.vary() ? lights_.volumeAt(context_.contents.sourceFrame(frame)) : lights_.volume();
    still->light.lamps = lights_.volume().lamps;
    still->light.scene_lamp_share = lights_.volume().scene_lamp_share;
    still->reflections.emplace(context_.contents.scene, *still->rays, still->light,
                               still->shape ? &*still->shape : nullptr);
    place = std::move(still);
    return &*place->reflections;
}

}  // namespace dollytrack::render
