#include "engine/io/datasets/hypersim_annotations.h"
#include "engine/io/hdf5/hdf5_writer.h"
#include "engine/io/import/scene_import.h"
#include "engine/scene/labels.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace dollytrack::hypersim_test {
namespace {

using Eigen::Vector3d;
using test::find;
using test::says;
using test::TempFolder;

constexpr double kInch_m = 0.0254;

/// A room 5 x 4 x 2.5 m in inches, z up; a bed of two meshes, and a thing that nobody labelled.
std::string room() {
    test::ObjWriter obj(1.0 / kInch_m, false);
    obj.object("Plane001").box({0, 0, -0.1}, {5, 4, 0});
    obj.object("Box001").box({0, 4, 0}, {5, 4.1, 2.5});
    obj.object("Line001").box({1, 1, 0}, {3, 2.6, 0.3});
    obj.object("Line002").box({1, 1, 0.3}, {3, 2.6, 0.6});
    obj.object("thing").box({4, 1, 0}, {4.2, 1.2, 0.2});
    obj.object("added later").box({4, 2, 0}, {4.2, 2.2, 0.2});
    return obj.text();
}

void writeNumbers(const TempFolder& folder, const std::string& name,
                  const std::vector<float>& values, const std::vector<std::uint64_t>& shape) {
    const auto bytes = packHdf5({{"dataset", Hdf5Type::Float32, shape, values.data()}}, {});
    ASSERT_TRUE(bytes);
    static_cast<void>(
        folder.write(name, {reinterpret_cast<const char*>(bytes->data()), bytes->size()}));
}

/// Plane001 floor; Box001 wall; Line001 and Line002 instance 2, a bed; thing nothing.
void writeDetail(const TempFolder& folder, float box_width_m = 2.0F) {
    static_cast<void>(
        folder.write("_detail/metadata_scene.csv",
                     "parameter_name,parameter_value\nmeters_per_asset_unit,0.0254\n"));
    static_cast<void>(
        folder.write("_detail/metadata_cameras.csv", "camera_name\ncam_00\ncam_01\n"));
    static_cast<void>(
        folder.write("_detail/mesh/metadata_objects.csv",
                     "object_name\r\nBox001\r\nPlane001\r\nLine001\r\nLine002\r\nthing\r\n"));
    writeNumbers(folder, "_detail/mesh/mesh_objects_si.hdf5", {1, 2, 4, 4, -1}, {5, 1});
    writeNumbers(folder, "_detail/mesh/mesh_objects_sii.hdf5", {-1, -1, 2, 2, -1}, {5, 1});
    const std::string box =
        "_detail/mesh/metadata_semantic_instance_bounding_box_object_aligned_2d_";
    const auto inch = [](double metres) { return static_cast<float>(metres / kInch_m); };
    writeNumbers(folder, box + "extents.hdf5",
                 {0, 0, 0, 0, 0, 0, inch(1.6), inch(box_width_m), inch(0.6)}, {3, 3});
    writeNumbers(folder, box + "positions.hdf5",
                 {0, 0, 0, 0, 0, 0, inch(2.0), inch(1.8), inch(0.3)}, {3, 3});
    writeNumbers(folder, box + "orientations.hdf5",
                 std::vector<float>({1, 0, 0, 0, 1, 0,  0, 0, 1, 1, 0, 0, 0, 1,
                                     0, 0, 0, 1, 0, -1, 0, 1, 0, 0, 0, 0, 1}),
                 {3, 3, 3});
}

void expectLabelled(const Scene& scene) {
    EXPECT_EQ(scene.objects.size(), 5U);
    const Object* bed = find(scene, "Line001");
    ASSERT_NE(bed, nullptr);
    EXPECT_EQ(nyu40Name(bed->nyu40), "bed");
    EXPECT_EQ(bed->triangle_count, 24U);
    EXPECT_TRUE(bed->box.center.isApprox(Vector3d(2.0, 1.8, 0.3), 1e-5));
    EXPECT_TRUE(bed->box.half_size.isApprox(Vector3d(1.0, 0.8, 0.3), 1e-5));
    EXPECT_EQ(find(scene, "Line002"), nullptr);
    EXPECT_EQ(find(scene, "Plane001")->nyu40, kNyuFloor);
    EXPECT_EQ(find(scene, "Box001")->role, Role::Structure);
    EXPECT_EQ(find(scene, "thing")->role, Role::Target);
    EXPECT_EQ(scene.report.unit_m, kInch_m);
    EXPECT_EQ(scene.report.up_axis, "z");
}

TEST(Hypersim, LabelsAnObjFileBesideItsDetail) {
    const TempFolder folder;
    writeDetail(folder);
    const Result<Scene> scene = importScene(folder.write("scene.obj", room()));
    ASSERT_TRUE(scene) << describe(scene.error());
    expectLabelled(*scene);
    EXPECT_TRUE(
        says(scene->report.notes, "5 of 5 meshes that the Hypersim annotations list are in"));
    EXPECT_TRUE(says(scene->report.notes,
                     "annotated boxes that agree with the measured ones to 2 cm or 2 %: 1 of 1"));
    EXPECT_TRUE(says(scene->report.warnings, "1 mesh has no Hypersim annotation"));
}

TEST(Hypersim, AnnotationsCanBeElsewhere) {
    const TempFolder folder;
    writeDetail(folder);
    const TempFolder other;
    const auto path = other.write("scene.obj", room());
    const Result<Scene> plain = importScene(path);
    ASSERT_TRUE(plain);
    EXPECT_NE(find(*plain, "Line002"), nullptr);
    for (const char* name : {"", "_detail", "_detail/mesh"}) {
        const Result<Scene> scene = importScene(path, {.annotations = folder.path() / name});
        ASSERT_TRUE(scene) << describe(scene.error());
        expectLabelled(*scene);
    }
    const Result<Scene> wrong = importScene(path, {.annotations = other.path()});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().where, other.path().string());
}

TEST(Hypersim, TellsBoxesThatDiffer) {
    const TempFolder folder;
    writeDetail(folder, 2.3F);
    const Result<Scene> scene = importScene(folder.write("scene.obj", room()));
    ASSERT_TRUE(scene);
    EXPECT_TRUE(says(scene->report.notes,
                     "annotated boxes that agree with the measured ones to 2 cm or 2 %: 0 of 1; "
                     "different: Line001 "
                     "by 0.3 m"));
}

TEST(Hypersim, AnotherScenesAnnotationsAreLeftOut) {
    const TempFolder folder;
    writeDetail(folder);
    static_cast<void>(
        folder.write("_detail/mesh/metadata_objects.csv", "object_name\na\nb\nc\nd\ne\n"));
    const Result<Scene> scene = importScene(folder.write("scene.obj", room()));
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->objects.size(), 6U);
    EXPECT_TRUE(says(scene->report.warnings, "none of the meshes that the annotations"));
}

TEST(Hypersim, AFolderWithoutGeometrySaysWhatItHas) {
    const TempFolder folder;
    writeDetail(folder);
    const Result<Scene> scene = importScene(folder.path());
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::Usage);
    EXPECT_NE(scene.error().message.find(
                  "annotations for 5 meshes (3 classes of NYU40, 1 instance), 2 cameras "
                  "(cam_00, cam_01) and a unit of 0.0254 m, but no geometry"),
              std::string::npos)
        << scene.error().message;
    const TempFolder empty;
    EXPECT_TRUE(describeHypersimFolder(empty.path()).empty());
}

TEST(Hypersim, RefusesAnnotationsThatDoNotGoTogether) {
    const TempFolder folder;
    writeDetail(folder);
    const auto path = folder.write("scene.obj", room());
    writeNumbers(folder, "_detail/mesh/mesh_objects_si.hdf5", {1, 2, 4}, {3, 1});
    const Result<Scene> scene = importScene(path);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::BadInput);
    EXPECT_NE(scene.error().message.find("3 values for the 5 objects"), std::string::npos);
    writeDetail(folder);
    static_cast<void>(folder.write("_detail/mesh/mesh_objects_sii.hdf5", "no HDF5"));
    EXPECT_FALSE(importScene(path));
    writeDetail(folder);
    static_cast<void>(folder.write("_detail/metadata_scene.csv", "a,b\nmeters_per_asset_unit,0\n"));
    EXPECT_FALSE(importScene(path));
}

}  // namespace
}  // namespace dollytrack::hypersim_test
