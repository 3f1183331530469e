#include "app/editor/objects/remedy_finder.h"

#include "engine/plan/remedy_operations.h"
#include "planning/remedies/remedies.h"

#include <algorithm>
#include <utility>

namespace dollytrack::editor {

RemedyFinder::RemedyFinder(std::function<void()> wake) : worker_(std::move(wake)) {}

void RemedyFinder::find(const PlanOutcome& shown, int object_id) {
    if (!shown.plan || !shown.scene || !shown.state) return;
    const auto row = std::ranges::find(shown.plan->ledger, object_id, &LedgerRow::object_id);
    if (row == shown.plan->ledger.end()) return;
    plan_ = shown.plan;
    scene_ = shown.scene;
    object_id_ = object_id;
    answer_.reset();
    searching_ = true;
    worker_.start([question = ++question_, plan = plan_, scene = scene_, edits = shown.edits,
                   params = shown.params, asked = *row, latest = answers_](const JobContext& job) {
        auto rows = planning::findRemedies(scene, params, edits, *plan, {asked}, job);
        if (rows) {
            latest->put({question, std::move(rows->front())});
        } else {
            latest->put({question, tl::unexpected(std::move(rows.error()))});
        }
    });
}

void RemedyFinder::cancel() {
    ++question_;
    searching_ = false;
    worker_.cancel();
}

void RemedyFinder::forget() {
    cancel();
    answer_.reset();
    plan_.reset();
    scene_.reset();
}

ui::RemedySearch RemedyFinder::state(const PlanOutcome& shown, int object_id) {
    using State = ui::RemedySearch::State;
    const bool same = shown.plan == plan_ && object_id == object_id_;
    if (searching_ && shown.plan != plan_) forget();  // the answer would be outdated
    const bool ended = !worker_.state().busy;
    if (auto answer = answers_->take(); answer && answer->question == question_) {
        answer_ = std::move(answer);
        searching_ = false;
    }
    ui::RemedySearch search;
    if (!same) return search;
    if (searching_ && ended) {
        search.state = State::Failed;
        search.error = "The search ended without a result; see the log.";
    } else if (searching_) {
        search.state = State::Searching;
        search.fraction = worker_.state().fraction;
    } else if (answer_ && answer_->question == question_) {
        if (!answer_->row) {
            search.state = State::Failed;
            search.error = describe(answer_->row.error());
            return search;
        }
        search.row = *answer_->row;
        search.state = search.row.remedy ? State::Found : State::Nothing;
        search.can_be_applied = !operations().empty();
    }
    return search;
}

std::string RemedyFinder::name() const {
    if (operations().empty()) return {};
    return "Help " + scene_->object(object_id_).name + ": " + answer_->row->remedy->text;
}

nlohmann::json RemedyFinder::operations() const {
    if (!answer_ || !answer_->row || !answer_->row->remedy) return nlohmann::json::array();
    return remedyOperations(*scene_, object_id_, *answer_->row->remedy);
}

}  // namespace dollytrack::editor
