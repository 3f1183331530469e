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

/// The selection, preserved across plans, and the hidden objects.
class SelectionTracker {
  public:
    [[nodiscard]] const ui::Selection& now() const { return now_; }
    [[nodiscard]] bool is(ui::Selection::Kind kind) const { return now_.kind == kind; }
    [[nodiscard]] const std::vector<int>& objects() const { return now_.objects; }
    /// The selected index; 0 if there is none.
    [[nodiscard]] std::size_t index() const {
        return static_cast<std::size_t>(now_.index > 0 ? now_.index : 0);
    }
    /// The selected position point of the plan; null if none is selected.
    [[nodiscard]] const PositionPoint* positionPoint(const Plan* plan) const;
    /// The selected no-go box; null if none is selected.
    [[nodiscard]] const NoGoBox* noGoBox(const std::vector<NoGoBox>& boxes) const;
    /// The selected region; null if none is selected.
    [[nodiscard]] const Region* region(const std::vector<Region>& regions) const;

    /// The selected key of the given motion; null if none is selected.
    [[nodiscard]] const MotionKey* cameraKey(const SharedMotion& motion) const;

    /// Changes the selection. `pinned` are the pinned points that the plan was made with.
    void set(ui::Selection selection, const Plan* plan, const std::vector<PinnedPoint>& pinned);
    void clear();
    /// Selects the pinned point of this name as soon as a plan contains it.
    void awaitPin(const std::string& name) { awaited_pin_ = name; }
    /// A selection of objects: with `add`, the current one with this object toggled; otherwise this
    /// object alone (0: none).
    [[nodiscard]] ui::Selection withObject(int object, bool add) const;
    /// A selection of all these objects; with `add`, together with those selected now.
    [[nodiscard]] ui::Selection withObjects(const std::vector<int>& objects, bool add) const;
    /// The current selection of objects without these.
    [[nodiscard]] ui::Selection withoutObjects(const std::vector<int>& objects) const;
    /// Finds the selection again in a new plan. Returns false if the selected element no longer
    /// exists; then nothing is selected.
    bool keepIn(const Plan* plan, const std::vector<PinnedPoint>& pinned);
    /// Updates ids of selected and hidden objects after merges and splits. To be called before
    /// keepIn(), which searches by the new ids.
    void follow(const std::shared_ptr<const ObjectTrace>& objects);
    /// Resets everything for another project, or none.
    void forget();
    /// Hides these objects (ids of at least 1), which a project stores. Call it after forget().
    void hideStored(const std::vector<int>& objects);

    [[nodiscard]] const std::vector<bool>& hidden() const {
        return hidden_;
    }  // indexed by object id
    void toggleHidden(int object);
    void hideObjects();
    void showAll();
    /// Local view: shows the selected objects only, or all again.
    void toggleLocalView();
    [[nodiscard]] bool inLocalView() const { return !local_.empty(); }
    /// Ids of the objects in the local view; empty: there is none.
    [[nodiscard]] const std::vector<int>& localObjects() const { return local_; }
    /// Objects that the viewport leaves out, by object id: hidden ones, and those outside the local
    /// view.
    [[nodiscard]] std::vector<bool> leftOut() const;
    [[nodiscard]] bool isLeftOut(int object) const;

    /// The bounds of the selected elements, m, world; empty if they have no position.
    [[nodiscard]] Eigen::AlignedBox3d box(const Scene& scene, const Plan* plan,
                                          const PlanEdits& edits) const;

  private:
    [[nodiscard]] std::vector<int> objectsOfPoint(const Plan* plan) const;
    bool keepPlace(const Plan* plan, const std::vector<PinnedPoint>& pinned);
    bool selectPin(const std::string& name, const Plan& plan,
                   const std::vector<PinnedPoint>& pinned);

    ui::Selection now_;
    std::vector<int> objects_of_point_;  // objects that the selected point observes
    std::string pin_of_point_;           // pin name of the selected position point, or empty
    std::string awaited_pin_;
    std::vector<bool> hidden_;
    std::vector<int> local_;  // ids of the objects in the local view; empty: there is none
    std::shared_ptr<const ObjectTrace> objects_now_;  // the objects that all stored ids refer to
};

}  // namespace dollytrack::editor
