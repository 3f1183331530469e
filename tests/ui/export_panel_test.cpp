#include "ui/panels/export/export_panel.h"

#include "engine/camera/picture_params.h"
#include "engine/camera/sensor_params.h"
#include "tests/ui/screen.h"
#include "ui/panels/export/export_draft.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dollytrack::ui::export_panel_test {
namespace {

/// Some of a project's parameters, as the panel gets them.
struct Parameters {
    Parameters() : fields(list(picture, sensor)), standard(list(usual_picture, usual_sensor)) {}
    Parameters(const Parameters&) = delete;  // its fields point into it
    Parameters& operator=(const Parameters&) = delete;

    static FieldList list(PictureParams& picture, SensorParams& sensor) {
        FieldCollector collector;
        collector.beginSection("picture");
        visitPictureParams(picture, collector);
        FieldList all = collector.take();
        const FieldList more = listSensorFields(sensor);
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void showIn(ExportView& view) {
        view.parameters = &fields;
        view.standard = &standard;
    }

    PictureParams picture;
    SensorParams sensor;
    PictureParams usual_picture;
    SensorParams usual_sensor;
    FieldList fields;
    FieldList standard;
};

struct Export {
    Export() {
        view.project = "room";
        view.frame_count = 100;
        view.current_frame = 42;
        view.modalities = {{"rgb", "", true, true}, {"depth", ""}, {"instance", ""}};
        view.formats = {{"coco", ""}, {"camera_json", ""}, {"hdf5", "", false, true}};
        draft.folder = "/tmp/dataset";
    }
    void addJob(ExportState state) {
        ExportJob job;
        job.id = static_cast<int>(view.jobs.size()) + 1;
        job.state = state;
        job.request.name = "room";
        job.request.folder = "/tmp/dataset";
        job.frames_done = state == ExportState::Waiting ? 0 : 10;
        job.frames = 100;
        view.jobs.push_back(job);
    }
    void draw() {
        const ExportActions now = drawExportPanel(view, draft);
        if (!now.edited.empty()) actions.edited = now.edited;
        edited.insert(now.edited);
        actions.finished = actions.finished || now.finished;
        const auto keep = [](int& kept, int asked) { kept = asked != 0 ? asked : kept; };
        actions.add_current = actions.add_current || now.add_current;
        actions.choose_folder = actions.choose_folder || now.choose_folder;
        actions.choose_rig = actions.choose_rig || now.choose_rig;
        actions.add_files = actions.add_files || now.add_files;
        actions.toggle_hold = actions.toggle_hold || now.toggle_hold;
        keep(actions.cancel, now.cancel);
        keep(actions.resume, now.resume);
        keep(actions.remove, now.remove);
        keep(actions.earlier, now.earlier);
        keep(actions.later, now.later);
        keep(actions.open_folder, now.open_folder);
        keep(actions.show_sheet, now.show_sheet);
    }
    ExportView view;
    ExportDraft draft;
    ExportActions actions;
    std::set<std::string> edited;  // names of all edited parameters
};

TEST(ExportDraft, NamesTheChosenModalitiesThatCannotBeWritten) {
    Export panel;
    EXPECT_EQ(leftOut(panel.view, panel.draft), "");
    panel.view.modalities.push_back({"hdr", "", false, false, "", "The images are not traced."});
    panel.view.modalities.push_back(
        {"residual", "", false, false, "", "The images are not traced."});
    EXPECT_EQ(leftOut(panel.view, panel.draft), "") << "none of them is wanted";
    panel.draft.turned_modalities = {"hdr", "residual"};
    EXPECT_EQ(leftOut(panel.view, panel.draft), "hdr, residual");
    EXPECT_EQ(requestOf(panel.view, panel.draft).modalities,
              (std::vector<std::string>{"rgb", "depth", "instance"}));
    panel.view.modalities.back().why_not.clear();
    EXPECT_EQ(leftOut(panel.view, panel.draft), "hdr");
}

TEST(ExportPanel, AsksForWhatItsButtonsSay) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    for (const char* name : {"export.add", "export.add_files", "export.choose_folder"}) {
        ASSERT_TRUE(screen.click(name)) << name << " among " << screen.names();
    }
    EXPECT_TRUE(panel.actions.add_current);
    EXPECT_TRUE(panel.actions.add_files);
    EXPECT_TRUE(panel.actions.choose_folder);
}

TEST(ExportPanel, MakesTheRequestThatItShows) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_EQ(requestOf(panel.view, panel.draft).range, "::") << "all, unasked";
    EXPECT_TRUE(requestOf(panel.view, panel.draft).modalities.empty()) << "all, unasked";
    screen.typeInto("export.first", "10");
    screen.typeInto("export.last", "19");
    screen.typeInto("export.step", "3");
    screen.click("export.modality.depth");
    screen.click("export.format.coco");
    screen.click("export.overwrite");
    const ExportRequest request = requestOf(panel.view, panel.draft);
    EXPECT_EQ(request.range, "10:20:3");
    EXPECT_EQ(frameCountOf(panel.view, panel.draft), 4);  // 10, 13, 16, 19
    EXPECT_EQ(request.modalities, (std::vector<std::string>{"rgb", "instance"}));
    EXPECT_EQ(request.formats, std::vector<std::string>{"camera_json"});
    EXPECT_TRUE(request.overwrite);
    EXPECT_EQ(request.name, "room");
    screen.click("export.current_only");
    EXPECT_EQ(requestOf(panel.view, panel.draft).range, "42:43:1");
    EXPECT_EQ(frameCountOf(panel.view, panel.draft), 1);
}

TEST(ExportPanel, FitsItsFramesToAShorterTrajectory) {
    Export panel;
    panel.draft.first = 80;
    panel.draft.last = 90;
    panel.view.frame_count = 50;
    EXPECT_EQ(requestOf(panel.view, panel.draft).range, "49:50:1");
    panel.draft.last = -1;
    panel.draft.first = 0;
    EXPECT_EQ(requestOf(panel.view, panel.draft).range, "::");
}

// A range beyond the last frame stays as typed.
TEST(ExportPanel, SaysWhenTheRangeHasFramesThatAreNotThere) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_EQ(screen.names().find("range_note"), std::string::npos);
    screen.typeInto("export.last", "150");
    EXPECT_NE(screen.names().find("range_note"), std::string::npos);
    EXPECT_EQ(panel.draft.last, 150);
    EXPECT_EQ(frameCountOf(panel.view, panel.draft), 100);
    EXPECT_TRUE(screen.enabled("export.add"));
    panel.view.frame_count = 200;  // a new plan has these frames
    screen.frame(2);
    EXPECT_EQ(screen.names().find("range_note"), std::string::npos);
    EXPECT_EQ(requestOf(panel.view, panel.draft).range, "0:151:1");
    screen.typeInto("export.first", "300");
    EXPECT_NE(screen.names().find("range_note"), std::string::npos);
    EXPECT_FALSE(screen.enabled("export.add")) << "not one frame of it is there";
}

// Widgets must not move under the mouse, where a double click would hit the wrong one.
TEST(ExportPanel, NothingMovesForWhatThereIsToSay) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    const auto places = [&] {
        std::vector<float> tops;
        for (const char* name : {"export.first", "export.current_only", "export.modality.rgb",
                                 "export.overwrite", "export.add"}) {
            tops.push_back(screen.find(name)->top);
        }
        return tops;
    };
    const std::vector<float> before = places();
    panel.view.folder_says = "It will be created, with all folders below a folder with a long name";
    screen.frame(2);
    EXPECT_EQ(places(), before);
    panel.view.why_not_folder = "Other files are there: choose another folder, or tick the box.";
    panel.draft.last = 150;
    screen.frame(2);
    EXPECT_EQ(places(), before);
}

// Other projects have their own number of frames.
TEST(ExportPanel, TakesTheRangeForOtherProjectsAsItIsMeant) {
    ExportDraft draft;
    EXPECT_EQ(rangeForOthers(draft), "::");
    draft.first = 10;
    draft.step = 5;
    EXPECT_EQ(rangeForOthers(draft), "10::5");
    draft.last = 59;
    EXPECT_EQ(rangeForOthers(draft), "10:60:5");
    draft.current_only = true;
    EXPECT_EQ(rangeForOthers(draft), "::");
}

// Settings of the other mode are not offered, and none are when no colour image is written.
TEST(ExportPanel, ChoosesHowPicturesAreMade) {
    Export panel;
    Parameters project;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_EQ(screen.names().find("export.antialias"), std::string::npos) << "there is no project";
    project.showIn(panel.view);
    screen.frame(2);
    EXPECT_EQ(screen.names().find("reference_samples"), std::string::npos);
    ASSERT_TRUE(screen.click("export.antialias")) << screen.names();
    ASSERT_TRUE(screen.click("choice.8x")) << screen.names();
    EXPECT_EQ(project.picture.antialias, Antialias::Samples8);
    EXPECT_TRUE(panel.edited.contains("antialias"));
    ASSERT_TRUE(screen.click("export.render_mode"));
    ASSERT_TRUE(screen.click("choice.reference"));
    EXPECT_EQ(project.picture.render_mode, RenderMode::Reference);
    screen.frame(2);
    EXPECT_NE(screen.names().find("export.reference_samples"), std::string::npos);
    EXPECT_EQ(screen.names().find("antialias"), std::string::npos);
    panel.draft.turned_modalities = {"rgb"};
    screen.frame(2);
    EXPECT_EQ(screen.names().find("export.render_mode"), std::string::npos);
    panel.draft.turned_formats = {"hdf5"};  // has the colours in its own files
    screen.frame(2);
    EXPECT_NE(screen.names().find("export.render_mode"), std::string::npos);
}

// A sensor's settings are shown when it records something, and a preset sets its values.
TEST(ExportPanel, ChoosesTheSensor) {
    Export panel;
    Parameters project;
    project.showIn(panel.view);
    panel.view.modalities.push_back(
        {"rgb_sensor", "8-bit colour images of a simulated camera sensor", false, true});
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_EQ(screen.names().find("sensor_preset"), std::string::npos);
    ASSERT_TRUE(screen.click("export.modality.rgb_sensor")) << screen.names();
    screen.frame(2);
    ASSERT_TRUE(screen.click("export.sensor_preset")) << screen.names();
    ASSERT_TRUE(screen.click("choice.webcam"));
    EXPECT_EQ(project.sensor, sensorPreset(SensorPreset::Webcam));
    EXPECT_TRUE(panel.edited.contains("sensor_preset"));
    // Choosing the same preset again resets the values that were changed.
    project.sensor.k1 = 0.3;
    panel.edited.clear();
    ASSERT_TRUE(screen.click("export.sensor_preset"));
    ASSERT_TRUE(screen.click("choice.webcam"));
    EXPECT_EQ(project.sensor, sensorPreset(SensorPreset::Webcam));
    EXPECT_TRUE(panel.edited.contains("sensor_preset"));
}

TEST(ExportPanel, TakesARig) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_TRUE(requestOf(panel.view, panel.draft).rig.empty());
    ASSERT_TRUE(screen.click("export.choose_rig")) << screen.names();
    EXPECT_TRUE(panel.actions.choose_rig);
    panel.draft.rig = "/cameras.json";
    EXPECT_EQ(requestOf(panel.view, panel.draft).rig, "/cameras.json");
}

TEST(ExportPanel, SetsTheSizeOfTheImage) {
    Export panel;
    int width = 640;
    int height = 480;
    FieldList fields = {
        {"camera", "width_px", Field::Integer{{16, 8192, "px", "Width"}, &width}},
        {"camera", "height_px", Field::Integer{{16, 8192, "px", "Height"}, &height}}};
    int standard_width = 640;
    int standard_height = 480;
    const FieldList standard = {
        {"camera", "width_px", Field::Integer{{16, 8192, "px", "Width"}, &standard_width}},
        {"camera", "height_px", Field::Integer{{16, 8192, "px", "Height"}, &standard_height}}};
    panel.view.parameters = &fields;
    panel.view.standard = &standard;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    screen.doubleClick("export.height_px");
    screen.press(GLFW_KEY_A, true);
    screen.type("360");
    screen.press(GLFW_KEY_ENTER);
    screen.frame(2);
    EXPECT_EQ(height, 360);
    EXPECT_EQ(width, 640);
    EXPECT_EQ(panel.actions.edited, "height_px");
    EXPECT_TRUE(panel.actions.finished);
    screen.click("export.keep_ratio");
    ASSERT_TRUE(screen.typeInto("export.width_px", "320"));
    EXPECT_EQ(width, 320);
    EXPECT_EQ(height, 180) << "as 640 is to 360";
    ASSERT_TRUE(screen.typeInto("export.height_px", "90"));
    EXPECT_EQ(width, 160);
}

// Only the user knows which of the two was meant.
TEST(ExportPanel, WaitsForARangeThatIsTheRightWayRound) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    screen.typeInto("export.last", "4");
    screen.typeInto("export.first", "6");
    EXPECT_EQ(panel.draft.first, 6);
    EXPECT_EQ(panel.draft.last, 4);
    EXPECT_NE(screen.names().find("range_note"), std::string::npos);
    EXPECT_FALSE(screen.enabled("export.add"));
    EXPECT_FALSE(screen.enabled("export.add_files"));
    EXPECT_EQ(frameCountOf(panel.view, panel.draft), 0);
    screen.typeInto("export.last", "8");
    EXPECT_EQ(screen.names().find("range_note"), std::string::npos);
    EXPECT_TRUE(screen.enabled("export.add"));
    EXPECT_EQ(requestOf(panel.view, panel.draft).range, "6:9:1");
}

TEST(ExportPanel, WritesNowhereThatItCannot) {
    Export panel;
    panel.view.folder_says = "It will be created.";
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_TRUE(screen.enabled("export.add"));
    panel.view.why_not_folder = "This is a file, not a folder.";
    screen.frame(2);
    EXPECT_FALSE(screen.enabled("export.add"));
    // Other projects get their own folders, whether or not one is chosen here.
    panel.draft.folder.clear();
    screen.frame(2);
    EXPECT_TRUE(screen.enabled("export.add_files"));
}

TEST(ExportPanel, CannotExportNothing) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 380, 900);
    EXPECT_TRUE(screen.enabled("export.add"));
    for (const char* name : {"rgb", "depth", "instance"}) {
        screen.click(std::string("export.modality.") + name);
    }
    EXPECT_FALSE(screen.enabled("export.add"));
    screen.click("export.modality.rgb");
    EXPECT_TRUE(screen.enabled("export.add"));
    panel.draft.folder.clear();
    screen.frame();
    EXPECT_FALSE(screen.enabled("export.add"));
    panel.draft.folder = "/tmp/dataset";
    panel.view.why_not = "Open a scene first.";
    screen.frame();
    EXPECT_FALSE(screen.enabled("export.add"));
}

/// A panel with two groups of modalities, a modality that cannot be written, and three presets.
struct Presets : Export {
    Presets() {
        view.modalities = {
            {"rgb", "colour images", true, true, "Colour"},
            {"hdr", "light before the tone curve", false, true, "Colour", "Not now."},
            {"depth", "distance in mm", true, false, "Geometry"},
            {"disparity", "of a stereo pair", false, false, "Geometry"}};
        view.presets = {{"default", "Default", "", {"rgb", "depth"}, {"coco", "camera_json"}},
                        {"nerf", "NeRF", "", {"rgb"}, {"hdf5"}},
                        {"everything",
                         "Everything",
                         "",
                         {"rgb", "hdr", "depth", "disparity"},
                         {"coco", "camera_json", "hdf5"}}};
    }
    [[nodiscard]] ExportRequest request() const { return requestOf(view, draft); }
};

TEST(ExportPanel, APresetSelectsExactlyItsContents) {
    Presets panel;
    test::Screen screen([&] { panel.draw(); }, 1280, 300);
    EXPECT_TRUE(panel.request().modalities.empty()) << "the default set";
    ASSERT_TRUE(screen.click("export.preset.nerf")) << screen.names();
    EXPECT_EQ(panel.request().modalities, std::vector<std::string>{"rgb"});
    EXPECT_EQ(panel.request().formats, std::vector<std::string>{"hdf5"});
    // What cannot be written is left out, and its check box cannot be clicked.
    ASSERT_TRUE(screen.click("export.preset.everything"));
    EXPECT_EQ(panel.request().modalities, (std::vector<std::string>{"rgb", "depth", "disparity"}));
    EXPECT_EQ(panel.request().formats, (std::vector<std::string>{"coco", "camera_json", "hdf5"}));
    EXPECT_FALSE(screen.enabled("export.modality.hdr"));
    panel.view.modalities[1].why_not.clear();
    EXPECT_EQ(panel.request().modalities.size(), 4U);
    ASSERT_TRUE(screen.click("export.preset.default"));
    EXPECT_TRUE(panel.request().modalities.empty());
    EXPECT_TRUE(panel.request().formats.empty());
}

TEST(ExportPanel, ShowsWhatWasChangedAfterAPreset) {
    Presets panel;
    test::Screen screen([&] { panel.draw(); }, 1280, 300);
    EXPECT_TRUE(screen.shows("export.preset")) << screen.names();
    screen.click("export.preset.nerf");
    EXPECT_EQ(changesOfPreset(panel.view, panel.draft), "");
    const auto before = screen.find("export.filter");
    screen.click("export.modality.disparity");
    screen.click("export.format.hdf5");
    EXPECT_EQ(changesOfPreset(panel.view, panel.draft), "+ disparity, - hdf5");
    EXPECT_TRUE(screen.shows("export.preset_modified")) << screen.names();
    EXPECT_EQ(screen.find("export.filter")->left, before->left) << "nothing moves";
    screen.click("export.modality.disparity");
    screen.click("export.format.hdf5");
    EXPECT_TRUE(screen.shows("export.preset")) << "as chosen again";
    screen.click("export.modality.rgb");
    screen.click("export.preset.nerf");
    EXPECT_EQ(changesOfPreset(panel.view, panel.draft), "") << "chosen again";
}

TEST(ExportPanel, FindsContentsByNameDescriptionAndGroup) {
    Presets panel;
    test::Screen screen([&] { panel.draw(); }, 1280, 300);
    const auto shown = [&](const char* filter) {
        panel.draft.filter = filter;
        screen.frame(2);
        std::string names;
        for (const ExportChoice& one : panel.view.modalities) {
            if (screen.shows("export.modality." + one.name)) names += one.name + " ";
        }
        return names;
    };
    EXPECT_EQ(shown(""), "rgb hdr depth disparity ");
    EXPECT_EQ(shown("DISP"), "disparity ");
    EXPECT_EQ(shown("tone curve"), "hdr ");
    EXPECT_EQ(shown("geometry"), "depth disparity ");
    EXPECT_EQ(shown("zzz"), "");
    EXPECT_TRUE(panel.request().modalities.empty()) << "hidden ones stay selected";
}

TEST(ExportPanel, OffersWhatAJobsStateAllows) {
    Export panel;
    for (const ExportState state : {ExportState::Running, ExportState::Waiting, ExportState::Done,
                                    ExportState::Cancelled, ExportState::Failed}) {
        panel.addJob(state);
    }
    panel.view.jobs[2].contact_sheet = "/tmp/dataset/contact_sheet.jpg";
    test::Screen screen([&] { panel.draw(); }, 380, 1400);
    EXPECT_FALSE(screen.shows("export.job.1.resume"));
    EXPECT_FALSE(screen.shows("export.job.3.cancel"));
    EXPECT_FALSE(screen.shows("export.job.2.open"));
    EXPECT_FALSE(screen.enabled("export.job.1.earlier"));
    EXPECT_FALSE(screen.enabled("export.job.5.later"));
    for (const char* name :
         {"export.job.1.cancel", "export.job.2.earlier", "export.job.2.later", "export.job.3.sheet",
          "export.job.3.open", "export.job.4.resume", "export.job.5.remove", "export.hold"}) {
        ASSERT_TRUE(screen.click(name)) << name << " among " << screen.names();
    }
    EXPECT_EQ(panel.actions.cancel, 1);
    EXPECT_EQ(panel.actions.earlier, 2);
    EXPECT_EQ(panel.actions.later, 2);
    EXPECT_EQ(panel.actions.show_sheet, 3);
    EXPECT_EQ(panel.actions.open_folder, 3);
    EXPECT_EQ(panel.actions.resume, 4);
    EXPECT_EQ(panel.actions.remove, 5);
    EXPECT_TRUE(panel.actions.toggle_hold);
}

// The size that is left for the panel in a window of 1280 x 720.
TEST(ExportPanel, ShowsItsButtonAndTheProgressWhereItIsShort) {
    Export panel;
    test::Screen screen([&] { panel.draw(); }, 1280, 165);
    const auto whole = [&](const char* name) {
        const auto item = screen.find(name);
        return item && item->bottom - item->top > 20 && item->right - item->left > 60;
    };
    EXPECT_TRUE(whole("export.add")) << screen.names();
    EXPECT_FALSE(screen.shows("export.progress"));
    panel.addJob(ExportState::Running);
    screen.frame(2);
    EXPECT_TRUE(whole("export.add"));
    EXPECT_TRUE(whole("export.progress")) << screen.names();
    ASSERT_TRUE(screen.click("export.add"));
    EXPECT_TRUE(panel.actions.add_current);
}

// After Cancel, Continue must not appear under the mouse.
TEST(ExportPanel, ASecondClickOnCancelDoesNotContinue) {
    Export panel;
    panel.addJob(ExportState::Running);
    test::Screen screen([&] { panel.draw(); }, 1280, 300);
    const auto before = screen.find("export.job.1.cancel");
    ASSERT_TRUE(before);
    panel.view.jobs[0].state = ExportState::Cancelled;
    screen.frame(2);
    const auto now = screen.find("export.job.1.cancel");
    ASSERT_TRUE(now);
    EXPECT_EQ(now->left, before->left);
    EXPECT_FALSE(screen.enabled("export.job.1.cancel"));
    screen.click("export.job.1.cancel");
    EXPECT_EQ(panel.actions.resume, 0);
    EXPECT_TRUE(screen.click("export.job.1.resume"));
    EXPECT_EQ(panel.actions.resume, 1);
}

TEST(ExportPanel, SaysTimesAsPeopleDo) {
    EXPECT_EQ(durationText(9.4), "9 s");
    EXPECT_EQ(durationText(250), "4 min 10 s");
    EXPECT_EQ(durationText(7265), "2 h 1 min");
    EXPECT_EQ(durationText(-3), "0 s");
}

}  // namespace
}  // namespace dollytrack::ui::export_panel_test
