#pragma once

#include "tests/support/temp_folder.h"

#include <filesystem>
#include <string>

namespace dollytrack::test {

/// An L in plan, y up, origin on the floor: 2 x 0.5 x 1, with an arm at +x towards +z. It has no
/// symmetry.
inline std::string lShapedModel() {
    const auto box = [](int first, double x0, double x1, double z0, double z1) {
        std::string text;
        for (const double y : {0.0, 0.5}) {
            for (const double z : {z0, z1}) {
                for (const double x : {x0, x1}) {
                    text += "v " + std::to_string(x) + " " + std::to_string(y) + " " +
                            std::to_string(z) + "\n";
                }
            }
        }
        for (const auto& face :
             {"1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"}) {
            text += "f";
            for (const char* c = face; *c != '\0'; c += c[1] == '\0' ? 1 : 2) {
                text += ' ';
                text += std::to_string(*c - '0' + first);
            }
            text += "\n";
        }
        return text;
    };
    return std::string("o model\n") + box(0, -1.0, 1.0, -0.5, 0.5) + box(8, 0.5, 1.0, 0.5, 1.5);
}

/// A 3D-FRONT house of one room, 6 x 2.6 x 5 m, with a built-in wardrobe, three sofas (one rotated
/// by 90 degrees, one tilted by 30, one not valid) and a lamp without a model. The sofas' model is
/// in `models`/jid-1. Numbers are strings, uvs are null, an instanceid is missing.
inline std::filesystem::path writeFrontHouse(const TempFolder& folder,
                                             const std::string& models = "3D-FUTURE-model") {
    static_cast<void>(folder.write(models + "/jid-1/raw_model.obj", lShapedModel()));
    return folder.write("house.json", R"({"uid":"house","north_vector":[0,0,-1],
"furniture":[
 {"uid":"1/model","jid":"jid-1","category":"L-shaped Sofa","valid":true},
 {"uid":"2/model","jid":"jid-1","category":"L-shaped Sofa","valid":false},
 {"uid":"3/model","jid":"jid-2","category":"Pendant Lamp","title":"lamp/pendant lamp","valid":true,
  "size":[0.3,0.4,0.3],"bbox":[0.3,0.4,0.3]},
 {"uid":"4/model","jid":"../../etc","category":"Bed","valid":true},
 {"uid":"5/model","jid":"jid-1","category":"Bed"}],
"mesh":[
 {"uid":"m/0","jid":"","type":"Floor","material":"paint","xyz":[0,0,0, 6,0,0, 6,0,5, 0,0,5],
  "normal":[0,1,0, 0,1,0, 0,1,0, 0,1,0],"uv":[0,0, 1,0, 1,1, 0,1],"faces":[0,2,1, 0,3,2]},
 {"uid":"m/1","jid":"","type":"Ceiling","material":"paint","xyz":[0,2.6,0, 6,2.6,0, 6,2.6,5, 0,2.6,5],
  "normal":[5,1,9, 5,1,9, 5,1,9, 5,1,9],"uv":[null,null,null,null,null,null,null,null],
  "faces":[0,1,2, 0,2,3]},
 {"uid":"w/1","jid":"","type":"WallInner","material":"?","xyz":["0","0","0","0","2.6","0","0","2.6","5","0","0","5"],
  "normal":[],"uv":[],"faces":["0","1","2","0","2","3"]},
 {"uid":"w/2","jid":"","type":"WallInner","material":"?","xyz":[6,0,0, 6,0,5, 6,2.6,5, 6,2.6,0],
  "normal":[],"uv":[],"faces":[0,1,2, 0,2,3, 0,1,77, 0,-1,2]},
 {"uid":"w2/1","jid":"","type":"WallInner","material":"?","xyz":[0,0,0, 6,0,0, 6,2.6,0, 0,2.6,0],
  "normal":[],"uv":[],"faces":[0,1,2, 0,2,3]},
 {"uid":"w3/1","jid":"","type":"WallInner","material":"?","xyz":[0,0,5, 0,2.6,5, 6,2.6,5, 6,0,5],
  "normal":[],"uv":[],"faces":[0,1,2, 0,2,3]},
 {"uid":"body","jid":"","type":"Cabinet","material":"paint",
  "xyz":[5,0,0, 6,0,0, 6,2,0, 5,2,0, 5,0,0.5, 6,0,0.5, 6,2,0.5, 5,2,0.5],
  "normal":[],"uv":[],"faces":[0,3,2, 0,2,1, 4,5,6, 4,6,7, 0,4,7, 0,7,3, 1,2,6, 1,6,5, 3,7,6, 3,6,2]},
 {"uid":"handle","jid":"","type":"Cabinet","material":"paint",
  "xyz":[5.4,1,0.5, 5.5,1,0.5, 5.5,1.1,0.5, 5.4,1,0.53, 5.5,1,0.53, 5.5,1.1,0.53],
  "normal":[],"uv":[],"faces":[3,4,5, 0,3,5, 0,5,2, 0,1,4, 0,4,3]}],
"material":[{"uid":"paint","jid":"local","texture":"","color":[255,0,"128",255],
  "UVTransform":[0,2,0, -3,0,0, 0,0,1]}],
"scene":{"ref":"-1","pos":[0,0,0],"rot":[0,0,0,1],"scale":[1,1,1],"room":[
 {"type":"LivingRoom","instanceid":"LivingRoom-7","pos":[0,0,0],"rot":[0,0,0,1],"scale":[1,1,1],"children":[
  {"ref":"1/model","pos":[2,0,3],"rot":[0,0.70710678,0,0.70710678],"scale":[1,1,1]},
  {"ref":"1/model","instanceid":"furniture/2","pos":["4","1","1.5"],
   "rot":[0.25881905,0,0,0.96592583],"scale":[1,2,1]},
  {"ref":"2/model","instanceid":"furniture/3","pos":[1,0,1],"rot":[0,0,0,1],"scale":[1,1,1]},
  {"ref":"3/model","instanceid":"furniture/4","pos":[1,2,1],"rot":[0,0,0,1],"scale":[1,1,1]},
  {"ref":"4/model","instanceid":"furniture/5","pos":[1,2,1],"rot":[0,0,0,1],"scale":[1,1,1]},
  {"ref":"5/model","instanceid":"furniture/6","pos":[1,2,1],"rot":[0,0,0,1],"scale":[1,1,1]},
  {"ref":"9/model","instanceid":"furniture/7","pos":[1,2,1],"rot":[0,0,0,1],"scale":[1,1,1]},
  {"ref":"1/model","instanceid":"furniture/8","pos":[1,"far",1],"rot":[0,0,0,1],"scale":[1,1,1]},
  {"ref":"m/0","instanceid":"mesh/1","pos":[0,0,0],"rot":[0,0,0,1],"scale":[1,1,1]}]}]}})");
}

/// A scene in the format of SceneNet's trajectory generator: a layout and two pianos.
inline std::string sceneNetText() {
    return R"(layout_file: ./office/office1_layout.obj
object
03928116/aaa
wnid
03928116
scale
1.6
transformation
1.000 0.000 0.000 1.0
0.000 1.000 0.000 0.5
0.000 0.000 1.000 2.0
object
03928116/aaa
wnid
03928116
scale
0.8
transformation
0.000 0.000 1.000 3.0
0.000 1.000 0.000 0.0
-1.000 0.000 0.000 2.0
end
lighting
PointLight 1.5 1 1 1 1.0 2.0 1.0 0.03
#first three elements, eye and last three, lookAt
0 1 1 1 2 2 2
0 1 1 1 2 2 2
)";
}

}  // namespace dollytrack::test
