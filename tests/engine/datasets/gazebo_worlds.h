#pragma once

#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/temp_folder.h"

#include <fmt/format.h>

#include <string>

namespace dollytrack::test {

/// A model "sofa" in the layout of Gazebo's: model.config, model.sdf and a mesh, the L.
inline void writeSofa(const TempFolder& folder, const std::string& models) {
    static_cast<void>(folder.write(models + "/sofa/model.config",
                                   "<model><name>sofa</name><sdf version='1.4'>old.sdf</sdf>"
                                   "<sdf version='1.6'>model.sdf</sdf></model>"));
    static_cast<void>(folder.write(models + "/sofa/meshes/l.obj", lShapedModel()));
    static_cast<void>(
        folder.write(models + "/sofa/model.sdf", R"(<sdf version="1.6"><model name="sofa">
 <pose>0 0 10 0 0 0</pose>
 <link name="link"><pose>0 0 1 0 0 0</pose>
  <visual name="v"><geometry><mesh><uri>model://sofa/meshes/l.obj</uri><scale>1 2 1</scale></mesh></geometry></visual>
  <collision name="c"><geometry><box><size>9 9 9</size></box></geometry></collision>
 </link></model></sdf>)"));
}

inline std::string world(const std::string& models) {
    return "<?xml version='1.0'?><sdf version='1.7'><world name='w'>" + models + "</world></sdf>";
}

inline constexpr const char* kBall =
    "<visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual>";

/// A visual of a mesh, with elements besides its geometry.
inline std::string meshVisual(const std::string& uri, const std::string& others = "") {
    return "<visual name='v'><geometry><mesh><uri>" + uri + "</uri></mesh></geometry>" + others +
           "</visual>";
}

/// A model with one link, at x = `x`.
inline std::string modelAt(double x, const std::string& name, const std::string& visuals) {
    return fmt::format("<model name='{}'><pose>{} 0 0 0 0 0</pose><link name='l'>{}</link></model>",
                       name, x, visuals);
}

}  // namespace dollytrack::test
