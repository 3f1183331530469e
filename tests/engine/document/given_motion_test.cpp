#include "engine/document/given_motion.h"

#include "engine/document/command_stack.h"
#include "engine/document/edits_json.h"
#include "engine/document/history_json.h"
#include "tests/engine/document/editing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace dollytrack::given_motion_test {
namespace {

using nlohmann::json;

/// A motion with awkward numbers, roll, and a jump after the third frame.
GivenMotion someMotion() {
    GivenMotion motion{"drone \u00e9", 1.0 / 30.0, {}};
    for (int i = 0; i < 5; ++i) {
        const double t = i / 30.0;
        const Eigen::Vector3d axis = Eigen::Vector3d(0.3, -0.5 + t, 0.7).normalized();
        const Pose pose{{-0.0, std::sqrt(2.0) * t, -1e6 + t},
                        Eigen::Quaterniond(Eigen::AngleAxisd(0.1 + t, axis))};
        motion.frames.push_back({t, pose, i < 3 ? 0 : 7});
    }
    return motion;
}

/// Keys at whole seconds.
GivenMotion someKeys(std::size_t count) {
    GivenMotion motion;
    const std::vector<MotionFrame> frames = someMotion().frames;
    for (std::size_t i = 0; i < count; ++i) {
        motion.keys.push_back({static_cast<double>(i), frames[i % frames.size()].pose});
    }
    return motion;
}

Edits withMotion() {
    Edits edits;
    edits.plan.motion = someMotion();
    return edits;
}

json motionOperation(const GivenMotion& motion) {
    json operation = motionJson(motion);
    operation["op"] = "set_motion";
    return operation;
}

json setMotion() {
    return motionOperation(someMotion());
}

}  // namespace

TEST(GivenMotion, ComesBackFromAProjectToTheLastBit) {
    const Edits edits = withMotion();
    const Result<Edits> back = editsFromJson(json::parse(editsJson(edits).dump(1)));
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_EQ(*back, edits);
    // Comparison treats the two zeros alike.
    EXPECT_TRUE(std::signbit(back->plan.motion->frames[0].pose.position.x()));
    Edits other = edits;
    GivenMotion moved = someMotion();
    moved.frames[2].pose.position.y() = std::nextafter(moved.frames[2].pose.position.y(), 9.0);
    other.plan.motion = moved;
    EXPECT_NE(other, edits);
    EXPECT_EQ(editsJson({}), json::object());
}

TEST(GivenMotion, KeepsKeysItDoesNotKnowUntilItIsRemoved) {
    json section = editsJson(withMotion());
    section["motion"]["lens"] = "wide";
    EXPECT_EQ(editsJson(withMotion(), section), section);
    EXPECT_FALSE(editsJson({}, section).contains("motion"));
}

TEST(GivenMotion, BadValuesAreNamedWithTheirPlace) {
    const auto where = [](const std::function<void(json&)>& spoil) {
        json section = editsJson(withMotion());
        spoil(section["motion"]);
        const Result<Edits> result = editsFromJson(section);
        EXPECT_FALSE(result) << section.dump();
        return result ? std::string() : result.error().where;
    };
    EXPECT_EQ(where([](json& m) { m = 7; }), "edits.motion");
    EXPECT_EQ(where([](json& m) { m.erase("frames"); }), "edits.motion.frames");
    EXPECT_EQ(where([](json& m) { m["frames"] = json::array(); }), "edits.motion.frames");
    EXPECT_EQ(where([](json& m) { m["frames"][1] = "a"; }), "edits.motion.frames[1]");
    EXPECT_EQ(where([](json& m) {
                  m["frames"][1].erase(7);
                  m["frames"][1].erase(7);
              }),
              "edits.motion.frames[1]");
    EXPECT_EQ(where([](json& m) { m["frames"][1][2] = nullptr; }), "edits.motion.frames[1][2]");
    EXPECT_EQ(where([](json& m) { m["frames"][1][8] = 0.5; }), "edits.motion.frames[1][8]");
    EXPECT_EQ(where([](json& m) { m["frames"][2][0] = m["frames"][1][0]; }),
              "edits.motion.frames[2]");
    EXPECT_EQ(where([](json& m) { m["frames"][0][0] = -1; }), "edits.motion.frames[0]");
    EXPECT_EQ(where([](json& m) { m["frames"][4][0] = 1.1e6; }), "edits.motion.frames[4]");
    EXPECT_EQ(where([](json& m) { m["frames"][3][3] = 1.1e6; }), "edits.motion.frames[3]");
    EXPECT_EQ(where([](json& m) { m["frames"][3][4] = 0.9; }), "edits.motion.frames[3]");
    EXPECT_EQ(where([](json& m) { m["frame_interval_s"] = 0; }), "edits.motion.frames");
    EXPECT_EQ(where([](json& m) { m["name"] = 3; }), "edits.motion.name");
}

TEST(GivenMotion, KeysComeBackFromAProjectToTheLastBit) {
    Edits edits;
    edits.plan.motion = someKeys(4);
    const json section = json::parse(editsJson(edits).dump(1));
    EXPECT_FALSE(section["motion"].contains("frames"));
    const Result<Edits> back = editsFromJson(section);
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_EQ(*back, edits);
    EXPECT_DOUBLE_EQ(back->plan.motion->duration_s(), 3.0);
    json other = section;
    other["motion"]["frames"] = json::array();
    EXPECT_EQ(editsJson(edits, other)["motion"], section["motion"]) << "the frames are replaced";
}

TEST(GivenMotion, BadKeysAreNamedWithTheirPlace) {
    const auto where = [](const std::function<void(json&)>& spoil) {
        Edits edits;
        edits.plan.motion = someKeys(4);
        json section = editsJson(edits);
        spoil(section["motion"]);
        const Result<Edits> result = editsFromJson(section);
        EXPECT_FALSE(result) << section.dump();
        return result ? std::string() : result.error().where;
    };
    EXPECT_EQ(where([](json& m) { m["keys"] = json::array(); }), "edits.motion.keys");
    EXPECT_EQ(where([](json& m) { m["keys"] = json::object(); }), "edits.motion.keys");
    EXPECT_EQ(where([](json& m) { m["frames"] = m["keys"]; }), "edits.motion.keys");
    EXPECT_EQ(where([](json& m) { m["keys"][1] = 5; }), "edits.motion.keys[1]");
    EXPECT_EQ(where([](json& m) { m["keys"][1].push_back(0); }), "edits.motion.keys[1]");
    EXPECT_EQ(where([](json& m) { m["keys"][1].erase(7); }), "edits.motion.keys[1]");
    EXPECT_EQ(where([](json& m) { m["keys"][2][3] = "x"; }), "edits.motion.keys[2][3]");
    // JSON has no other way to write a number that is not finite.
    EXPECT_EQ(where([](json& m) { m["keys"][2][3] = std::nan(""); }), "edits.motion.keys[2][3]");
    EXPECT_EQ(where([](json& m) { m["keys"][2][3] = 1.1e6; }), "edits.motion.keys[2]");
    EXPECT_EQ(where([](json& m) { m["keys"][2][5] = 0.9; }), "edits.motion.keys[2]");
    EXPECT_EQ(where([](json& m) { m["keys"][2][0] = m["keys"][1][0]; }), "edits.motion.keys[2]");
    EXPECT_EQ(where([](json& m) { std::swap(m["keys"][1], m["keys"][2]); }),
              "edits.motion.keys[2]");
    EXPECT_EQ(where([](json& m) { m["keys"][0][0] = -1; }), "edits.motion.keys[0]");
    EXPECT_EQ(where([](json& m) { m["keys"][3][0] = 1e7; }), "edits.motion.keys[3]");
    EXPECT_EQ(where([](json& m) { m = motionJson(someKeys(kMostMotionKeys + 1)); }),
              "edits.motion.keys");
    EXPECT_FALSE(findFault(someKeys(kMostMotionKeys)));
}

TEST(GivenMotion, KeysAreAddedRetimedMovedAndRemoved) {
    test::Editing editing;
    const auto apply = [&](const json& operation) {
        const auto names = editing.apply(json::array({operation}));
        return names ? names->front() : describe(names.error());
    };
    const auto keys = [&] { return editing.state.edits.plan.motion->keys; };
    const json at_two = {{"op", "add_camera_key"},
                         {"time_s", 2.0},
                         {"position", {1.0, 1.0, 1.5}},
                         {"target", {2.0, 1.0, 1.5}}};
    EXPECT_EQ(apply(at_two), "Add camera key 1");
    json first = at_two;
    first["time_s"] = 0.5;
    EXPECT_EQ(apply(first), "Add camera key 1") << "the keys are in the order of their times";
    json last = at_two;
    last["time_s"] = 4.0;
    EXPECT_EQ(apply(last), "Add camera key 3");
    json replaced = at_two;
    replaced["position"] = {1.0, 2.0, 1.5};
    EXPECT_EQ(apply(replaced), "Replace camera key 2");
    ASSERT_EQ(keys().size(), 3U);
    EXPECT_EQ(keys()[1].pose.position, Eigen::Vector3d(1.0, 2.0, 1.5));
    const MotionKey before = keys()[1];
    EXPECT_EQ(apply({{"op", "change_camera_key"}, {"key", 2}, {"time_s", 3.25}}),
              "Retime camera key 2");
    EXPECT_EQ(keys()[1].time_s, 3.25);
    EXPECT_EQ(keys()[1].pose, before.pose);
    EXPECT_EQ(apply({{"op", "change_camera_key"}, {"key", 2}, {"yaw_deg", 90.0}}),
              "Move camera key 2");
    EXPECT_EQ(keys()[1].pose.position, before.pose.position);
    const ProjectState state = editing.state;
    for (const json& bad : {json{{"op", "change_camera_key"}, {"key", 2}, {"time_s", 4.0}},
                            json{{"op", "change_camera_key"}, {"key", 2}, {"time_s", 0.5}},
                            json{{"op", "change_camera_key"}, {"key", 4}, {"time_s", 5.0}},
                            json{{"op", "change_camera_key"}, {"key", 0}, {"time_s", 5.0}},
                            json{{"op", "change_camera_key"}, {"key", 2}},
                            json{{"op", "remove_camera_key"}, {"key", 1.5}}}) {
        EXPECT_FALSE(editing.apply(json::array({bad}))) << bad.dump();
        EXPECT_EQ(editing.state, state);
    }
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(apply({{"op", "remove_camera_key"}, {"key", 1}}), "Remove camera key 1");
    }
    EXPECT_EQ(editing.state.edits, Edits{}) << "without keys, the trajectory is planned";
    EXPECT_FALSE(editing.apply({{{"op", "remove_camera_key"}, {"key", 1}}}));
    ASSERT_TRUE(editing.apply(json::array({setMotion()})));
    EXPECT_FALSE(editing.apply(json::array({at_two}))) << "an imported path has no keys";
}

TEST(GivenMotion, HasALargestNumberOfFrames) {
    GivenMotion motion{"long", 0.1, std::vector<MotionFrame>(kMostMotionFrames)};
    for (std::size_t i = 0; i < motion.frames.size(); ++i) {
        motion.frames[i].time_s = static_cast<double>(i);
    }
    EXPECT_FALSE(findFault(motion));
    motion.frames.push_back(motion.frames.back());
    motion.frames.back().time_s += 1.0;
    ASSERT_TRUE(findFault(motion));
    EXPECT_FALSE(findFault(motion)->frame);
    motion.frames.resize(2);
    motion.frames[1].pose.position.z() = std::nan("");
    EXPECT_EQ(findFault(motion)->frame, 1U);
}

TEST(GivenMotion, OperationsSetAndClearIt) {
    test::Editing editing;
    const auto names = editing.apply(json::array({setMotion()}));
    ASSERT_TRUE(names) << describe(names.error());
    EXPECT_EQ(names->front(), "Set the camera motion drone \u00e9");
    EXPECT_EQ(*editing.state.edits.plan.motion, someMotion());
    ASSERT_TRUE(editing.apply({{{"op", "clear_motion"}}}));
    EXPECT_FALSE(editing.state.edits.plan.motion);
    EXPECT_EQ(editing.state.edits, Edits{});
    EXPECT_FALSE(editing.apply({{{"op", "clear_motion"}}}));
    // As a person writes it: no name, no interval, no numbers of paths.
    ASSERT_TRUE(
        editing.apply({{{"op", "set_motion"},
                        {"frames", {{0, 1, 1, 1, 0, 0, 0, 1}, {0.25, 1, 2, 1, 0, 0, 0, 1}}}}}));
    EXPECT_EQ(editing.state.edits.plan.motion->frame_interval_s, 0.25);
    const ProjectState before = editing.state;
    const auto bad = editing.apply({{{"op", "set_motion"}, {"frames", {{0, 1, 1}}}}});
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().where, "operation 1, frames[0]");
    EXPECT_EQ(editing.state, before);
}

TEST(GivenMotion, IsTrimmedToAPartWhoseTimesBeginAtZero) {
    test::Editing editing;
    EXPECT_FALSE(editing.apply({{{"op", "trim_motion"}, {"from_s", 1}}})) << "there is none";
    ASSERT_TRUE(editing.apply(
        {{{"op", "set_motion"},
          {"frames",
           {{0, 1, 1, 1, 0, 0, 0, 1}, {2, 2, 1, 1, 0, 0, 0, 1}, {5, 3, 1, 1, 0, 0, 0, 1}}}}}));
    const auto done = editing.apply({{{"op", "trim_motion"}, {"from_s", 1}, {"to_s", 5}}});
    ASSERT_TRUE(done) << describe(done.error());
    EXPECT_EQ(done->front(), "Trim the camera motion to 3.0 s");
    const auto& frames = editing.state.edits.plan.motion->frames;
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0].time_s, 0.0);
    EXPECT_EQ(frames[0].pose.position.x(), 2.0);
    EXPECT_EQ(frames[1].time_s, 3.0);
    EXPECT_FALSE(editing.apply({{{"op", "trim_motion"}, {"from_s", 1}, {"to_s", 2}}}));
    ASSERT_TRUE(editing.apply(json::array({motionOperation(someKeys(3))})));
    ASSERT_TRUE(editing.apply({{{"op", "trim_motion"}, {"to_s", 1.5}}}));
    EXPECT_EQ(editing.state.edits.plan.motion->keys.size(), 2U);
}

TEST(GivenMotion, IsUndoneAndSurvivesAnAutosave) {
    test::Editing editing;
    CommandStack stack(editing.state);
    const auto step = [&](const json& operation) {
        const auto names = editing.apply(json::array({operation}));
        ASSERT_TRUE(names) << describe(names.error());
        stack.push(names->front(), editing.state);
    };
    step(setMotion());
    step({{"op", "exclude"}, {"object", "lamp"}});
    step(motionOperation(someKeys(3)));
    step({{"op", "change_camera_key"}, {"key", 2}, {"time_s", 1.5}});
    step({{"op", "clear_motion"}});
    step({{"op", "set"}, {"name", "fill"}, {"value", 0.5}});
    const json saved = json::parse(historyJson(stack.history()).dump());
    EXPECT_TRUE(saved["steps"][1].contains("motion"));
    EXPECT_FALSE(saved["steps"][2].contains("motion")) << "a step that keeps it stores it again";
    const auto back = historyFromJson(saved);
    ASSERT_TRUE(back) << describe(back.error());
    for (std::size_t i = 0; i < stack.history().steps.size(); ++i) {
        EXPECT_EQ(*back->steps[i].state, *stack.history().steps[i].state) << "step " << i;
    }
    // The oldest steps may be left out, also the one that set the motion.
    stack.goTo(2);
    const auto newest = historyFromJson(historyJson(stack.history(), 3));
    ASSERT_TRUE(newest);
    EXPECT_EQ(*newest->steps[0].state, *stack.history().steps[2].state);
    EXPECT_EQ(*stack.undo()->edits.plan.motion, someMotion());
    EXPECT_FALSE(stack.undo()->edits.plan.motion);
    json spoilt = saved;
    spoilt["steps"][1]["motion"]["frames"][0][1] = "x";
    EXPECT_FALSE(historyFromJson(spoilt));
}

TEST(GivenMotion, BecomesATrajectoryAndBack) {
    const GivenMotion motion = someMotion();
    Trajectory trajectory = trajectoryOf(motion);
    ASSERT_EQ(trajectory.frames.size(), motion.frames.size());
    EXPECT_EQ(trajectory.frame_interval_s, motion.frame_interval_s);
    EXPECT_EQ(trajectory.frames[2].path, 0);
    EXPECT_EQ(trajectory.frames[3].path, 1);
    for (TrajectoryFrame& frame : trajectory.frames) frame.time_s += 1.5e9;
    const GivenMotion back = givenMotion("back", trajectory);
    for (std::size_t i = 0; i < motion.frames.size(); ++i) {
        EXPECT_EQ(back.frames[i].pose, motion.frames[i].pose);
        EXPECT_NEAR(back.frames[i].time_s, motion.frames[i].time_s, 1e-6);
    }
    EXPECT_EQ(back.frames[0].time_s, 0.0);
    EXPECT_FALSE(findFault(back));
}

}  // namespace dollytrack::given_motion_test
