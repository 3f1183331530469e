#pragma once

#include "engine/document/edits.h"
#include "engine/document/object_trace.h"
#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "ui/selection.h"

#include <Eigen/Geometry>

#include <memory>
#include <string>
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

    /// `pinned` are the points by hand that the plan was made with.
    void set(ui::Selection selection, const Plan* plan, const std::vector<PinnedPoint>& pinned);
    void clear();
    /// The point pinned under this name is selected as soon as a plan has it.
    void awaitPin(const std::string& name) { awaited_pin_ = name; }
    /// The objects with this one in or out, or this one alone.
    [[nodiscard]] ui::Selection withObject(int object, bool add) const;
    /// There is a new plan, in which indices mean something else. False: what was selected is not
    /// there any more, and nothing is selected now.
    bool keepIn(const Plan* plan, const std::vector<PinnedPoint>& pinned);
    /// The scene's objects may be others, with other numbers: what is selected or hidden follows
    /// its object. Comes before keepIn(), which looks for objects by their new numbers.
    void follow(const std::shared_ptr<const ObjectTrace>& objects);
    /// Another project is open, or none: nothing of the one before is to be followed.
    void forget();

    [[nodiscard]] const std::vector<bool>& hidden() const { return hidden_; }  // by object id
    void toggleHidden(int object);
    void hideObjects();
    void showAll();

    /// Around all that is selected; empty when nothing with a place is.
    [[nodiscard]] Eigen::AlignedBox3d box(const Scene& scene, const Plan* plan,
                                          const PlanEdits& edits) const;

  private:
    [[nodiscard]] std::vector<int> objectsOfPoint(const Plan* plan) const;
    bool keepPlace(const Plan* plan, const std::vector<PinnedPoint>& pinned);
    bool selectPin(const std::string& name, const Plan& plan,
                   const std::vector<PinnedPoint>& pinned);

    ui::Selection now_;
    std::vector<int> objects_of_point_;  // ids: what a selected point looks at
    std::string pin_of_point_;           // its name, of a selected position point; empty: none
    std::string awaited_pin_;
    std::vector<bool> hidden_;
    std::shared_ptr<const ObjectTrace> objects_now_;  // whose numbers all of these are
};

}  // namespace dollytrack::editor
