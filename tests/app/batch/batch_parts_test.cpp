#include "app/batch/batch_folder.h"
#include "app/batch/file_pattern.h"
#include "app/batch/job.h"
#include "app/batch/jobs_file.h"
#include "app/batch/log_end.h"
#include "app/batch/markup.h"
#include "app/batch/scene_files.h"
#include "app/batch/toml_depth.h"
#include "engine/io/files/text_file.h"
#include "tests/support/temp_folder.h"

#include <fnmatch.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

namespace dollytrack::batch::batch_parts_test {
namespace {

std::vector<std::string> found(const std::string& pattern, const std::filesystem::path& base) {
    std::vector<std::string> names;
    const auto files = filesMatching(pattern, base);
    if (!files) return {"error: " + files.error().message};
    for (const SceneFile& file : *files) names.push_back(file.path.string());
    return names;
}

std::vector<std::string> namesOf(const std::vector<std::string>& paths) {
    std::vector<SceneFile> scenes;
    for (const std::string& path : paths) {
        scenes.push_back({path, {}});
    }
    nameScenes(scenes);
    std::vector<std::string> names;
    for (const SceneFile& scene : scenes) names.push_back(scene.name);
    return names;
}

TEST(SceneFiles, PatternsFindScenesInNaturalOrder) {
    const test::TempFolder folder;
    for (const char* file : {"room_10.obj", "room_2.obj", "room_2.mtl", "a/b/x.glb", "a/y.GLB",
                             ".hidden.obj", "a/.git/z.obj"}) {
        std::filesystem::create_directories((folder.path() / file).parent_path());
        std::ofstream(folder.path() / file) << "v";
    }
    using Names = std::vector<std::string>;
    EXPECT_EQ(found("room_*", folder.path()), (Names{"room_2.obj", "room_10.obj"}));
    EXPECT_EQ(found("room_?.obj", folder.path()), (Names{"room_2.obj"}));
    EXPECT_EQ(found("a/*", folder.path()), (Names{"a/y.GLB"}));
    EXPECT_EQ(found("**/*.glb", folder.path()), (Names{"a/b/x.glb"}));
    EXPECT_EQ(found("a/**", folder.path()), (Names{"a/y.GLB", "a/b/x.glb"}));
    EXPECT_EQ(found("*/*/x*", folder.path()), (Names{"a/b/x.glb"}));
    EXPECT_EQ(found("room_2.mtl", folder.path()), (Names{"room_2.mtl"}));
    EXPECT_TRUE(found("none/*.obj", folder.path())[0].starts_with("error: "));
    EXPECT_TRUE(found("*.ply", folder.path())[0].starts_with("error: "));
    EXPECT_TRUE(found("none.obj", folder.path())[0].starts_with("error: "));
}

TEST(SceneFiles, DatasetConfigsStandForTheirScenesEachOnce) {
    const test::TempFolder folder;
    const std::string config = R"({"scene_instances": {"paths": {".json": ["scenes/*"]}}})";
    for (const char* name : {"set/plain", "set/lit"}) {
        static_cast<void>(folder.write(std::string(name) + ".scene_dataset_config.json", config));
    }
    for (const char* name : {"flat", "attic"}) {
        static_cast<void>(folder.write(std::string("set/scenes/") + name + ".scene_instance.json",
                                       R"({"stage_instance": {"template_name": "s"}})"));
    }
    using Names = std::vector<std::string>;
    const Names scenes = {"set/scenes/attic.scene_instance.json",
                          "set/scenes/flat.scene_instance.json"};
    EXPECT_EQ(found("set/*.scene_dataset_config.json", folder.path()), scenes);
    EXPECT_EQ(found("set/lit.scene_dataset_config.json", folder.path()), scenes);
    EXPECT_EQ(namesOf(scenes), (Names{"attic", "flat"}));
    // The other config would read the same scenes differently.
    const std::string other = found("set/plain.scene_dataset_config.json", folder.path())[0];
    EXPECT_TRUE(other.starts_with("error: the scene attic is read with ")) << other;
    EXPECT_NE(other.find("lit.scene_dataset_config.json"), std::string::npos) << other;
    const std::string large = config + std::string(std::size_t{1} << 20U, ' ');
    const auto file = folder.write("large/large.scene_dataset_config.json", large);
    EXPECT_TRUE(found(file.string(), folder.path())[0].starts_with("error: "));
    static_cast<void>(folder.write("set/lit.scene_dataset_config.json", "{"));
    EXPECT_TRUE(
        found("set/lit.scene_dataset_config.json", folder.path())[0].starts_with("error: "));
}

// Two equal names would share the folder of one job.
TEST(SceneFiles, NumbersThatTellNamesApartAreNobodysName) {
    const std::vector<std::string> names = namesOf({"a b.obj", "a_b.obj", "a_b_obj-2.x"});
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 3U);
    EXPECT_EQ(names[2], "a_b_obj-2");
}

// Trying each "**" separately in each folder would take years here.
TEST(SceneFiles, ManyWildcardsTakeNoLonger) {
    const test::TempFolder folder;
    std::string deep = "a";
    for (int i = 0; i < 30; ++i) deep += "/a";
    std::filesystem::create_directories(folder.path() / deep);
    std::ofstream(folder.path() / deep / "x.glb") << "v";
    std::string pattern;
    for (int i = 0; i < 20; ++i) pattern += "**/a/";
    EXPECT_EQ(found(pattern + "*.glb", folder.path()), std::vector<std::string>{deep + "/x.glb"});
    EXPECT_TRUE(found(pattern + "*.obj", folder.path())[0].starts_with("error: "));
    EXPECT_TRUE(matches(deep + "/x.glb", pattern + "*.glb"));
    EXPECT_FALSE(matches(deep + "/x.glb", pattern + "*.obj"));
    std::string stars;
    for (int i = 0; i < 40; ++i) stars += "*a";
    EXPECT_FALSE(fitsFilePattern(std::string(200, 'a') + "b", stars));
    EXPECT_TRUE(fitsFilePattern(std::string(200, 'a'), stars));
}

// The C library defines what patterns mean; it is only too slow for some.
TEST(SceneFiles, PatternsMeanWhatTheyMeanToShells) {
    const std::vector<std::string> patterns = {
        "*",      "a*",           "*a",    "*a*b", "?",     "a?c",   "[ab]c",   "[!a]*", "[^a]*",
        "[a-c]x", "[]a]",         "[a",    "a[",   "\\*",   "a\\?",  ".*",      "[.]a",  "**",
        "*.*",    "[[:alpha:]]1", "[a-]b", "[!]]", "a**b*", "*[ab]", "?[a-c]*", "[[]a",  "x[]]y*",
        "",       "[]",           "a.b"};
    const std::vector<std::string> names = {"a",  "b",   "ab",  "abc", "c",    "ac", "a.b", ".a",
                                            "cx", "]",   "[",   "[a",  "a[",   "*",  "a?",  "-b",
                                            "z1", "a1b", "aab", "x]y", "x]yz", "[]", ".",   "bcd"};
    for (const std::string& pattern : patterns) {
        for (const std::string& name : names) {
            EXPECT_EQ(fitsFilePattern(name, pattern),
                      ::fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0)
                << pattern << " " << name;
        }
    }
}

// Tables are freed recursively: a key of half a million parts used to overflow the stack.
TEST(JobsFile, DeepKeysAndListsAreRefused) {
    const test::TempFolder folder;
    const auto refusal = [&](const std::string& text) {
        const auto order = readJobsFile(folder.write("jobs.toml", text));
        return order ? std::string() : describe(order.error());
    };
    std::string key = "a";
    std::string quoted = "\"a=\"";
    for (int i = 0; i < 500'000; ++i) key += ".a";
    for (int i = 0; i < 100; ++i) quoted += " . '='";
    for (const std::string& text : {"\n" + key + "=1\n", "\n[" + key + "]\n", "\n[[" + key + "]]\n",
                                    "\n" + quoted + " = 1\n", "\nx = {" + key + "=1}\n"}) {
        EXPECT_NE(refusal(text).find("jobs.toml:2: A key has more than 16 parts"),
                  std::string::npos)
            << refusal(text).substr(0, 200);
    }
    EXPECT_NE(refusal("x=" + std::string(100'000, '[')).find("nested more than 32 deep"),
              std::string::npos);
    // Dots in numbers and inside strings do not separate parts of keys.
    std::string numbers = "x = [";
    for (int i = 0; i < 100; ++i) numbers += "0.5, 'a.b.c', ";
    EXPECT_TRUE(checkTomlDepth(numbers + "]\n# a.b" + std::string(100, '.') + "\ny = \"\"\"\n" +
                                   std::string(100, '.') + "\"\"\"\"\"\nz = '" +
                                   std::string(100, '.') + "'\n",
                               "jobs.toml"));
}

TEST(SceneFiles, MatchingNeedsNoDisk) {
    EXPECT_TRUE(matches("rooms/old/a.obj", "rooms/old/*"));
    EXPECT_TRUE(matches("rooms/old/a.obj", "**/a.obj"));
    EXPECT_TRUE(matches("a.obj", "**/a.obj"));
    EXPECT_TRUE(matches("rooms/old/a.obj", "rooms/**"));
    EXPECT_FALSE(matches("rooms/old/a.obj", "rooms/*"));
    EXPECT_FALSE(matches("rooms/a.obj", "rooms/*.glb"));
}

// A scene's name must not depend on scenes with other file names.
TEST(SceneFiles, NamesAreDifferentAndStay) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(namesOf({"x/bath.obj", "kitchen 2.glb"}), (Names{"bath", "kitchen_2"}));
    EXPECT_EQ(namesOf({"x/bath.obj", "x/bath.glb", "hall.obj"}),
              (Names{"bath_obj", "bath_glb", "hall"}));
    EXPECT_EQ(namesOf({"x/bath.obj", "y/bath.obj"}), (Names{"x_bath", "y_bath"}));
    EXPECT_EQ(namesOf({"/data/a/x/bath.obj", "/data/b/x/bath.obj", "hall.obj"}),
              (Names{"a_x_bath", "b_x_bath", "hall"}));
    const Names hard = namesOf({"a b.obj", "a_b.obj", "a-b.obj", "a/b.obj", "..obj", "ä.obj"});
    EXPECT_EQ(std::set<std::string>(hard.begin(), hard.end()).size(), hard.size());
    for (const std::string& name : hard) {
        EXPECT_EQ(asName(name), name);
        EXPECT_FALSE(name.empty());
    }
}

// Data sets often keep each scene in its own folder, always under the same file name.
TEST(SceneFiles, FoldersNameScenesWhoseFilesAreAllCalledScene) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(namesOf({"/data/sets/kitchen/scene.glb", "/data/sets/bath/scene.glb"}),
              (Names{"kitchen", "bath"}));
    EXPECT_EQ(namesOf({"rooms/kitchen/scene.glb"}), (Names{"kitchen"}));
    EXPECT_EQ(namesOf({"rooms/kitchen/Scene.glb", "rooms/kitchen/scene.obj", "scene.glb"}),
              (Names{"kitchen_glb", "kitchen_obj", "scene"}));
    EXPECT_EQ(namesOf({"a/kitchen/scene.glb", "b/kitchen/scene.glb"}),
              (Names{"a_kitchen", "b_kitchen"}));
    const std::string longest = namesOf({"a/" + std::string(200, 'x') + "ä.glb"})[0];
    EXPECT_EQ(longest, std::string(64, 'x'));
}

TEST(Shard, SharesAllJobsOutEvenly) {
    BatchOrder order;
    order.file = "jobs.toml";
    order.seeds = {1, 2, 3, 4, 5, 6, 7};
    order.scenes = {{"a.obj", "a"}, {"b.obj", "b"}};
    const std::vector<Job> jobs = jobsOf(order);
    ASSERT_EQ(jobs.size(), 14U);
    for (const int parts : {1, 3, 14, 20}) {
        std::vector<int> sizes;
        std::set<int> numbers;
        for (int i = 0; i < parts; ++i) {
            int size = 0;
            for (const Job& job : jobs) {
                if (!Shard{i, parts}.has(job)) continue;
                ++size;
                EXPECT_TRUE(numbers.insert(job.number).second);
            }
            sizes.push_back(size);
        }
        EXPECT_EQ(numbers.size(), jobs.size());
        EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()) -
                      *std::min_element(sizes.begin(), sizes.end()),
                  1);
    }
}

TEST(Shard, IsReadOrRefused) {
    const auto shard = parseShard("2/8");
    ASSERT_TRUE(shard);
    EXPECT_EQ(shard->index, 2);
    EXPECT_EQ(shard->count, 8);
    for (const char* wrong : {"", "2", "8/8", "-1/8", "1/0", "1/8x", "a/8", "1/", "/8", "1 /8"}) {
        EXPECT_FALSE(parseShard(wrong)) << wrong;
    }
}

TEST(BatchFolder, PartsThatStartAtOnceAllClaimIt) {
    const BatchList list{{}, {"captured_pct >= 90"}};
    for (int round = 0; round < 100; ++round) {
        const test::TempFolder folder;
        std::vector<pid_t> parts;
        for (int part = 0; part < 4; ++part) {
            const pid_t child = ::fork();
            ASSERT_GE(child, 0);
            if (child == 0) ::_exit(claimBatchFolder(folder.path(), list) ? 0 : 1);
            parts.push_back(child);
        }
        for (const pid_t part : parts) {
            int status = -1;
            ASSERT_EQ(::waitpid(part, &status, 0), part);
            EXPECT_EQ(status, 0) << "round " << round;
        }
        EXPECT_TRUE(readBatchList(folder.path()));
    }
}

TEST(BatchFolder, OnlyOthersFilesStandInTheWay) {
    const test::TempFolder folder;
    (void)folder.write("jobs.json.tmp.123", "half of a li");  // as a killed part leaves it
    EXPECT_TRUE(claimBatchFolder(folder.path(), {{}, {}}));
    EXPECT_TRUE(claimBatchFolder(folder.path(), {{}, {"captured_pct >= 90"}}));

    const test::TempFolder photos;
    (void)photos.write("photo.png", "x");
    EXPECT_FALSE(claimBatchFolder(photos.path(), {{}, {}}));
    const test::TempFolder copy;
    (void)copy.write("jobs.json.bak", "x");
    EXPECT_FALSE(claimBatchFolder(copy.path(), {{}, {}}));
    const test::TempFolder odd;
    std::filesystem::create_directory(odd.path() / "jobs.json");  // cannot be read as text
    EXPECT_FALSE(claimBatchFolder(odd.path(), {{}, {}}));
    const test::TempFolder other;
    (void)other.write("jobs.json", "[1, 2]");
    EXPECT_FALSE(claimBatchFolder(other.path(), {{}, {}}));
    EXPECT_EQ(readText(other.path() / "jobs.json").value_or(""), "[1, 2]");
}

TEST(LogEnd, StartsAtALineUnlessTheLastLineIsLonger) {
    const test::TempFolder folder;
    const auto log = folder.write("log.txt", "first\nsecond\nthird\n");
    EXPECT_EQ(endOf(log, 100), "first\nsecond\nthird\n");
    EXPECT_EQ(endOf(log, 10), "third\n");
    const auto one_line = folder.write("long.txt", std::string(50, 'x') + "the reason");
    EXPECT_EQ(endOf(one_line, 10), "the reason");
    const auto ended = folder.write("ended.txt", std::string(50, 'x') + "the reason\n");
    EXPECT_EQ(endOf(ended, 11), "the reason\n");
    EXPECT_EQ(endOf(folder.path() / "missing.txt", 10), "");
}

TEST(Markup, KeepsNothingThatWouldBeReadAsMarkup) {
    EXPECT_EQ(asMarkup("a<b & \"c\" 'd'>"), "a&lt;b &amp; &quot;c&quot; &#39;d&#39;&gt;");
    EXPECT_EQ(asMarkup(std::string("\x01tab\x1b[31m", 9)), "tab[31m");
    EXPECT_EQ(asMarkup("\xff"), "\xef\xbf\xbd");
    EXPECT_EQ(asMarkup("no character: \xef\xbf\xbf."), "no character: .");
    EXPECT_EQ(asLink("a b/ä#.jpg"), "a%20b/%C3%A4%23.jpg");
}

}  // namespace
}  // namespace dollytrack::batch::batch_parts_test
