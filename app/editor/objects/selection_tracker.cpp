#include "app/editor/objects/selection_tracker.h"

#include <algorithm>
#include <utility>

namespace dollytrack::editor {

using SelectionKind = ui::Selection::Kind;

namespace {

/// Index of the position point for an observation point; -1: none.
int positionPointFor(const Plan& plan, int observation_point) {
    for (std::size_t i = 0; i < plan.position_points.size(); ++i) {
        if (plan.position_points[i].observation_point == observation_point) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

ui::Selection ofObjects(std::vector<int> ids) {
    if (ids.empty()) return {};
    const auto kind = ids.size() == 1 ? SelectionKind::Object : SelectionKind::Objects;
    return {kind, std::move(ids)};
}

}  // namespace

const PositionPoint* SelectionTracker::positionPoint(const Plan* plan) const {
    if (!is(SelectionKind::PositionPoint) || plan == nullptr) return nullptr;
    return index() < plan->position_points.size() ? &plan->position_points[index()] : nullptr;
}

const NoGoBox* SelectionTracker::noGoBox(const std::vector<NoGoBox>& boxes) const {
    return is(SelectionKind::NoGoBox) && index() < boxes.size() ? &boxes[index()] : nullptr;
}

const Region* SelectionTracker::region(const std::vector<Region>& regions) const {
    return is(SelectionKind::Region) && index() < regions.size() ? &regions[index()] : nullptr;
}

const MotionKey* SelectionTracker::cameraKey(const SharedMotion& motion) const {
    const bool is_there = is(SelectionKind::CameraKey) && motion && index() < motion->keys.size();
    return is_there ? &motion->keys[index()] : nullptr;
}

void SelectionTracker::set(ui::Selection selection, const Plan* plan,
                           const std::vector<PinnedPoint>& pinned) {
    now_ = std::move(selection);
    objects_of_point_ = objectsOfPoint(plan);
    awaited_pin_.clear();
    pin_of_point_.clear();
    const PositionPoint* point = positionPoint(plan);
    if (point == nullptr || point->pin < 0) return;
    const std::size_t pin = point->pin;
    if (pin < pinned.size()) pin_of_point_ = pinned[pin].name;
}

void SelectionTracker::clear() {
    set({}, nullptr, {});
}

bool SelectionTracker::selectPin(const std::string& name, const Plan& plan,
                                 const std::vector<PinnedPoint>& pinned) {
    if (name.empty()) return false;
    for (std::size_t i = 0; i < plan.position_points.size(); ++i) {
        const int pin = plan.position_points[i].pin;
        if (pin < 0 || static_cast<std::size_t>(pin) >= pinned.size()) continue;
        if (pinned[pin].name != name) continue;
        set(ui::Selection::ofItem(SelectionKind::PositionPoint, static_cast<int>(i)), &plan,
            pinned);
        return true;
    }
    return false;
}

ui::Selection SelectionTracker::withObject(int object, bool add) const {
    std::vector<int> ids;
    if (add) ids = now_.objects;
    const auto at = std::ranges::find(ids, object);
    if (at != ids.end()) {
        ids.erase(at);
    } else if (object != 0) {
        ids.push_back(object);
    }
    return ofObjects(std::move(ids));
}

ui::Selection SelectionTracker::withObjects(const std::vector<int>& objects, bool add) const {
    std::vector<int> ids;
    if (add) ids = now_.objects;
    for (const int id : objects) {
        if (std::ranges::count(ids, id) == 0) ids.push_back(id);
    }
    return ofObjects(std::move(ids));
}

ui::Selection SelectionTracker::withoutObjects(const std::vector<int>& objects) const {
    if (now_.objects.empty()) return now_;
    std::vector<int> ids = now_.objects;
    std::erase_if(ids, [&](int id) { return std::ranges::count(objects, id) != 0; });
    return ofObjects(std::move(ids));
}

bool SelectionTracker::keepIn(const Plan* plan, const std::vector<PinnedPoint>& pinned) {
    std::string awaited = std::exchange(awaited_pin_, {});
    if (plan != nullptr && selectPin(awaited, *plan, pinned)) return true;
    const bool kept = keepPlace(plan, pinned);
    // If the plan was made with this pin but has no point for it, the pin was refused.
    if (std::ranges::count(pinned, awaited, &PinnedPoint::name) == 0) {
        awaited_pin_ = std::move(awaited);
    }
    return kept;
}

bool SelectionTracker::keepPlace(const Plan* plan, const std::vector<PinnedPoint>& pinned) {
    // Objects, cells, boxes and camera keys do not depend on the plan.
    if (is(SelectionKind::None) || is(SelectionKind::Voxel) || is(SelectionKind::NoGoBox) ||
        is(SelectionKind::Region) || is(SelectionKind::CameraKey) || !now_.objects.empty()) {
        return true;
    }
    const auto fits = [&](std::size_t count) {
        return now_.index >= 0 && static_cast<std::size_t>(now_.index) < count;
    };
    // A frame is identified by its index, a point by its objects; other indices are invalid in a
    // new plan.
    if (plan != nullptr && is(SelectionKind::Frame) && fits(plan->trajectory.frames.size()))
        return true;
    if (plan != nullptr && selectPin(std::string(pin_of_point_), *plan, pinned)) return true;
    if (plan != nullptr && !objects_of_point_.empty()) {
        for (std::size_t i = 0; i < plan->observation_points.size(); ++i) {
            if (plan->observation_points[i].objects != objects_of_point_) continue;
            const int found = is(SelectionKind::ObservationPoint)
                                  ? static_cast<int>(i)
                                  : positionPointFor(*plan, static_cast<int>(i));
            if (found < 0) break;
            now_.index = found;
            return true;
        }
    }
    clear();
    return false;
}

void SelectionTracker::follow(const std::shared_ptr<const ObjectTrace>& objects) {
    if (!objects || objects == objects_now_) return;
    const std::shared_ptr<const ObjectTrace> before = std::exchange(objects_now_, objects);
    // The first scene of a project has no predecessor: ids stored with the project are its own.
    const ObjectTrace& from = before ? *before : *objects;
    hidden_ = followFlags(hidden_, from, *objects);
    local_ = followObjects(local_, from, *objects);
    objects_of_point_ = followObjects(objects_of_point_, from, *objects);
    if (now_.objects.empty()) return;
    now_.objects = followObjects(now_.objects, from, *objects);
    if (now_.objects.empty()) return clear();
    now_.kind = now_.objects.size() == 1 ? SelectionKind::Object : SelectionKind::Objects;
}

void SelectionTracker::forget() {
    clear();
    hidden_.clear();
    local_.clear();
    objects_now_.reset();
}

void SelectionTracker::hideStored(const std::vector<int>& objects) {
    for (const int id : objects) {
        if (static_cast<std::size_t>(id) >= hidden_.size()) hidden_.resize(id + 1, false);
        hidden_[id] = true;
    }
}

void SelectionTracker::toggleHidden(int object) {
    const std::size_t at = object;
    if (at < hidden_.size()) hidden_[at] = !hidden_[at];
}

void SelectionTracker::hideObjects() {
    for (const int id : now_.objects) {
        if (static_cast<std::size_t>(id) < hidden_.size()) {
            hidden_[id] = true;
        }
    }
}

void SelectionTracker::showAll() {
    std::fill(hidden_.begin(), hidden_.end(), false);
}

void SelectionTracker::toggleLocalView() {
    if (inLocalView()) return local_.clear();
    local_ = now_.objects;
}

std::vector<bool> SelectionTracker::leftOut() const {
    if (!inLocalView()) return hidden_;
    std::vector<bool> out(hidden_.size(), true);
    for (const int id : local_) {
        if (static_cast<std::size_t>(id) < out.size()) out[id] = hidden_[id];
    }
    return out;
}

bool SelectionTracker::isLeftOut(int object) const {
    const std::vector<bool> out = leftOut();
    const auto id = static_cast<std::size_t>(object);
    return id < out.size() && out[id];
}

Eigen::AlignedBox3d SelectionTracker::box(const Scene& scene, const Plan* plan,
                                          const PlanEdits& edits) const {
    Eigen::AlignedBox3d box;
    const auto include = [&](const OrientedBox& one) {
        for (const Eigen::Vector3d& corner : one.corners()) box.extend(corner);
    };
    const auto around = [&](const Eigen::Vector3d& place) {
        box.extend(place - Eigen::Vector3d::Constant(0.4));
        box.extend(place + Eigen::Vector3d::Constant(0.4));
    };
    for (const int id : now_.objects) include(scene.object(id).box);
    if (is(SelectionKind::Voxel)) around(now_.place);
    if (const PositionPoint* point = positionPoint(plan)) around(point->pose.position);
    if (const NoGoBox* one = noGoBox(edits.no_go)) include(one->box);
    if (const Region* one = region(edits.regions)) include(one->box);
    if (const MotionKey* key = cameraKey(edits.motion)) around(key->pose.position);
    if (plan == nullptr) return box;
    if (is(SelectionKind::ObservationPoint) && index() < plan->observation_points.size()) {
        around(plan->observation_points[index()].position);
    }
    if (is(SelectionKind::Frame) && index() < plan->trajectory.frames.size()) {
        around(plan->trajectory.frames[index()].pose.position);
    }
    return box;
}

std::vector<int> SelectionTracker::objectsOfPoint(const Plan* plan) const {
    if (plan == nullptr || now_.index < 0) return {};
    std::size_t at = index();
    if (const PositionPoint* point = positionPoint(plan)) {
        at = static_cast<std::size_t>(point->observation_point);
    } else if (!is(SelectionKind::ObservationPoint)) {
        return {};
    }
    return at < plan->observation_points.size() ? plan->observation_points[at].objects
                                                : std::vector<int>();
}

}  // namespace dollytrack::editor
