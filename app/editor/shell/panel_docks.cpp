#include "app/editor/shell/panel_docks.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dollytrack::editor {

namespace {

constexpr std::size_t indexOf(DockSide side) {
    return static_cast<std::size_t>(side);
}

}  // namespace

bool PanelDocks::Rectangle::contains(ImVec2 at) const {
    return at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y;
}

void PanelDocks::restore(const PanelPlaces& places, const OpenTabs& open) {
    change(completePlaces(places));
    for (std::size_t i = 0; i < open.size(); ++i) rows_[i].select(open[i]);
}

PanelDocks::OpenTabs PanelDocks::openTabs() const {
    OpenTabs open;
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = rows_[i].open();
    return open;
}

bool PanelDocks::isOpen(std::string_view panel) const {
    const std::optional<DockSide> side = places_.sideOf(panel);
    return side && places_.isVisible(*side) && rows_[indexOf(*side)].open() == panel;
}

void PanelDocks::change(PanelPlaces places) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (places.tabs[i] == places_.tabs[i]) continue;
        ++row_ids_[i];
        rows_[i].select(rows_[i].open());
    }
    places_ = std::move(places);
}

void PanelDocks::toggleSide(DockSide side) {
    bool& on = places_.side_on[indexOf(side)];
    on = !on;
}

void PanelDocks::select(const std::string& panel) {
    if (const std::optional<DockSide> side = places_.sideOf(panel)) {
        rows_[indexOf(*side)].select(panel);
    }
}

void PanelDocks::open(const std::string& panel) {
    PanelPlaces places = places_;
    places.reveal(panel);
    change(std::move(places));
    select(panel);
}

void PanelDocks::dock(const std::string& panel, DockSide side, std::string_view before) {
    PanelPlaces places = places_;
    places.dock(panel, side, before);
    change(std::move(places));
    select(panel);
}

void PanelDocks::hide(const std::string& panel) {
    PanelPlaces places = places_;
    places.hide(panel);
    change(std::move(places));
}

void PanelDocks::reset() {
    change(standardPlaces());
}

void PanelDocks::drawPlaces(const std::string& panel) {
    const std::optional<DockSide> now = places_.sideOf(panel);
    for (const DockSide side : kDockSides) {
        const std::string text = fmt::format("Dock on the {}", sideName(side));
        if (ImGui::MenuItem(text.c_str(), nullptr, now == side, now != side)) {
            wanted_places_ = places_;
            wanted_places_->dock(panel, side);
        }
        ui::nameItem(fmt::format("place.{}", sideName(side)));
    }
    if (ImGui::MenuItem("Hide", nullptr, !now, now.has_value())) {
        wanted_places_ = places_;
        wanted_places_->hide(panel);
    }
    ui::nameItem("place.hidden");
}

void PanelDocks::drawMenu() {
    for (const DockSide side : kDockSides) {
        for (const std::string& panel : standardPlaces().at(side)) {
            if (ImGui::BeginMenu(panel.c_str())) {
                drawPlaces(panel);
                ImGui::EndMenu();
            }
            ui::nameItem("places." + panel);
        }
    }
}

void PanelDocks::draw(DockSide side, const std::function<void(const std::string&)>& draw_panel) {
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    sides_[indexOf(side)] = Rectangle{at, {at.x + size.x, at.y + size.y}};
    TabRow& row = rows_[indexOf(side)];
    if (!row.beginRow(fmt::format("{} {}", sideName(side), row_ids_[indexOf(side)]).c_str()))
        return;
    bool opens_menu = false;
    for (const std::string& panel : places_.at(side)) {
        const bool shown = row.begin(panel.c_str(), badges_[panel]);
        tabs_.push_back({panel, side, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()}});
        if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
            dragged_ = panel;
        }
        if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
            menu_of_ = panel;
            opens_menu = true;
        }
        if (!shown) continue;
        draw_panel(panel);
        ImGui::EndTabItem();
    }
    row.end();
    ImGui::EndTabBar();
    if (opens_menu) ImGui::OpenPopup("places");
    if (ImGui::BeginPopup("places")) {
        drawPlaces(menu_of_);
        ImGui::EndPopup();
    }
}

PanelDocks::Target PanelDocks::targetInRow(DockSide side, ImVec2 mouse) const {
    const float half = ui::scaled(2);
    Target target{side, {}, {}};
    for (const Tab& tab : tabs_) {
        if (tab.side != side || tab.panel == dragged_) continue;
        const auto [low, high] = tab.area;
        const bool before = mouse.x < 0.5F * (low.x + high.x);
        const float x = before ? low.x : high.x;
        target.area = {{x - half, low.y}, {x + half, high.y}};
        if (!before) continue;
        target.before = tab.panel;
        break;
    }
    return target;
}

std::optional<PanelDocks::Target> PanelDocks::targetAt(ImVec2 mouse, const Rectangle& all) const {
    const float zone = ui::scaled(48);
    for (const DockSide side : kDockSides) {
        if (const std::optional<Rectangle>& area = sides_[indexOf(side)]) {
            if (!area->contains(mouse)) continue;
            const auto in_row = std::ranges::any_of(tabs_, [&](const Tab& tab) {
                return tab.side == side && mouse.y < tab.area.high.y;
            });
            if (in_row) return targetInRow(side, mouse);
            if (places_.sideOf(dragged_) == side) return std::nullopt;
            return Target{side, {}, *area};
        }
        Rectangle border = all;
        if (side == DockSide::Left) border.high.x = all.low.x + zone;
        if (side == DockSide::Right) border.low.x = all.high.x - zone;
        if (side == DockSide::Bottom) border.low.y = all.high.y - zone;
        if (border.contains(mouse)) return Target{side, {}, border};
    }
    return std::nullopt;
}

void PanelDocks::followDrag(ImVec2 low, ImVec2 high) {
    if (!dragged_.empty()) {
        const std::optional<Target> target = targetAt(ImGui::GetMousePos(), {low, high});
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
            if (target) dock(dragged_, target->side, target->before);
            dragged_.clear();
        } else if (target) {
            ImVec4 colour = ui::palette().accent;
            colour.w = 0.4F;
            ImGui::GetForegroundDrawList()->AddRectFilled(target->area.low, target->area.high,
                                                          ImGui::GetColorU32(colour));
        }
    }
    if (wanted_places_) change(*std::exchange(wanted_places_, std::nullopt));
    tabs_.clear();
    sides_ = {};
}

}  // namespace dollytrack::editor
