#include "engine/io/import/scene_import.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/obj_writer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

namespace dollytrack::mutants_test {
namespace {

using test::TempFolder;

std::string textOf(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// A mutated text: changed bytes, removed, duplicated or moved pieces, huge numbers.
std::string mutant(const std::string& text, std::mt19937& random) {
    std::string made = text;
    const auto below = [&](std::size_t limit) {
        return random() % std::max<std::size_t>(limit, 1);
    };
    for (std::size_t change = 0; change <= below(3); ++change) {
        if (made.empty()) break;
        const std::size_t at = below(made.size());
        const std::size_t length = std::min(below(40) + 1, made.size() - at);
        switch (below(6)) {
            case 0:
                made[at] = static_cast<char>(random() & 0xFFU);
                break;
            case 1:
                made.erase(at, length);
                break;
            case 2:
                made.insert(below(made.size()), made.substr(at, length));
                break;
            case 3: {
                const auto digit = made.find_first_of("0123456789", at);
                if (digit != std::string::npos) made.replace(digit, 1, "-1e308");
                break;
            }
            case 4: {
                static const char* const kPieces[] = {"null", "[]", "{}", "\"\"",
                                                      "1e40", "-7", "[["};
                const auto digit = made.find_first_of("0123456789", at);
                if (digit != std::string::npos) made.replace(digit, 1, kPieces[below(7)]);
                break;
            }
            default:
                made.resize(at);
        }
    }
    return made;
}

/// Each mutant is read, or refused with a one-line sentence, without a crash.
void readMutants(const TempFolder& folder, const std::string& name, int& read) {
    const std::string text = textOf(folder.path() / name);
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
        const auto path = folder.write(name, mutant(text, random));
        const Result<Scene> scene = importScene(path, {.in_process = true});
        if (!scene) {
            EXPECT_EQ(scene.error().code, ErrorCode::BadInput) << i;
            EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << i;
            continue;
        }
        ++read;
        for (const Eigen::Vector3f& p : scene->positions) ASSERT_TRUE(p.allFinite()) << i;
        for (const Triangle& t : scene->triangles) {
            for (const std::uint32_t v : t) ASSERT_LT(v, scene->positions.size()) << i;
        }
    }
}

TEST(DatasetMutants, HousesOf3dFrontNeverCrash) {
    const TempFolder folder;
    test::writeFrontHouse(folder);
    int read = 0;
    readMutants(folder, "house.json", read);
    // Otherwise only the first bytes would have been tested.
    EXPECT_GT(read, 30);
    EXPECT_LT(read, 300);
}

TEST(DatasetMutants, ScenesOfSceneNetNeverCrash) {
    const TempFolder folder;
    test::ObjWriter obj;
    static_cast<void>(
        folder.write("office/office1_layout.obj", obj.room({5, 4, 2.5}, true).text()));
    static_cast<void>(folder.write("ShapeNetCore.v2/03928116/aaa/models/model_normalized.obj",
                                   test::lShapedModel()));
    static_cast<void>(folder.write("scene.txt", test::sceneNetText()));
    int read = 0;
    readMutants(folder, "scene.txt", read);
    EXPECT_GT(read, 30);
    EXPECT_LT(read, 300);
}

}  // namespace
}  // namespace dollytrack::mutants_test
