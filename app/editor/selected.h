#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "ui/selection.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::editor {

/// What is selected, how it is found again in the next plan, and which objects are hidden.
class Selected {
  public:
    [[nodiscard]] const ui::Selection& now() const { return now_; }
    [[nodiscard]] bool is(ui::Selection::Kind kind) const { return now_.kind == kind; }
    [[nodiscard]] const std::vector<int>& objects() const { return now_.objects; }
    /// The index as a place in a list; 0 where there is none.
    [[nodiscard]] std::size_t index() const {
        return static_cast<std::size_t>(now_.index > 0 ? now_.index : 0);
    }
    /// The selected position point of the plan; null: none is.
    [[nodiscard]] const PositionPoint* positionPoint(const Plan* plan) const;
    /// The selected no-go box; null: none is.
    [[nodiscard]] const NoGoBox* noGoBox(const std::vector<NoGoBox>& boxes) const;
    /// The selected region; null: none is.
    [[nodiscard]] const Region* region(const std::vector<Region>& regions) const;

    void set(ui::Selection selection, const Plan* plan);
    void clear() { set({}, nullptr); }
    /// The objects with this one in or out, or this one alone.
    [[nodiscard]] ui::Selection withObject(int object, bool add) const;
    /// There is a new plan, in which indices mean something else. False: what was selected is not
    /// there any more, and nothing is selected now.
    bool keepIn(const Plan* plan);
    /// The scene has other objects: none is hidden, and those that are gone are not selected.
    void keepIn(const Scene& scene);

    [[nodiscard]] const std::vector<bool>& hidden() const { return hidden_; }  // by object id
    void toggleHidden(int object);
    void hideObjects();
    void showAll();

    /// Around all that is selected; empty when nothing with a place is.
    [[nodiscard]] Eigen::AlignedBox3d box(const Scene& scene, const Plan* plan,
                                          const PlanEdits& edits) const;

  private:
    [[nodiscard]] std::vector<int> objectsOfPoint(const Plan* plan) const;

    ui::Selection now_;
    std::vector<int> objects_of_point_;  // ids: what a selected point looks at
    std::vector<bool> hidden_;
};

}  // namespace dollytrack::editor
