// Reads a scene, plans a camera trajectory and renders it as a dataset, with the installed libraries.
#include "engine/geometry/ray_caster.h"
#include "engine/io/import/scene_import.h"
#include "planning/pipeline/pipeline.h"
#include "render/dataset/dataset_job.h"
#include "render/gl/headless_context.h"

#include <cstdio>
#include <memory>

using namespace dollytrack;

namespace {

int failWith(const Error& error) {
    std::fprintf(stderr, "plan_room: %s\n", describe(error).c_str());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return failWith({ErrorCode::Usage, "give a scene and a folder", {}});
    ImportOptions options;
    options.in_process = true;  // no other program is needed
    auto scene = importScene(argv[1], options);
    if (!scene) return failWith(scene.error());
    const auto room = std::make_shared<const Scene>(std::move(*scene));

    planning::PlanParams params;
    params.timing.max_frames = 8;
    params.camera.width_px = 160;
    params.camera.height_px = 120;
    planning::Pipeline pipeline(room);
    const auto plan = pipeline.run(params, JobContext{});
    if (!plan) return failWith(plan.error());

    auto context = gl::createHeadlessContext(gl::Backend::Auto);
    if (!context) return failWith(context.error());
    render::DatasetSettings settings;
    settings.folder = argv[2];
    settings.modalities = {"rgb", "depth"};
    settings.formats = {"tum"};
    const auto dataset =
        render::exportDataset(std::move(*context), *room, *pipeline.rays(), (*plan)->trajectory,
                              params.camera, settings, render::DatasetOrigin{});
    if (!dataset) return failWith(dataset.error());
    std::printf("%d of %d objects captured, %d frames\n", (*plan)->capture_metrics.captured,
                (*plan)->capture_metrics.objects, dataset->frames);
    return 0;
}
