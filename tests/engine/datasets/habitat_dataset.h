#pragma once

#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <filesystem>
#include <string>

namespace dollytrack::test {

/// A dataset in the layout of ReplicaCAD: configs, models and a lexicon, and one scene.
inline std::filesystem::path writeDataset(const TempFolder& folder, const std::string& instance) {
    const auto write = [&](const char* name, const std::string& text) {
        return folder.write(std::string("set/") + name, text);
    };
    static_cast<void>(write("flat.scene_dataset_config.json", R"({
 "stages": {"paths": {".json": ["configs/stages"]}},
 "objects": {"paths": {".json": ["configs/objects/*"]}, "default_attributes": {"mass": 1},
  "configs": [{"original_file": "configs/objects/sofa.object_config.json",
               "template_handle": "small_sofa", "attributes": {"scale": [0.5, 0.5, 0.5]}}]},
 "articulated_objects": {"paths": {".urdf": ["urdf/*"]}},
 "scene_instances": {"paths": {".json": ["configs/scenes"]}},
 "semantic_scene_descriptor_instances": {"words": "configs/words_semantic_lexicon.json"}})"));
    static_cast<void>(
        write("configs/words_semantic_lexicon.json",
              R"({"classes": [{"id": 5, "name": "sofa"}, {"id": 6, "name": "lamp"}]})"));
    static_cast<void>(write("configs/stages/flat.stage_config.json",
                            R"({"render_asset": "../../models/flat.obj"})"));
    ObjWriter stage(1.0, true);
    stage.room({6, 5, 2.5}, true);
    static_cast<void>(write("models/flat.obj", stage.text()));
    static_cast<void>(write("configs/objects/sofa.object_config.json",
                            R"({"render_asset": "../../models/l.obj", "semantic_id": 5})"));
    static_cast<void>(write("configs/objects/tipped.object_config.json", R"({
 "render_asset": "../../models/l.obj", "up": [0, 0, 1], "front": [0, 1, 0], "COM": [0, 0, 0]})"));
    static_cast<void>(write("models/l.obj", lShapedModel()));
    static_cast<void>(write("urdf/drawer/drawer.urdf", R"(<robot name="drawer">
 <link name="body"><visual><geometry><box size="1 2 3"/></geometry></visual></link>
 <link name="front"><visual><origin xyz="0 0 1"/><geometry><box size="1 1 1"/></geometry></visual></link>
 <joint name="rail" type="prismatic"><origin xyz="1 0 0"/><parent link="body"/><child link="front"/></joint>
</robot>)"));
    return write("configs/scenes/flat.scene_instance.json", instance);
}

}  // namespace dollytrack::test
