#include "engine/io/files/bounded_json.h"
#include "engine/io/import/scene_import.h"
#include "engine/scene/labels.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::front3d_test {
namespace {

using Eigen::Vector3d;
using test::find;
using test::imported;
using test::says;
using test::TempFolder;

std::vector<Vector3d> pointsOf(const Scene& scene, const Object& object) {
    std::vector<Vector3d> points;
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        points.push_back(scene.positions[object.first_vertex + i].cast<double>());
    }
    return points;
}

bool hasPoint(const std::vector<Vector3d>& points, const Vector3d& wanted) {
    return std::any_of(points.begin(), points.end(),
                       [&](const Vector3d& p) { return (p - wanted).norm() < 1e-4; });
}

// Computed by hand: a quarter turn about the file's y maps (x, y, z) to (z, y, -x), and the file's
// (x, y, z) is (x, -z, y) in the world.
TEST(Front3d, TurnsAModelWithoutMirroringIt) {
    const TempFolder folder;
    const Scene scene = imported(test::writeFrontHouse(folder));
    const Object* sofa = find(scene, "L-shaped Sofa");
    ASSERT_NE(sofa, nullptr);
    const std::vector<Vector3d> points = pointsOf(scene, *sofa);
    // The arm's end (1, 0, 1.5) is mapped to (1.5, 0, -1) + (2, 0, 3).
    EXPECT_TRUE(hasPoint(points, {3.5, -2.0, 0.0}));
    EXPECT_TRUE(hasPoint(points, {3.5, -2.5, 0.5}));
    EXPECT_FALSE(hasPoint(points, {3.5, -4.0, 0.0})) << "mirrored in the model's x";
    EXPECT_FALSE(hasPoint(points, {0.5, -4.0, 0.0})) << "turned the other way";
    EXPECT_TRUE(sofa->front.isApprox(Vector3d::UnitX(), 1e-6));
    EXPECT_EQ(sofa->front_source, FrontSource::Annotation);
    EXPECT_EQ(nyu40Name(sofa->nyu40), "sofa");
    EXPECT_EQ(sofa->role, Role::Target);
}

// 30 degrees about the file's x, after the scale of 2 in y.
TEST(Front3d, TiltsAModelAfterScalingIt) {
    const TempFolder folder;
    const Scene scene = imported(test::writeFrontHouse(folder));
    const Object* sofa = find(scene, "L-shaped Sofa_2");
    ASSERT_NE(sofa, nullptr);
    const double c = std::sqrt(3.0) / 2.0;
    const double s = 0.5;
    // (1, 0.5, 1.5), scaled (1, 1, 1.5), turned (1, c - 1.5 s, s + 1.5 c), moved by (4, 1, 1.5).
    EXPECT_TRUE(hasPoint(pointsOf(scene, *sofa), {5.0, -(s + 1.5 * c + 1.5), c - 1.5 * s + 1.0}));
    EXPECT_TRUE(sofa->front.isApprox(-Vector3d::UnitY(), 1e-6));
}

TEST(Front3d, FacesOfModelsLookOutwards) {
    const TempFolder folder;
    const Scene scene = imported(test::writeFrontHouse(folder));
    const Object& sofa = *find(scene, "L-shaped Sofa");
    double volume = 0.0;  // of the L, by the divergence theorem: positive if faces are outward
    for (std::uint32_t i = 0; i < sofa.triangle_count; ++i) {
        const Triangle& t = scene.triangles[sofa.first_triangle + i];
        const Vector3d a = scene.positions[t[0]].cast<double>();
        volume += a.dot(scene.positions[t[1]].cast<double>().cross(
                      scene.positions[t[2]].cast<double>())) /
                  6.0;
    }
    EXPECT_NEAR(volume, 2.0 * 0.5 * 1.0 + 0.5 * 0.5 * 1.0, 1e-4);
}

TEST(Front3d, KnowsTheBuildingFromTheFurniture) {
    const TempFolder folder;
    const Scene scene = imported(test::writeFrontHouse(folder));
    EXPECT_EQ(find(scene, "Floor")->role, Role::Structure);
    EXPECT_EQ(find(scene, "Floor")->nyu40, kNyuFloor);
    EXPECT_EQ(find(scene, "Ceiling")->nyu40, kNyuCeiling);
    const Object& wall = *find(scene, "WallInner");  // two meshes of one object
    EXPECT_EQ(wall.nyu40, kNyuWall);
    EXPECT_EQ(wall.triangle_count, 4U);
    EXPECT_NE(find(scene, "WallInner_3"), nullptr);
    EXPECT_EQ(find(scene, "WallInner_4"), nullptr);
    const Object& cabinet = *find(scene, "Cabinet");
    EXPECT_EQ(cabinet.role, Role::Target);
    EXPECT_EQ(cabinet.triangle_count, 15U) << "with its handle";
    EXPECT_EQ(find(scene, "Cabinet_2"), nullptr);
    EXPECT_TRUE(scene.room_bounds.isApprox(
        Eigen::AlignedBox3d(Vector3d(0, -5, 0), Vector3d(6, 0, 2.6)), 1e-5));
    EXPECT_EQ(scene.report.unit_m, 1.0);
    EXPECT_EQ(scene.report.up_axis, "y");
}

TEST(Front3d, ReadsColoursUvsAndNormals) {
    const TempFolder folder;
    const Scene scene = imported(test::writeFrontHouse(folder));
    const Object& floor = *find(scene, "Floor");
    const Material& paint = scene.materials[scene.triangle_material[floor.first_triangle]];
    EXPECT_NEAR(paint.base_color.x(), 1.0F, 1e-6);
    EXPECT_NEAR(paint.base_color.y(), 0.0F, 1e-6);
    EXPECT_NEAR(paint.base_color.z(), 0.21586F, 1e-4);  // sRGB 128
    // UVTransform's rows (0 2) and (-3 0) map (1, 0) to (0, -3) and (0, 1) to (2, 0).
    for (std::uint32_t i = 0; i < floor.vertex_count; ++i) {
        const Eigen::Vector3f& p = scene.positions[floor.first_vertex + i];
        const Eigen::Vector2f uv(p.x() / 6.0F, -p.y() / 5.0F);
        EXPECT_TRUE(scene.uvs[floor.first_vertex + i].isApprox(
            Eigen::Vector2f(2.0F * uv.y(), -3.0F * uv.x()), 1e-5F));
    }
    const Object& ceiling = *find(scene, "Ceiling");
    EXPECT_NEAR(std::abs(scene.normals[ceiling.first_vertex].z()), 1.0F, 1e-5);
    EXPECT_TRUE(scene.uvs[ceiling.first_vertex].isZero());
    EXPECT_TRUE(says(scene.report.notes, "1 mesh has invalid normals"));
}

TEST(Front3d, TellsByNameWhatItLeavesOut) {
    const TempFolder folder;
    const Scene scene = imported(test::writeFrontHouse(folder));
    const auto& warnings = scene.report.warnings;
    const auto& notes = scene.report.notes;
    EXPECT_TRUE(says(warnings,
                     "2 pieces of furniture have no model and were left out: pendant "
                     "lamp (jid-2), Bed (../../etc)"));
    EXPECT_TRUE(says(
        notes, "of the furniture without a model, 1 has a size, but no box is put in its place"));
    EXPECT_TRUE(says(notes,
                     "1 piece of furniture is marked as not valid and was left out: "
                     "L-shaped Sofa (jid-1)"));
    EXPECT_TRUE(says(notes,
                     "1 piece of furniture was left out because it is not marked as valid, "
                     "unlike others: Bed (jid-1)"));
    EXPECT_TRUE(says(notes, "1 room: LivingRoom-7"));
    EXPECT_TRUE(says(notes, "1 entry of the rooms names neither furniture nor mesh"));
    EXPECT_TRUE(says(warnings, "1 entry of the rooms has an invalid placement"));
    EXPECT_TRUE(says(warnings, "2 faces that name a missing vertex were dropped"));
}

TEST(Front3d, FindsModelsWhereOneSaysTheyAre) {
    const TempFolder folder;
    const auto path = test::writeFrontHouse(folder, "elsewhere");
    EXPECT_EQ(find(imported(path), "L-shaped Sofa"), nullptr);
    const Scene scene = imported(path, {.model_folders = {folder.path() / "elsewhere"}});
    EXPECT_NE(find(scene, "L-shaped Sofa"), nullptr);
    // Beside the scene's folder, as in the unpacked data set.
    static_cast<void>(folder.write("3D-FUTURE-model/jid-1/raw_model.obj", test::lShapedModel()));
    std::filesystem::create_directory(folder.path() / "houses");
    std::filesystem::rename(path, folder.path() / "houses" / "house.json");
    EXPECT_NE(find(imported(folder.path() / "houses" / "house.json"), "L-shaped Sofa"), nullptr);
}

TEST(Front3d, CategoriesComeFromModelInfo) {
    const TempFolder folder;
    const auto path = test::writeFrontHouse(folder);
    static_cast<void>(folder.write(
        "model_info.json",
        R"([{"model_id":"jid-1","category":"King-size Bed","super-category":"Bed"}])"));
    EXPECT_EQ(nyu40Name(find(imported(path), "King-size Bed")->nyu40), "bed");
    static_cast<void>(folder.write(
        "model_info.json", R"({"jid-1":{"category_id":"e7a0801e-7abd-4634-b3bc-8777342d124e"}})"));
    // The number is used last, because the scene's word is known.
    EXPECT_EQ(nyu40Name(find(imported(path), "L-shaped Sofa")->nyu40), "sofa");
    static_cast<void>(folder.write("model_info.json", "[[["));
    EXPECT_TRUE(
        says(imported(path).report.warnings, "the categories of the furniture were not read"));
}

TEST(Front3d, PaintsModelsWithThePictureBesideThem) {
    const TempFolder folder;
    const auto path = test::writeFrontHouse(folder);
    EXPECT_EQ(imported(path).report.textures_found, 0);
    // A PPM image of 1 x 1 pixel: its format is detected by bytes, not by name.
    static_cast<void>(
        folder.write("3D-FUTURE-model/jid-1/texture.png", "P6\n1 1\n255\n\x10\x20\x30"));
    const Scene scene = imported(path);
    EXPECT_EQ(scene.report.textures_found, 1) << "once for both sofas";
    const Object& sofa = *find(scene, "L-shaped Sofa");
    EXPECT_GE(scene.materials[scene.triangle_material[sofa.first_triangle]].texture, 0);
}

TEST(Front3d, TexturesOfTheBuildingAreFoundByUrl) {
    const TempFolder folder;
    const std::string house = R"({"uid":"h","mesh":[{"uid":"a","type":"Floor","material":"m",
        "xyz":[0,0,0,4,0,0,4,0,4],"normal":[],"uv":[0,0,1,0,1,1],"faces":[0,2,1]}],"material":[
        {"uid":"m","jid":"x","texture":"https://host/i/pic-1/wallfloor.jpg","color":[1,2,3,255]}]})";
    const auto path = folder.write("house.json", house);
    const std::string picture = "P6\n1 1\n255\n\x10\x20\x30";
    static_cast<void>(folder.write("3D-FRONT-texture/pic-2/texture.png", picture));
    const Scene missing = imported(path);
    EXPECT_EQ(missing.report.textures_missing.size(), 1U) << "that picture is another material's";
    static_cast<void>(folder.write("3D-FRONT-texture/pic-1/texture.png", picture));
    const Scene scene = imported(path);
    EXPECT_EQ(scene.report.textures_found, 1);
    EXPECT_TRUE(scene.materials[0].base_color.isOnes());
    // Rooms are missing; the building alone is also a scene.
    EXPECT_EQ(scene.objects.size(), 1U);
}

TEST(Front3d, RefusesWhatIsNoSceneInOneSentence) {
    const TempFolder folder;
    const auto messageOf = [&](const std::string& text) {
        const Result<Scene> scene = importScene(folder.write("bad.json", text));
        if (scene) return std::string("read");
        EXPECT_EQ(scene.error().code, ErrorCode::BadInput);
        return scene.error().message;
    };
    EXPECT_NE(messageOf(R"({"scene":3})").find("not a 3D-FRONT scene"), std::string::npos);
    EXPECT_NE(messageOf(R"({"mesh":[{)").find("not valid JSON"), std::string::npos);
    EXPECT_NE(messageOf(R"({"shopping":["milk"]})").find("JSON is not a supported scene"),
              std::string::npos);
    EXPECT_NE(messageOf(R"({"mesh":[3]})").find("nothing that can be drawn"), std::string::npos);
    const std::string deep = R"({"mesh":)" + std::string(1'000'000, '[');
    EXPECT_NE(messageOf(deep).find("nested more than 64 levels deep"), std::string::npos);
}

TEST(BoundedJson, CountsBracketsOutsideOfTextsOnly) {
    const std::string brackets(1000, '[');
    EXPECT_TRUE(parseBoundedJson(R"({"a":")" + brackets + R"(\"[[["})", "text"));
    EXPECT_FALSE(parseBoundedJson(std::string(65, '[') + std::string(65, ']'), "text"));
    EXPECT_TRUE(parseBoundedJson(std::string(64, '[') + std::string(64, ']'), "text"));
    // 80 MB of text would need more than 2 GiB as values.
    std::string many = "[";
    many.reserve(110'000'000);
    while (many.size() < 105'000'000) many += "[],";
    const auto refused = parseBoundedJson(many + "0]", "text");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("too many values"), std::string::npos);
    EXPECT_EQ(numberIn(nlohmann::json("0.25")), 0.25);
    EXPECT_EQ(numberIn(nlohmann::json("0.25x")), std::nullopt);
    EXPECT_EQ(numberIn(nlohmann::json("1e999")), std::nullopt);
    EXPECT_EQ(numberIn(nlohmann::json(nullptr)), std::nullopt);
}

}  // namespace
}  // namespace dollytrack::front3d_test
