#include "ui/panels/scene/preview_panel.h"

#include "tests/ui/screen.h"
#include "ui/panels/scene/image_viewer.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace dollytrack::ui::preview_panel_test {
namespace {

struct Preview {
    Preview() {
        image.texture = 1;  // never drawn: there is no window
        image.record.width = 640;
        image.record.height = 480;
        view.image = &image;
        view.what = "Frame 12";
    }
    void draw() {
        view.low = {0, 0};
        view.high = ImGui::GetIO().DisplaySize;
        const PreviewActions actions = drawPreviewPanel(view, state);
        changes += actions.changed;
        saves += actions.save_png;
    }
    PreviewImage image;
    PreviewView view;
    PreviewState state;
    int changes = 0;
    int saves = 0;
};

TEST(PreviewPanel, ChoosesAModality) {
    Preview preview;
    test::Screen screen([&] { preview.draw(); }, 900, 560);
    screen.click("preview.modality");
    ASSERT_TRUE(screen.click("preview.modality.depth")) << screen.names();
    EXPECT_EQ(preview.state.modality, Modality::Depth);
    EXPECT_EQ(preview.changes, 1);
    screen.click("preview.modality");
    screen.click("preview.modality.depth");
    EXPECT_EQ(preview.changes, 1) << "the same again is no change";
}

// The title bar must stay in sight: it folds and moves the panel.
TEST(PreviewPanel, APortraitFitsIntoTheViewport) {
    Preview preview;
    preview.image.record.width = 320;
    preview.image.record.height = 480;
    for (const float height : {560.0F, 300.0F, 120.0F}) {
        test::Screen screen([&] { preview.draw(); }, 660, height);
        screen.frame(2);
        const auto title = screen.find("preview.fold");
        const auto picture = screen.find("preview.picture");
        ASSERT_TRUE(title && picture) << screen.names();
        EXPECT_GE(title->top, 0.0F) << height;
        EXPECT_LE(picture->bottom, height);
        EXPECT_NEAR((picture->right - picture->left) / (picture->bottom - picture->top), 2.0 / 3.0,
                    0.05);
        EXPECT_LT(picture->bottom - picture->top, 300.0F) << "no longer than a landscape is wide";
    }
}

TEST(PreviewPanel, FillsItsDockUntilItFloats) {
    Preview preview;
    test::Screen screen(
        [&] {
            preview.view.docked = preview.state.docked;
            preview.draw();
        },
        360, 240);
    screen.frame(2);
    const auto docked = screen.find("preview.picture");
    ASSERT_TRUE(docked) << screen.names();
    EXPECT_NEAR(docked->bottom, 240.0F, 2.0F);
    EXPECT_NEAR((docked->right - docked->left) / (docked->bottom - docked->top), 4.0 / 3.0, 0.02);
    EXPECT_FALSE(screen.shows("preview.grip"));
    screen.click("preview.dock");
    EXPECT_FALSE(preview.state.docked);
    EXPECT_TRUE(screen.shows("preview.grip"));
    screen.click("preview.dock");
    EXPECT_TRUE(preview.state.docked);
}

TEST(PreviewPanel, GrowsFoldsAndMoves) {
    Preview preview;
    test::Screen screen([&] { preview.draw(); }, 900, 560);
    const auto small = screen.find("preview.picture");
    ASSERT_TRUE(small);
    EXPECT_NEAR((small->right - small->left) / (small->bottom - small->top), 4.0 / 3.0, 0.02);
    screen.click("preview.full");
    const auto large = screen.find("preview.picture");
    ASSERT_TRUE(large);
    EXPECT_GT(large->bottom - large->top, 500);
    screen.click("preview.full");
    screen.drag("preview.grip", -80, 0);
    const auto wider = screen.find("preview.picture");
    ASSERT_TRUE(wider);
    EXPECT_NEAR(wider->right - wider->left, small->right - small->left + 80, 3);
    screen.drag("preview.title", -500, -300);
    EXPECT_EQ(preview.state.corner, PaneCorner::TopLeft);
    screen.click("preview.fold");
    EXPECT_FALSE(screen.shows("preview.picture"));
    EXPECT_TRUE(screen.shows("preview.title"));
}

TEST(PreviewPanel, CanBePinnedOnlyToWhatIsSelected) {
    Preview preview;
    test::Screen screen([&] { preview.draw(); }, 900, 560);
    EXPECT_FALSE(screen.enabled("preview.pin"));
    preview.view.point_selected = true;
    screen.frame();
    screen.click("preview.pin");
    EXPECT_TRUE(preview.state.shows_selection);
    EXPECT_EQ(preview.changes, 1);
    screen.click("preview.save");
    EXPECT_EQ(preview.saves, 1);
    preview.view.why_not = "There is no trajectory yet.";
    screen.frame();
    EXPECT_FALSE(screen.enabled("preview.save"));
}

TEST(PreviewPanel, ValuesOfAPixelLeaveThePictureInSight) {
    Preview preview;
    test::Screen screen([&] { preview.draw(); }, 900, 560);
    ASSERT_TRUE(screen.hover("preview.picture"));
    screen.frame(2);
    const auto picture = screen.find("preview.picture");
    const auto values = screen.find("preview.values");
    ASSERT_TRUE(values) << screen.names();
    EXPECT_LT(values->bottom - values->top, 0.25F * (picture->bottom - picture->top));
    const float mouse = ImGui::GetIO().MousePos.y;
    EXPECT_TRUE(mouse < values->top || mouse > values->bottom);
}

TEST(PreviewPanel, MapsTheMouseOntoPixelsExactly) {
    for (const float scale : {0.37F, 1.0F, 2.5F}) {
        const ImVec2 low(13.25F, 41.5F);
        const ImVec2 size(64 * scale, 48 * scale);
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                const ImVec2 mouse(low.x + (float(x) + 0.5F) * scale,
                                   low.y + (float(y) + 0.5F) * scale);
                const auto pixel = pixelAt(mouse, low, size, 64, 48);
                ASSERT_TRUE(pixel);
                ASSERT_EQ(pixel->x, x);
                ASSERT_EQ(pixel->y, y);
            }
        }
        EXPECT_FALSE(pixelAt({low.x - 0.5F, low.y}, low, size, 64, 48));
        EXPECT_FALSE(pixelAt({low.x + size.x + 0.5F, low.y}, low, size, 64, 48));
    }
}

TEST(ImageViewer, ZoomsToTheMouseAndFitsAgain) {
    ImageViewerState state;
    bool closed = false;
    const ImageViewerView view{1, 2000, 1000, "contact_sheet.jpg", ""};
    test::Screen screen([&] { closed = drawImageViewer(view, state).close || closed; }, 900, 560);
    screen.hover("image.pane");
    ImGui::GetIO().MouseWheel = 5.0F;
    screen.frame();
    EXPECT_GT(state.zoom, 0.9);
    EXPECT_NEAR(state.center_x, 0.5, 0.01) << "the mouse was in the middle";
    screen.drag("image.pane", 100, 0);
    EXPECT_NEAR(state.center_x, 0.5 - 100 / state.zoom / 2000, 0.01);
    screen.click("image.actual");
    EXPECT_EQ(state.zoom, 1.0);
    screen.click("image.fit");
    EXPECT_EQ(state.zoom, 0.0);
    screen.click("image.close");
    EXPECT_TRUE(closed);
}

}  // namespace
}  // namespace dollytrack::ui::preview_panel_test
