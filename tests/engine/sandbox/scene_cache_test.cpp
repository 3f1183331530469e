#include "engine/io/sandbox/scene_cache.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/sha256.h"
#include "tests/engine/sandbox/serialized_scenes.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace dollytrack::scene_cache_test {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

/// A scene with a texture, read in this process, and a cache for it.
class SceneCacheTest : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(scene_.parent_path());
        put("scene/room.obj", "v 0 0 0");
        put("scene/oak.png", "picture");
    }

    void put(const std::string& name, std::string_view text) const {
        EXPECT_FALSE(folder_.write(name, text).empty());
    }
    /// Records the inputs of a reader: the scene, its texture and a missing one.
    bool keep(const SceneCache& cache, const std::string& key = "key") const {
        InputRecord record;
        const ConfinedFolder folder(scene_.parent_path());
        EXPECT_TRUE(openNamedFile(scene_));
        EXPECT_TRUE(folder.open("oak.png"));
        EXPECT_FALSE(folder.has("gone.png"));
        if (lists_) {
            EXPECT_EQ(folder.list().size(), 2U);
        }
        return cache.keep(key, scene_, *sha256OfFile(scene_), roots_, record.uses(), serialized_);
    }
    [[nodiscard]] bool found(const std::string& key = "key") const {
        return cache_.find(key, roots_).has_value();
    }
    [[nodiscard]] fs::path entry(const std::string& key = "key") const {
        return cache_folder_ / (key + ".scene");
    }

    const TempFolder folder_;
    const fs::path scene_ = folder_.path() / "scene" / "room.obj";
    const InputRoots roots_ = inputRoots(scene_, {folder_.path() / "models"});
    const fs::path cache_folder_ = folder_.path() / "cache";
    const std::vector<std::uint8_t> serialized_ = test::serialized(test::smallDecodedScene());
    const SceneCache cache_{*GuardedFolder::make(cache_folder_), 1 << 20};
    bool lists_ = false;
};

TEST_F(SceneCacheTest, FindsWhatIsKept) {
    EXPECT_FALSE(found());
    ASSERT_TRUE(keep(cache_));
    const auto scene = cache_.find("key", roots_);
    ASSERT_TRUE(scene);
    EXPECT_EQ(test::serialized(*scene), serialized_);
    EXPECT_FALSE(found("other"));
}

TEST_F(SceneCacheTest, FindsItWhereTheFolderWentTo) {
    ASSERT_TRUE(keep(cache_));
    fs::rename(scene_.parent_path(), folder_.path() / "moved");
    EXPECT_TRUE(cache_.find("key", {folder_.path() / "moved"}));
    EXPECT_FALSE(found());
}

TEST_F(SceneCacheTest, NoticesWhatHasChanged) {
    ASSERT_TRUE(keep(cache_));
    put("scene/other.png", "of no interest");
    EXPECT_TRUE(found());
    put("scene/gone.png", "there now");
    EXPECT_FALSE(found());
    fs::remove(scene_.parent_path() / "gone.png");
    EXPECT_TRUE(found());
    put("scene/oak.png", "another");
    EXPECT_FALSE(found());
    put("scene/oak.png", "picture");
    EXPECT_TRUE(found());
    fs::remove(scene_.parent_path() / "oak.png");
    EXPECT_FALSE(found());
}

TEST_F(SceneCacheTest, NoticesNewNamesWhereNamesWereLookedFor) {
    lists_ = true;
    ASSERT_TRUE(keep(cache_));
    EXPECT_TRUE(found());
    fs::create_directories(scene_.parent_path() / "maps");
    EXPECT_TRUE(found());
    put("scene/maps/elm.png", "new");
    EXPECT_FALSE(found());
}

TEST_F(SceneCacheTest, HashesAFileThatHasSettledOnce) {
    const SceneCache at_once(*GuardedFolder::open(cache_folder_), 1 << 20, std::chrono::seconds(0));
    const auto digests = [&] {
        std::vector<fs::path> files;
        for (const auto& file : fs::directory_iterator(cache_folder_)) {
            if (file.path().extension() == ".digest") files.push_back(file.path());
        }
        return files;
    };
    // The file was just written, so a second write could have the same time stamp.
    EXPECT_EQ(*cache_.digestOf(scene_), *sha256OfFile(scene_));
    EXPECT_TRUE(digests().empty());
    EXPECT_EQ(*at_once.digestOf(scene_), *sha256OfFile(scene_));
    ASSERT_EQ(digests().size(), 1U);
    // A valid entry is used, which its time stamp shows; one with a changed digit is not.
    const fs::path kept = digests()[0];
    const std::string whole = *readNamedFile(kept, 1000);
    const fs::file_time_type old{std::chrono::hours(1)};
    fs::last_write_time(kept, old);
    EXPECT_EQ(*cache_.digestOf(scene_), *sha256OfFile(scene_));
    EXPECT_NE(fs::last_write_time(kept), old);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = damaged[i] == '0' ? '1' : '0';
        put("cache/" + kept.filename().string(), damaged);
        EXPECT_EQ(*cache_.digestOf(scene_), *sha256OfFile(scene_)) << i;
    }
    for (const std::string& damaged : {std::string(), std::string(64, 'a'), whole.substr(1)}) {
        put("cache/" + kept.filename().string(), damaged);
        EXPECT_EQ(*cache_.digestOf(scene_), *sha256OfFile(scene_)) << damaged;
    }

    put("cache/" + kept.filename().string(), whole);
    const auto time = fs::last_write_time(scene_);
    put("scene/room.obj", "v 9 9 9");  // same length
    fs::last_write_time(scene_, time);
    EXPECT_EQ(*cache_.digestOf(scene_), *sha256OfFile(scene_));
    EXPECT_FALSE(cache_.digestOf(folder_.path() / "gone.obj"));
}

TEST_F(SceneCacheTest, KeepsNothingThatChangedMeanwhile) {
    InputRecord record;
    const ConfinedFolder folder(scene_.parent_path());
    ASSERT_TRUE(folder.open("oak.png"));
    put("scene/oak.png", "another");
    const std::string digest = *sha256OfFile(scene_);
    EXPECT_FALSE(cache_.keep("key", scene_, digest, roots_, record.uses(), serialized_));
    EXPECT_FALSE(cache_.keep("key", scene_, std::string(64, '0'), roots_, {}, serialized_));
    EXPECT_TRUE(cache_.keep("key", scene_, digest, roots_, {}, serialized_));
}

// A compromised importer could name any file; such files are not read, not even for a digest.
TEST_F(SceneCacheTest, KeepsNothingFromElsewhere) {
    put("secret.txt", "secret");
    const auto secret = openNamedFile(folder_.path() / "secret.txt");
    ASSERT_TRUE(secret);
    const std::string digest = *sha256OfFile(scene_);
    for (const fs::path& path :
         {folder_.path() / "secret.txt", scene_.parent_path() / ".." / "secret.txt"}) {
        EXPECT_FALSE(cache_.keep("key", scene_, digest, roots_,
                                 {{InputUse::File, path, secret->identity()}}, serialized_));
    }
}

TEST_F(SceneCacheTest, PassesOverDamagedEntries) {
    ASSERT_TRUE(keep(cache_));
    std::ifstream in(entry(), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t i = 0; i < whole.size(); i += 7) {
        std::string other = whole;
        other[i] = static_cast<char>(other[i] ^ 0x10);
        put("cache/key.scene", other);
        ASSERT_FALSE(found()) << i;
        put("cache/key.scene", whole.substr(0, i));
        ASSERT_FALSE(found()) << i;
    }
    put("cache/key.scene", whole);
    EXPECT_TRUE(found());
    fs::rename(entry(), folder_.path() / "elsewhere");
    fs::create_symlink(folder_.path() / "elsewhere", entry());
    EXPECT_FALSE(found());
}

TEST_F(SceneCacheTest, TheOldestMakeRoom) {
    ASSERT_TRUE(keep(cache_, "a"));
    const auto size = fs::file_size(entry("a"));
    const SceneCache small(*GuardedFolder::open(cache_folder_), 3 * size);
    ASSERT_TRUE(keep(small, "b"));
    ASSERT_TRUE(keep(small, "c"));
    const auto now = fs::file_time_type::clock::now();
    for (const auto& [key, age] : {std::pair("a", 3), std::pair("b", 2), std::pair("c", 1)}) {
        fs::last_write_time(entry(key), now - std::chrono::hours(age));
    }
    EXPECT_TRUE(small.find("a", roots_));  // becomes the most recently used
    ASSERT_TRUE(keep(small, "d"));
    EXPECT_TRUE(fs::exists(entry("a")));
    EXPECT_FALSE(fs::exists(entry("b")));
    EXPECT_TRUE(fs::exists(entry("c")));
    EXPECT_FALSE(keep(SceneCache(*GuardedFolder::open(cache_folder_), size / 2), "e"));
}

TEST_F(SceneCacheTest, NoticesWhatChangesInFoldersOfModels) {
    put("models/chair.obj", "v 1 1 1");
    put("models.json", "[]");
    const InputRoots roots =
        inputRoots(scene_, {folder_.path() / "models", folder_.path() / "models.json"});
    InputRecord record;
    const ConfinedFolder models(folder_.path() / "models");
    EXPECT_TRUE(models.open("chair.obj"));
    EXPECT_FALSE(models.has("table.obj"));
    EXPECT_TRUE(openNamedFile(folder_.path() / "models.json"));
    const std::string digest = *sha256OfFile(scene_);
    EXPECT_FALSE(cache_.keep("key", scene_, digest, roots_, record.uses(), serialized_));
    ASSERT_TRUE(cache_.keep("key", scene_, digest, roots, record.uses(), serialized_));
    const auto holds = [&] { return cache_.find("key", roots).has_value(); };
    EXPECT_TRUE(holds());
    EXPECT_FALSE(cache_.find("key", {roots[0]}));
    put("models/table.obj", "there now");
    EXPECT_FALSE(holds());
    fs::remove(folder_.path() / "models" / "table.obj");
    EXPECT_TRUE(holds());
    put("models.json", "{}");
    EXPECT_FALSE(holds());
    put("models.json", "[]");
    put("models/chair.obj", "v 2 2 2");
    EXPECT_FALSE(holds());
}

TEST_F(SceneCacheTest, KeysTellApartWhatMatters) {
    const std::string digest(64, 'a');
    const InputRoots beside = {"."};
    const std::string key = SceneCache::keyOf("room.obj", digest, {}, beside);
    EXPECT_EQ(SceneCache::keyOf("/elsewhere/hall.OBJ", digest, {}, {"/elsewhere"}), key);
    EXPECT_NE(SceneCache::keyOf("room.stl", digest, {}, beside), key);
    EXPECT_NE(SceneCache::keyOf("room.obj", std::string(64, 'b'), {}, beside), key);
    EXPECT_NE(SceneCache::keyOf("room.obj", digest, {.read_textures = false}, beside), key);
    EXPECT_NE(SceneCache::keyOf("room.obj", digest, {.unit_m = 0.01}, beside), key);
    EXPECT_NE(SceneCache::keyOf("room.obj", digest, {}, {".", "models"}), key);
    ImportOptions coarse;
    coarse.cloud.voxel_m = 0.05;
    EXPECT_NE(SceneCache::keyOf("room.obj", digest, coarse, beside), key);
    ImportOptions labelled;
    labelled.labels = folder_.path() / "labels.csv";
    put("labels.csv", "chair,chair\n");
    const std::string with_labels = SceneCache::keyOf("room.obj", digest, labelled, beside);
    EXPECT_NE(with_labels, key);
    put("labels.csv", "chair,sofa\n");
    EXPECT_NE(SceneCache::keyOf("room.obj", digest, labelled, beside), with_labels);
}

}  // namespace
}  // namespace dollytrack::scene_cache_test
