#include "engine/io/import/scene_import.h"
#include "engine/io/orientation/frame_evidence.h"
#include "engine/io/orientation/up_axis_scores.h"
#include "engine/io/settings/import_settings.h"
#include "engine/math/up_axis.h"
#include "tests/support/imported_scene.h"
#include "tests/support/scene_builder.h"
#include "tests/support/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace dollytrack::frame_guess_test {
namespace {

using test::find;
using test::imported;
using test::TempFolder;

struct NamedBox {
    std::string name;
    Eigen::Vector3d low;
    Eigen::Vector3d high;
};

/// A living room of 5 x 4 x 2.6 m, z up, with objects on the floor, on the table and on nothing.
std::vector<NamedBox> livingRoom(bool named) {
    std::vector<NamedBox> boxes = {{"floor", {0, 0, -0.1}, {5, 4, 0}},
                                   {"ceiling", {0, 0, 2.6}, {5, 4, 2.7}},
                                   {"wall_1", {-0.1, 0, 0}, {0, 4, 2.6}},
                                   {"wall_2", {5, 0, 0}, {5.1, 4, 2.6}},
                                   {"wall_3", {0, -0.1, 0}, {5, 0, 2.6}},
                                   {"wall_4", {0, 4, 0}, {5, 4.1, 2.6}},
                                   {"table", {1.8, 1.5, 0}, {3.2, 2.3, 0.74}},
                                   {"mug", {2.0, 1.7, 0.74}, {2.09, 1.79, 0.84}},
                                   {"book", {2.5, 1.8, 0.74}, {2.72, 1.96, 0.78}},
                                   {"chair", {1.2, 1.6, 0}, {1.65, 2.05, 0.9}},
                                   {"sofa", {0.2, 3.0, 0}, {2.2, 3.8, 0.8}},
                                   {"bookshelf", {4.6, 0.5, 0}, {4.9, 1.5, 2.0}},
                                   {"picture", {1.5, 0.0, 1.3}, {2.1, 0.02, 1.7}}};
    if (!named) {
        for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].name = fmt::format("aa{}", i);
    }
    return boxes;
}

constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                              {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

Eigen::Vector3d cornerOf(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int i) {
    return {(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()};
}

/// OBJ text with the file axis `up` as the room's z, and `scale` units per metre.
std::string asObj(const std::vector<NamedBox>& boxes, UpAxis up, double scale = 1.0) {
    const Eigen::Matrix3d file_from_room = scale * up.zUpFromSource().transpose();
    std::string text;
    int count = 0;
    for (const NamedBox& box : boxes) {
        text += "o " + box.name + "\n";
        for (int i = 0; i < 8; ++i) {
            const Eigen::Vector3d p = file_from_room * cornerOf(box.low, box.high, i);
            text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
        }
        for (const auto& face : kFaces) {
            text += "f";
            for (const int i : face) text += fmt::format(" {}", count + i + 1);
            text += "\n";
        }
        count += 8;
    }
    return text;
}

/// The same as glTF with its standard y up, and a root node that rotates and scales everything.
std::string asGltf(const std::vector<NamedBox>& boxes, UpAxis up, double scale,
                   const TempFolder& folder) {
    std::string bytes;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3f p =
            cornerOf(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), i).cast<float>();
        bytes.append(reinterpret_cast<const char*>(p.data()), sizeof(p));
    }
    for (const auto& f : kFaces) {
        for (const int i : {f[0], f[1], f[2], f[0], f[2], f[3]}) {
            const auto index = static_cast<std::uint16_t>(i);
            bytes.append(reinterpret_cast<const char*>(&index), sizeof(index));
        }
    }
    static_cast<void>(folder.write("cube.bin", bytes));
    Eigen::Matrix4d root = Eigen::Matrix4d::Identity();
    root.topLeftCorner<3, 3>() = scale * up.zUpFromSource().transpose();
    nlohmann::json nodes = {
        {{"name", "root"}, {"matrix", std::vector<double>(root.data(), root.data() + 16)}}};
    for (const NamedBox& box : boxes) {
        const Eigen::Vector3d size = box.high - box.low;
        nodes[0]["children"].push_back(nodes.size());
        nodes.push_back({{"name", box.name},
                         {"mesh", 0},
                         {"translation", {box.low.x(), box.low.y(), box.low.z()}},
                         {"scale", {size.x(), size.y(), size.z()}}});
    }
    return nlohmann::json{
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", nodes},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
        {"buffers", {{{"byteLength", bytes.size()}, {"uri", "cube.bin"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 96}},
          {{"buffer", 0}, {"byteOffset", 96}, {"byteLength", 72}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", 8},
           {"type", "VEC3"},
           {"min", {0, 0, 0}},
           {"max", {1, 1, 1}}},
          {{"bufferView", 1}, {"componentType", 5123}, {"count", 36}, {"type", "SCALAR"}}}}}
        .dump();
}

/// The same as glTF with all boxes in one mesh, as in scans and optimized files.
std::string asMergedGltf(const std::vector<NamedBox>& boxes, UpAxis up, const TempFolder& folder) {
    const Eigen::Matrix3d turn = up.zUpFromSource().transpose();
    std::string points;
    std::string indices;
    Eigen::AlignedBox3f bounds;
    int first = 0;
    for (const NamedBox& box : boxes) {
        for (int i = 0; i < 8; ++i) {
            const Eigen::Vector3f p = (turn * cornerOf(box.low, box.high, i)).cast<float>();
            bounds.extend(p);
            points.append(reinterpret_cast<const char*>(p.data()), sizeof(p));
        }
        for (const auto& f : kFaces) {
            for (const int i : {f[0], f[1], f[2], f[0], f[2], f[3]}) {
                const auto index = static_cast<std::uint16_t>(first + i);
                indices.append(reinterpret_cast<const char*>(&index), sizeof(index));
            }
        }
        first += 8;
    }
    static_cast<void>(folder.write("room.bin", points + indices));
    return nlohmann::json{
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"name", "all"}, {"mesh", 0}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
        {"buffers", {{{"byteLength", points.size() + indices.size()}, {"uri", "room.bin"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", points.size()}},
          {{"buffer", 0}, {"byteOffset", points.size()}, {"byteLength", indices.size()}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", first},
           {"type", "VEC3"},
           {"min", {bounds.min().x(), bounds.min().y(), bounds.min().z()}},
           {"max", {bounds.max().x(), bounds.max().y(), bounds.max().z()}}},
          {{"bufferView", 1},
           {"componentType", 5123},
           {"count", indices.size() / 2},
           {"type", "SCALAR"}}}}}
        .dump();
}

std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    return all;
}

const std::vector<UpAxis> kAllAxes = {{'x'}, {'y'}, {'z'}, {'x', true}, {'y', true}, {'z', true}};

TEST(UpAxis, IsReadAsItIsWritten) {
    for (const UpAxis axis : kAllAxes) {
        EXPECT_EQ(parseUpAxis(axis.text()), axis) << axis.text();
        const Eigen::Matrix3d turn = axis.zUpFromSource();
        EXPECT_TRUE((turn * axis.direction()).isApprox(Eigen::Vector3d::UnitZ())) << axis.text();
        EXPECT_NEAR(turn.determinant(), 1.0, 1e-12) << axis.text();
    }
    EXPECT_EQ(parseUpAxis("+Z"), UpAxis('z'));
    for (const char* wrong : {"", "-", "w", "--y", "-yy", "yz", "y-"}) {
        EXPECT_EQ(parseUpAxis(wrong), std::nullopt) << wrong;
    }
}

// An axis set by the user is saved in the project file and loaded.
TEST(UpAxis, StandsInImportSettings) {
    ImportOptions options;
    options.up_axis = UpAxis('y', true);
    const nlohmann::json stored = importOptionsToJson(options);
    EXPECT_EQ(stored["up_axis"], "-y");
    const auto read = importOptionsFromJson(stored);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(read->up_axis, options.up_axis);
    const auto wrong = importOptionsFromJson({{"up_axis", "down"}});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().code, ErrorCode::BadInput);
}

// Objects resting on others determine the up axis if the format does not, with names and without.
TEST(FrameGuess, FindsAnyOfTheSixAxes) {
    const TempFolder folder;
    for (const bool named : {true, false}) {
        for (const UpAxis axis : kAllAxes) {
            const Scene scene = imported(folder.write("room.obj", asObj(livingRoom(named), axis)));
            EXPECT_EQ(scene.report.up_axis, axis.text()) << named;
            EXPECT_EQ(scene.report.unit_m, 1.0);
            if (axis.negative) {
                EXPECT_NE(joined(scene.report.warnings).find("--up"), std::string::npos)
                    << axis.text();
            }
            if (!named) continue;
            EXPECT_NEAR(find(scene, "sofa")->box.center.z(), 0.4, 1e-5) << axis.text();
            EXPECT_NEAR(find(scene, "mug")->box.center.z(), 0.79, 1e-5) << axis.text();
        }
    }
}

TEST(FrameGuess, TakesAnyOfTheSixAxesAsGiven) {
    const TempFolder folder;
    for (const UpAxis axis : kAllAxes) {
        const Scene scene = imported(folder.write("room.obj", asObj(livingRoom(false), axis)),
                                     {.unit_m = 1.0, .up_axis = axis});
        EXPECT_NEAR(scene.room_bounds.min().z(), -0.1, 1e-5) << axis.text();
        EXPECT_NEAR(scene.room_bounds.max().z(), 2.7, 1e-5) << axis.text();
        EXPECT_TRUE(scene.report.proposal.isEmpty());
    }
}

// Annotations beside a scene may give a negative axis.
TEST(FrameGuess, TakesANegativeAxisFromAnnotations) {
    const TempFolder folder;
    static_cast<void>(
        folder.write("room.obj.objects.json",
                     R"({"format": "dollytrack-objects", "version": 1, "up_axis": "-z"})"));
    const Scene scene =
        imported(folder.write("room.obj", asObj(livingRoom(true), UpAxis('z', true))));
    EXPECT_EQ(scene.report.up_axis, "-z");
    EXPECT_EQ(scene.report.up_source, "given");
}

// glTF has y up by its standard, but a root node can rotate everything.
TEST(FrameGuess, DoubtsTheAxisOfAFileWhereGravityContradictsIt) {
    const TempFolder folder;
    for (const UpAxis axis : kAllAxes) {
        const Scene scene =
            imported(folder.write("room.gltf", asGltf(livingRoom(true), axis, 1.0, folder)));
        const std::string warnings = joined(scene.report.warnings);
        if (axis == UpAxis('y')) {
            EXPECT_EQ(scene.report.up_source, "file");
            EXPECT_EQ(warnings.find("is up"), std::string::npos) << warnings;
            continue;
        }
        EXPECT_NE(warnings.find("the file says y is up"), std::string::npos) << axis.text();
        EXPECT_NE(warnings.find("--up"), std::string::npos) << warnings;
        EXPECT_EQ(scene.report.up_axis, axis.text()) << warnings;
        EXPECT_NEAR(find(scene, "sofa")->box.center.z(), 0.4, 1e-4) << axis.text();
    }
}

// The beams below a ceiling rest on it if the hall is turned over; many equal ones are no more
// evidence than one.
TEST(FrameGuess, EqualThingsCountOnce) {
    const TempFolder folder;
    for (const bool equal : {true, false}) {
        std::vector<NamedBox> hall = {
            {"aa1", {0, 0, -0.1}, {16, 12, 0}},  {"aa2", {0, 0, 5}, {16, 12, 5.1}},
            {"aa3", {-0.1, 0, 0}, {0, 12, 5}},   {"aa4", {16, 0, 0}, {16.1, 12, 5}},
            {"aa5", {1, 10, 0}, {2, 11, 0.8}},   {"aa6", {4, 10, 0}, {4.5, 11, 0.5}},
            {"aa7", {7, 10, 0}, {8, 10.5, 1.2}}, {"aa8", {12, 10, 0}, {12.4, 11, 1.5}}};
        for (int i = 0; i < 24; ++i) {
            const double x = 0.5 + 2.5 * (i % 6);
            const double y = 0.5 + 2.3 * (i / 6);
            const double length = equal ? 1.8 : 0.4 + 0.06 * i;
            hall.push_back({"beam_" + std::to_string(i), {x, y, 4.2}, {x + 0.6, y + length, 5}});
        }
        const Scene scene = imported(folder.write("hall.gltf", asGltf(hall, 'y', 1.0, folder)));
        const std::vector<UpEvidence> scores = scoreUpAxes(collectEvidence(scene, true));
        const auto turned = std::ranges::find(scores, UpAxis('z', true), &UpEvidence::axis);
        EXPECT_EQ(turned->support > 0.5, !equal) << turned->support;
    }
}

TEST(FrameGuess, LightsMayHang) {
    RawScene raw;
    raw.nodes = {{"file", -1, 0}};
    raw.materials.resize(2);
    raw.materials[1].emission = {1.0F, 1.0F, 0.8F};
    std::vector<ObjectDraft> drafts;
    const auto add = [&](std::uint32_t material) {
        MeshPart part;
        part.material = material;
        part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
        part.triangles = {{0, 1, 2}};
        drafts.emplace_back().parts = {raw.parts.size()};
        raw.parts.push_back(part);
    };
    const auto shining = [&] {
        std::vector<bool> shines;
        for (const MeasuredObject& object : collectEvidence(raw, drafts).objects) {
            shines.push_back(object.shines);
        }
        return shines;
    };
    add(0);
    add(1);
    EXPECT_EQ(shining(), std::vector<bool>({false, true}));
    add(1);
    EXPECT_EQ(shining(), std::vector<bool>({false, false, false})) << "most objects shine";
}

// What hangs below a ceiling is no evidence if it is a light.
TEST(FrameGuess, LightsAreNoEvidenceOfTheAxis) {
    const auto supportIfTurned = [](bool lights) {
        test::SceneBuilder builder;
        builder.room({0, 0, 0}, {6, 6, 3});
        for (int i = 0; i < 12; ++i) {
            builder.object("hanging" + std::to_string(i))
                .box({0.5 + 0.45 * i, 3, 2.9 - 0.01 * i}, {0.3, 0.4, 0.2 + 0.02 * i});
        }
        for (int i = 0; i < 14; ++i) {
            builder.object("standing" + std::to_string(i))
                .box({0.5 + 0.4 * i, 1, 0.2 + 0.02 * i}, {0.3, 0.4, 0.4 + 0.04 * i});
        }
        Scene scene = builder.build();
        for (const Object& object : scene.objects) {
            if (!lights || !object.name.starts_with("hanging")) continue;
            scene.materials[scene.triangle_material[object.first_triangle]].emission.setOnes();
        }
        const std::vector<UpEvidence> scores = scoreUpAxes(collectEvidence(scene, false));
        return std::ranges::find(scores, UpAxis('z', true), &UpEvidence::axis)->support;
    };
    EXPECT_GT(supportIfTurned(false), 0.1);
    EXPECT_LT(supportIfTurned(true), 0.0);
}

// Panels of walls look the same upside down, so the file is believed, and the report says that
// nothing confirms it.
TEST(FrameGuess, SaysWhenNothingConfirmsTheAxisOfAFile) {
    const TempFolder folder;
    std::vector<NamedBox> panels;
    for (int i = 0; i < 4; ++i) {
        const double begin = i;
        const double end = begin + 0.98;
        for (const double side : {0.0, 4.0}) {
            panels.push_back(
                {fmt::format("a{}_{}", i, side), {begin, side, 0}, {end, side + 0.02, 2.6}});
            panels.push_back(
                {fmt::format("b{}_{}", i, side), {side, begin, 0}, {side + 0.02, end, 2.6}});
        }
    }
    for (const UpAxis axis : {UpAxis('y'), UpAxis('y', true)}) {
        const Scene scene = imported(folder.write("room.gltf", asGltf(panels, axis, 1.0, folder)));
        EXPECT_EQ(scene.report.up_axis, "y");
        EXPECT_EQ(scene.report.up_source,
                  "file; nothing in the scene shows whether it is right; --up sets it");
        EXPECT_EQ(joined(scene.report.warnings).find("up"), std::string::npos);
    }
}

// Walls and floors that were found by shape depend on the assumed axis, so they are no evidence for
// it.
TEST(FrameGuess, ProposesTheAxisOfATurnedRoomOfOneMesh) {
    const TempFolder folder;
    for (const UpAxis axis : kAllAxes) {
        const Scene scene =
            imported(folder.write("room.gltf", asMergedGltf(livingRoom(true), axis, folder)));
        ASSERT_GE(scene.objects.size(), 4U);
        const ImportProposal& proposal = scene.report.proposal;
        if (axis == UpAxis('y')) {
            EXPECT_TRUE(proposal.isEmpty()) << joined(scene.report.warnings);
            continue;
        }
        EXPECT_EQ(proposal.up_axis, axis) << axis.text() << joined(scene.report.warnings);
        EXPECT_EQ(proposal.unit_m, std::nullopt) << axis.text();
        EXPECT_NE(joined(scene.report.warnings).find("try --up " + axis.text()), std::string::npos)
            << axis.text();
        EXPECT_EQ(settingsText(proposal), axis.text() + " up");
    }
}

// Cups, pots and lamps are round about the vertical, whatever the walls and shelves indicate.
TEST(FrameGuess, RoundThingsStandUpright) {
    FrameEvidence evidence;
    for (int i = 0; i < 6; ++i) {
        MeasuredObject& thing = evidence.objects.emplace_back();
        const Eigen::Vector3d at(i, 0.1 * i * i, 0.3 * i);
        thing.box = Eigen::AlignedBox3d(at, at + Eigen::Vector3d(0.2, 0.3, 0.2));
        thing.area = 0.3;
        thing.facing = {0.02, 0.06, 0.02};
        evidence.core.extend(thing.box);
    }
    const std::vector<UpEvidence> ranked = scoreUpAxes(evidence);
    EXPECT_EQ(ranked[0].axis.letter, 'y');
    EXPECT_EQ(ranked[1].axis.letter, 'y');
    EXPECT_GT(ranked[1].score - ranked[2].score, 0.3);
}

// A floor and a ceiling that few objects reach belong to the room and are not outliers.
TEST(FrameGuess, MeasuresTheRoomFromFloorToCeiling) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(false);
    boxes.erase(boxes.begin() + 2, boxes.begin() + 6);  // the walls
    boxes.pop_back();                                   // and the picture on one of them
    boxes.back().high.z() = 0.6;
    const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 1.0, folder)));
    EXPECT_TRUE(scene.report.proposal.isEmpty()) << joined(scene.report.warnings);
    EXPECT_NEAR(collectEvidence(scene).core.sizes().z(), 2.8, 1e-4);
}

// An impossible file unit is not replaced by one that makes the room too low to stand in.
TEST(FrameGuess, TakesAUnitThatLeavesRoomToStand) {
    const TempFolder folder;
    const double scale = 21.5;
    const Scene scene =
        imported(folder.write("room.gltf", asGltf(livingRoom(true), 'y', scale, folder)));
    EXPECT_NE(scene.report.unit_m, 1.0);
    EXPECT_GT(scene.report.unit_m * scale * 2.8, 1.8) << joined(scene.report.warnings);
    EXPECT_LT(scene.report.unit_m * scale * 2.8, 4.0) << joined(scene.report.warnings);
}

// Furniture and the room's height determine the unit; the proposal is approximately right.
TEST(FrameGuess, ProposesTheUnitOfAScaledRoom) {
    const TempFolder folder;
    for (const double scale : {0.1, 0.2, 0.24, 0.3, 0.45, 3.0, 8.0}) {
        for (const bool gltf : {true, false}) {
            const Scene scene = imported(
                gltf ? folder.write("room.gltf", asGltf(livingRoom(true), 'y', scale, folder))
                     : folder.write("room.obj", asObj(livingRoom(true), 'y', scale)));
            const double found = scene.report.proposal.unit_m.value_or(scene.report.unit_m) * scale;
            EXPECT_GT(found, 0.7) << scale << joined(scene.report.warnings);
            EXPECT_LT(found, 1.4) << scale << joined(scene.report.warnings);
            if (gltf && scale < 1.0) {
                EXPECT_EQ(scene.report.unit_m, 1.0);
                EXPECT_NE(joined(scene.report.warnings).find("--unit "), std::string::npos)
                    << scale;
            }
        }
    }
}

// The unit of a room with low walls is accepted if its furniture has usual sizes.
TEST(FrameGuess, BelievesFurnitureBeforeTheHeightOfTheWalls) {
    const TempFolder folder;
    for (const double height : {1.2, 2.6}) {
        std::vector<NamedBox> boxes = livingRoom(true);
        boxes.erase(boxes.begin() + 1);  // the ceiling
        for (std::size_t i = 1; i < 5; ++i) boxes[i].high.z() = height;
        boxes.back().high.z() = std::min(boxes.back().high.z(), height);
        boxes.back().low.z() = boxes.back().high.z() - 0.4;
        const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 1.0, folder)));
        EXPECT_EQ(scene.report.unit_m, 1.0);
        EXPECT_TRUE(scene.report.proposal.isEmpty()) << joined(scene.report.warnings);
    }
}

// A room with floor and ceiling that is too low to stand in is doubtful, whatever its furniture.
TEST(FrameGuess, DoubtsAClosedRoomThatIsTooLow) {
    const TempFolder folder;
    const Scene scene =
        imported(folder.write("room.gltf", asGltf(livingRoom(true), 'y', 0.62, folder)));
    EXPECT_NE(joined(scene.report.warnings).find("the unit is doubtful"), std::string::npos);
    EXPECT_NEAR(scene.report.proposal.unit_m.value_or(1.0), 1.0 / 0.62, 0.4);
}

// The file's unit is not replaced by one that is doubtful itself.
TEST(FrameGuess, KeepsTheUnitOfAFileIfNoUsualOneIsBetter) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(true);
    for (NamedBox& box : boxes) {  // long and 21 m high; pillows in centimetres have usual sizes
        box.low = box.low.cwiseProduct(Eigen::Vector3d(8, 8, 8));
        box.high = box.high.cwiseProduct(Eigen::Vector3d(8, 8, 8));
    }
    boxes.erase(boxes.begin() + 6, boxes.end());
    boxes.push_back({"pillow", {3, 3, 0}, {50, 30, 10}});
    const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 1.0, folder)));
    EXPECT_EQ(scene.report.unit_m, 1.0) << joined(scene.report.warnings);
    EXPECT_NE(joined(scene.report.warnings).find("the unit is doubtful"), std::string::npos);
}

// A room without furniture and names looks the same upside down.
TEST(FrameGuess, TakesAnEmptyRoomAsUpright) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(false);
    boxes.resize(6);
    for (const double width : {3.0, 4.0, 6.0}) {
        for (const double length : {3.0, 5.0, 8.0}) {
            const Eigen::Vector3d wider(width - boxes[1].high.x(), length - boxes[1].high.y(), 0);
            for (NamedBox& box : boxes) {
                for (Eigen::Vector3d* corner : {&box.low, &box.high}) {
                    if (corner->x() > 2.0) corner->x() += wider.x();
                    if (corner->y() > 2.0) corner->y() += wider.y();
                }
            }
            const Scene scene = imported(folder.write("room.obj", asObj(boxes, 'y')));
            EXPECT_EQ(scene.report.up_axis, "y") << width << " x " << length;
            EXPECT_EQ(joined(scene.report.warnings).find("--up -y"), std::string::npos);
        }
    }
}

// Names of floor and ceiling tell even an empty room that is upside down.
TEST(FrameGuess, BelievesTheNamesOfAnEmptyRoom) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(true);
    boxes.resize(6);
    const Scene scene = imported(folder.write("room.obj", asObj(boxes, UpAxis('y', true))));
    EXPECT_EQ(scene.report.up_axis, "-y");
}

// Centimetres in a file that says metres are recognised although its walls are cut at 1.2 m.
TEST(FrameGuess, ReplacesAWrongUnitOfARoomWithLowWalls) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(true);
    boxes.pop_back();                                             // the picture
    boxes.erase(boxes.begin() + 1);                               // the ceiling
    for (std::size_t i = 1; i < 5; ++i) boxes[i].high.z() = 1.2;  // the walls
    boxes.back().high.z() = 1.0;                                  // the bookshelf
    const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 100.0, folder)));
    EXPECT_DOUBLE_EQ(scene.report.unit_m, 0.01) << joined(scene.report.warnings);
}

TEST(FrameGuess, AHandleOfADoorIsNoDoor) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(true);
    boxes.resize(6);
    boxes.push_back({"Entrance_Handle_Left", {1.0, 0.0, 1.0}, {1.18, 0.05, 1.05}});
    const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 1.0, folder)));
    EXPECT_DOUBLE_EQ(scene.report.unit_m, 1.0);
    EXPECT_EQ(scene.report.proposal.unit_doubt, "");
    EXPECT_FALSE(scene.report.proposal.unit_m);
}

// A hall over 6 m high is doubtful, but furniture of usual sizes leads to no other unit.
TEST(FrameGuess, ProposesNoOtherUnitForAHallWithUsualFurniture) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(true);
    boxes[1].low.z() = boxes[1].high.z() = 8.0;
    for (std::size_t i = 2; i < 6; ++i) boxes[i].high.z() = 8.0;
    const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 1.0, folder)));
    EXPECT_NE(joined(scene.report.warnings).find("furniture of usual size"), std::string::npos)
        << joined(scene.report.warnings);
    EXPECT_EQ(scene.report.proposal.unit_m, std::nullopt);
}

// A robot is not a room, and its format's unit is the metre.
TEST(FrameGuess, DoubtsNoUnitThatTheFormatFixes) {
    const TempFolder folder;
    const Scene scene =
        imported(folder.write("robot.urdf", R"(<robot name="chair"><link name="chair">
<visual><geometry><box size="0.2 0.1 0.05"/></geometry></visual></link></robot>)"));
    EXPECT_EQ(scene.report.unit_m, 1.0);
    EXPECT_EQ(scene.report.unit_source, "format");
    EXPECT_EQ(scene.report.up_axis, "z");
    EXPECT_EQ(joined(scene.report.warnings).find("doubtful"), std::string::npos)
        << joined(scene.report.warnings);
}

// A school hall is high; its furniture has the largest usual sizes.
TEST(FrameGuess, BelievesAHighHallWhereAllFurnitureHasItsUsualSize) {
    const TempFolder folder;
    std::vector<NamedBox> boxes = livingRoom(true);
    boxes[1].low.z() = boxes[1].high.z() = 4.6;  // the ceiling
    for (std::size_t i = 2; i < 6; ++i) boxes[i].high.z() = 4.6;
    const Scene scene = imported(folder.write("room.gltf", asGltf(boxes, 'y', 1.0, folder)));
    EXPECT_EQ(scene.report.unit_m, 1.0);
    EXPECT_TRUE(scene.report.proposal.isEmpty()) << joined(scene.report.warnings);
}

}  // namespace
}  // namespace dollytrack::frame_guess_test
