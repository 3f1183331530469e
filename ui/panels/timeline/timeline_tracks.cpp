#include "ui/panels/timeline/timeline_tracks.h"

#include "ui/overlays/palette.h"
#include "ui/panels/timeline/camera_keys.h"
#include "ui/panels/timeline/frame_axis.h"
#include "ui/panels/timeline/timeline_strips.h"
#include "ui/panels/timeline/timeline_time.h"
#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

/// Positions of the rows, px on the screen.
struct Rows {
    float labels = 0;  // left edge of the row names
    float ruler = 0;
    float kept = 0;   // top of the kept plan's row, which has no height if no plan is kept
    float bands = 0;  // top of the room row, which has no height if there is only one room
    float keys = 0;
    float strips = 0;
    float strip_height = 0;
    float bottom = 0;
};

float rowHeight() {
    return std::ceil(ImGui::GetTextLineHeight() + scaled(3));
}

/// Tick interval: 1, 2 or 5 times a power of ten seconds, wide enough for the numbers.
double tickSeconds(double seconds_per_pixel) {
    const double least = seconds_per_pixel * scaled(70);
    const double power = std::pow(10.0, std::floor(std::log10(std::max(least, 1e-3))));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least) return step * power;
    }
    return 10.0 * power;
}

void drawRuler(const TimelineView& view, const FrameAxis& axis, const Rows& rows) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 line = ImGui::GetColorU32(palette().panel_line);
    const double shown_s = timeOf(view, axis.first() + axis.shown()) - timeOf(view, axis.first());
    const double step = tickSeconds(shown_s / (axis.right() - axis.left()));
    // A frame's time is at the centre of its interval, like the playhead and the key frames.
    const double begin = timeOf(view, std::max(axis.first() - 0.5, 0.0));
    const auto first = static_cast<long>(std::ceil(begin / step));
    float free = axis.left();  // right of the last text
    for (long i = first;; ++i) {
        const double seconds = static_cast<double>(i) * step;
        const auto x = static_cast<float>(axis.xOf(frameAt(view, seconds) + 0.5));
        if (x > axis.right()) break;
        list->AddLine({x, rows.ruler}, {x, rows.bottom}, line);
        nameArea(fmt::format("timeline.tick.{:g}", seconds), x, rows.ruler, x + 1, rows.bottom);
        const std::string text = fmt::format("{:.{}f} s", seconds, step < 1.0 ? 1 : 0);
        const float end = x + ImGui::CalcTextSize(text.c_str()).x + scaled(4);
        if (x >= free && end < axis.right()) {
            free = end;
            list->AddText({x + scaled(4), rows.ruler}, ImGui::GetColorU32(palette().text_dim),
                          text.c_str());
        }
    }
}

/// The length of the kept plan as a bar; one that is longer than the axis ends with an arrow.
void drawKept(const TimelineView& view, const FrameAxis& axis, const Rows& rows) {
    if (view.kept_text.empty()) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddText({rows.labels, rows.kept}, ImGui::GetColorU32(palette().text_dim),
                  ("B: " + view.kept_text).c_str());
    const double interval = view.frame_interval_s > 0.0 ? view.frame_interval_s : 1.0;
    const double end = frameAt(view, timeOf(view, 0) + view.kept_s - interval) + 1.0;
    constexpr double kEqual = 0.01;  // frames
    const bool longer = end > view.frame_count + kEqual && axis.xOf(end) > axis.right();
    const auto left = static_cast<float>(std::max(axis.xOf(0.0), axis.left()));
    const auto right = static_cast<float>(std::min(axis.xOf(end), axis.right()));
    if (right <= left) return;
    const Eigen::Vector4f& c = kKeptPlanColor;
    const ImU32 color = ImGui::GetColorU32(ImVec4(c.x(), c.y(), c.z(), c.w()));
    const float middle = std::floor((rows.kept + rows.bands) / 2);
    const float half = scaled(2.5F);
    list->AddRectFilled({left, middle - half}, {right, middle + half}, color, half);
    if (longer) {
        list->AddTriangleFilled({right - scaled(9), middle - scaled(6)}, {right, middle},
                                {right - scaled(9), middle + scaled(6)}, color);
    }
    nameArea("timeline.kept", left, middle - half, right, middle + half);
}

/// Red bars below the ruler where the camera collides.
void drawCollisions(const TimelineView& view, const FrameAxis& axis, const Rows& rows) {
    if (view.collisions == nullptr) return;
    const float bottom = rows.ruler + rowHeight();
    const float top = bottom - scaled(4);
    for (std::size_t i = 0; i < view.collisions->size(); ++i) {
        const planning::CollidingFrames& collision = (*view.collisions)[i];
        const float left = std::max(float(axis.xOf(collision.first + 0.5)) - 1, float(axis.left()));
        const float right =
            std::min(float(axis.xOf(collision.last + 0.5)) + 1, float(axis.right()));
        if (right <= left) continue;
        ImGui::GetWindowDrawList()->AddRectFilled({left, top}, {right, bottom},
                                                  ImGui::GetColorU32(palette().bad));
        nameArea(fmt::format("timeline.collision.{}", i), left, top, right, bottom);
    }
}

void drawBands(const TimelineView& view, const FrameAxis& axis, const Rows& rows) {
    if (rows.keys <= rows.bands) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < view.bands->size(); ++i) {
        const TimelineBand& band = (*view.bands)[i];
        const float left = std::max(float(axis.xOf(band.begin)), float(axis.left()));
        const float right = std::min(float(axis.xOf(band.end)), float(axis.right()));
        if (right <= left) continue;
        ImVec4 color = palette().accent;
        color.w = i % 2 == 0 ? 0.28F : 0.14F;
        const ImVec2 low(left, rows.bands + 1);
        const ImVec2 high(right - 1, rows.keys - 1);
        list->AddRectFilled(low, high, ImGui::GetColorU32(color), scaled(2));
        list->PushClipRect(low, high, true);
        list->AddText({left + scaled(4), rows.bands + 1}, ImGui::GetColorU32(ImGuiCol_Text),
                      band.name.c_str());
        list->PopClipRect();
    }
}

void drawKeys(const TimelineView& view, const FrameAxis& axis, const Rows& rows) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float middle = std::floor((rows.keys + rows.strips) / 2);
    list->AddLine({float(axis.left()), middle}, {float(axis.right()), middle},
                  ImGui::GetColorU32(palette().panel_line));
    if (hasSeries(view)) {
        const ImU32 good = ImGui::GetColorU32(palette().good);
        for (int i = axis.frameAt(axis.left()); i < axis.endFrame(); ++i) {
            if (view.series->newly_captured[i].empty()) continue;
            const auto x = static_cast<float>(std::floor(axis.xOf(i + 0.5)));
            list->AddRectFilled({x - 1, rows.strips - scaled(6)}, {x + 1, rows.strips}, good);
        }
    }
    if (view.keys == nullptr || hasCameraKeys(view)) return;
    // Smaller symbols if they would overlap.
    const auto shown = std::ranges::count_if(*view.keys, [&](const TimelineKey& key) {
        return key.frame >= axis.first() && key.frame < axis.endFrame();
    });
    const auto room = static_cast<float>((axis.right() - axis.left()) /
                                         static_cast<double>(std::max<std::ptrdiff_t>(shown, 1)));
    const float r = std::clamp(room * 0.45F, scaled(2.5F), scaled(5));
    for (const TimelineKey& key : *view.keys) {
        const auto x = static_cast<float>(axis.xOf(key.frame + 0.5));
        if (x < axis.left() - r || x > axis.right() + r) continue;
        const float y = middle - scaled(1);
        const bool here = key.frame == view.frame;
        list->AddQuadFilled({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y},
                            ImGui::GetColorU32(here ? palette().accent : palette().warning));
        nameArea("timeline.key." + std::to_string(key.frame), x - r, y - r, x + r, y + r);
    }
}

const TimelineKey* keyAt(const TimelineView& view, const FrameAxis& axis, const Rows& rows,
                         ImVec2 mouse) {
    if (view.keys == nullptr || mouse.y < rows.keys || mouse.y >= rows.strips) return nullptr;
    const TimelineKey* closest = nullptr;
    double least = scaled(7);
    for (const TimelineKey& key : *view.keys) {
        const double distance = std::abs(axis.xOf(key.frame + 0.5) - mouse.x);
        if (distance > least) continue;
        least = distance;
        closest = &key;
    }
    return closest;
}

std::string namesOf(const TimelineView& view, const std::vector<int>& ids) {
    std::string text;
    for (const int id : ids) {
        if (!text.empty()) text += ", ";
        text += view.object_name ? view.object_name(id) : std::to_string(id);
    }
    return text;
}

/// The collision at a frame; null: none.
const planning::CollidingFrames* collisionAt(const TimelineView& view, int frame) {
    if (view.collisions == nullptr) return nullptr;
    const auto found = std::ranges::find_if(
        *view.collisions, [&](const auto& one) { return one.first <= frame && frame <= one.last; });
    return found == view.collisions->end() ? nullptr : &*found;
}

std::string collisionText(const TimelineView& view, const planning::CollidingFrames& collision) {
    if (collision.object_id == 0 || !view.object_name) return "Collides, or is outside the rooms";
    return "Collides with " + view.object_name(collision.object_id);
}

void drawTooltip(const TimelineView& view, const TimelineState& state, int frame,
                 const TimelineKey* key) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled(360));
    if (key != nullptr) frame = key->frame;
    ImGui::Text("Frame %d, %.2f s%s", frame, timeOf(view, frame),
                key != nullptr ? ", a key frame" : "");
    if (key != nullptr && !key->text.empty()) ImGui::TextUnformatted(key->text.c_str());
    if (view.bands != nullptr && view.bands->size() > 1) {
        for (const TimelineBand& band : *view.bands) {
            if (frame >= band.begin && frame < band.end) {
                ImGui::TextColored(palette().text_dim, "%s", band.name.c_str());
            }
        }
    }
    if (const planning::CollidingFrames* collision = collisionAt(view, frame)) {
        ImGui::TextColored(palette().bad, "%s", collisionText(view, *collision).c_str());
    }
    if (hasSeries(view)) {
        for (std::size_t i = 0; i < kTimelineStrips; ++i) {
            const auto strip = static_cast<TimelineStrip>(i);
            if (!isShown(view, state, strip) || !hasValues(view, strip)) continue;
            ImGui::TextColored(palette().text_dim, "%s", stripStyle(strip).title);
            ImGui::SameLine(scaled(120));
            ImGui::TextUnformatted(stripText(view, strip, frame).c_str());
        }
        const auto& fresh = view.series->newly_captured[frame];
        if (!fresh.empty()) {
            ImGui::TextColored(palette().good, "Newly captured: %s", namesOf(view, fresh).c_str());
        }
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void drawStrips(const TimelineView& view, const TimelineState& state, const FrameAxis& axis,
                const Rows& rows) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 dim = ImGui::GetColorU32(palette().text_dim);
    float top = rows.strips;
    for (std::size_t i = 0; i < kTimelineStrips; ++i) {
        const auto strip = static_cast<TimelineStrip>(i);
        if (!isShown(view, state, strip)) continue;
        const float bottom = top + rows.strip_height;
        const float text_y = std::floor((top + bottom - ImGui::GetTextLineHeight()) / 2);
        list->AddText({rows.labels, text_y}, ImGui::GetColorU32(ImGuiCol_Text),
                      stripStyle(strip).title);
        if (hasValues(view, strip)) {
            drawStrip(view, strip, axis, top, bottom - 1);
            const std::string range = stripRange(view, strip, axis);
            const float width = ImGui::CalcTextSize(range.c_str()).x;
            list->AddText({float(axis.left()) - width - scaled(10), text_y}, dim, range.c_str());
        } else {
            const bool has_earlier = drawEarlierStrip(view, strip, axis, top, bottom - 1);
            const char* text = "being measured …";
            const float width = ImGui::CalcTextSize(text).x;
            const float left = float(axis.left());
            list->AddText({has_earlier ? left - width - scaled(10) : left + scaled(6), text_y}, dim,
                          text);
        }
        list->AddLine({rows.labels, bottom}, {float(axis.right()), bottom},
                      ImGui::GetColorU32(palette().panel_line));
        top = bottom;
    }
}

void drawPlayhead(const TimelineView& view, const FrameAxis& axis, const Rows& rows) {
    const auto x = static_cast<float>(std::floor(axis.xOf(view.frame + 0.5)));
    if (x < axis.left() || x > axis.right()) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 color = ImGui::GetColorU32(palette().accent);
    list->AddRectFilled({x, rows.ruler}, {x + std::max(1.0F, scaled(1.5F)), rows.bottom}, color);
    nameArea("timeline.playhead", x, rows.ruler, x + 1, rows.bottom);
    list->AddTriangleFilled({x - scaled(6), rows.ruler}, {x + scaled(7), rows.ruler},
                            {x + scaled(0.5F), rows.ruler + scaled(8)}, color);
}

Rows layOut(const TimelineView& view, const TimelineState& state, ImVec2 origin, float height) {
    Rows rows;
    rows.labels = origin.x;
    rows.ruler = origin.y;
    rows.kept = rows.ruler + rowHeight();
    rows.bands = rows.kept + (view.kept_text.empty() ? 0.0F : rowHeight());
    const bool several = view.bands != nullptr && view.bands->size() > 1;
    rows.keys = rows.bands + (several ? rowHeight() : 0.0F);
    rows.strips = rows.keys + rowHeight();
    float count = 0.0F;
    for (std::size_t i = 0; i < kTimelineStrips; ++i) {
        count += isShown(view, state, static_cast<TimelineStrip>(i)) ? 1.0F : 0.0F;
    }
    const float left_over = origin.y + height - rows.strips;
    rows.strip_height = count > 0 ? std::max(rowHeight(), std::floor(left_over / count)) : 0.0F;
    rows.bottom = rows.strips + count * rows.strip_height;
    return rows;
}

/// Zooming and panning. Over the row names the wheel scrolls.
void navigate(FrameAxis& axis, bool hovered, bool active) {
    const ImGuiIO& io = ImGui::GetIO();
    if (hovered && io.MouseWheel != 0.0F) {
        axis.zoom(io.MousePos.x, std::pow(0.8, static_cast<double>(io.MouseWheel)));
    }
    if (active && ImGui::IsMouseDown(ImGuiMouseButton_Middle)) axis.pan(io.MouseDelta.x);
    if (hovered && io.MouseWheelH != 0.0F) axis.pan(scaled(40) * io.MouseWheelH);
}

}  // namespace

TimelineActions drawTimelineTracks(const TimelineView& view, TimelineState& state) {
    TimelineActions actions;
    const float label_width = std::round(scaled(232));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool over_names = ImGui::GetIO().MousePos.x < corner.x + label_width;
    ImGui::BeginChild("tracks", {0, 0}, false,
                      over_names ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoScrollWithMouse);
    if (view.frame_count == 0) {
        ImGui::TextDisabled("There is no trajectory yet.");
        ImGui::EndChild();
        return actions;
    }
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const Rows rows = layOut(view, state, {std::floor(origin.x), std::floor(origin.y)}, room.y);
    const double left = std::floor(origin.x) + label_width;
    const double right = std::floor(origin.x + room.x);
    FrameAxis axis(view.frame_count, left, right, state.first, state.shown, cameraKeyMargin(view));
    if (view.frame != state.last_frame) axis.reveal(view.frame);

    ImGui::SetCursorScreenPos({float(left), rows.ruler});
    ImGui::InvisibleButton("axis", {std::max(float(right - left), 1.0F), rows.bottom - rows.ruler},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    nameItem("timeline.axis");
    const bool hovered = ImGui::IsItemHovered();
    const bool active = ImGui::IsItemActive();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    navigate(axis, hovered, active);
    const CameraKeyRow key_row{rows.keys, rows.strips, hovered, active};
    const bool on_camera_key = editCameraKeys(view, axis, key_row, state, actions);
    const TimelineKey* key = hovered || active ? keyAt(view, axis, rows, mouse) : nullptr;
    if (active && !on_camera_key && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        const int frame = key != nullptr ? key->frame : axis.frameAt(mouse.x);
        if (frame != view.frame) actions.go_to = frame;
    }
    state.first = axis.first();
    state.shown = axis.isZoomed() ? axis.shown() : 0.0;

    drawRuler(view, axis, rows);
    drawKept(view, axis, rows);
    drawCollisions(view, axis, rows);
    drawBands(view, axis, rows);
    drawStrips(view, state, axis, rows);
    drawKeys(view, axis, rows);
    drawPlayhead(view, axis, rows);
    drawCameraKeys(view, state, axis, key_row);
    ImGui::GetWindowDrawList()->AddText({rows.labels, rows.keys}, ImGui::GetColorU32(ImGuiCol_Text),
                                        "Key frames");
    if (hovered && !on_camera_key && !ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
        drawTooltip(view, state, axis.frameAt(mouse.x), key);
    }
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
