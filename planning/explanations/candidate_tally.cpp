#include "planning/explanations/candidate_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace dollytrack::planning {
namespace {

/// The object's name, or `without` if there is none.
std::string nameOf(const Scene& scene, int object_id, const char* without) {
    return object_id > 0 ? scene.object(object_id).name : std::string(without);
}

/// The reason as a phrase that continues "200 positions are".
std::string inWords(const Scene& scene, Verdict verdict, int object_id) {
    switch (verdict) {
        case Verdict::InObstacle:
            return "too close to " + nameOf(scene, object_id, "a surface");
        case Verdict::OutsideRoom:
            return "outside the rooms' free space";
        case Verdict::TooClose:
            return "too close to the object itself";
        case Verdict::NoGo:
            return "in a no-go box";
        case Verdict::HeightBand:
            return "outside the height band";
        case Verdict::PitchBand:
            return "outside the pitch band";
        case Verdict::InGap:
            return "in a gap between surfaces";
        case Verdict::Unscanned:
            return "facing mostly unscanned space";
        case Verdict::OccludedBy:
            return "hidden by " + nameOf(scene, object_id, "itself");
        case Verdict::TooSmall:
            return "too far away";
        case Verdict::Cropped:
            return "too close to fit it in the image";
        case Verdict::Legal:
            break;
    }
    return "fit";
}

}  // namespace

void CandidateTally::add(const Candidate& candidate) {
    ++tried_;
    if (candidate.verdict == Verdict::Legal) {
        ++legal_;
    } else {
        // Only these verdicts name an object.
        const bool blames =
            candidate.verdict == Verdict::OccludedBy || candidate.verdict == Verdict::InObstacle;
        ++refused_[{candidate.verdict, blames ? candidate.occluder : 0}];
    }
    switch (candidate.verdict) {
        case Verdict::OccludedBy:
            ++hidden_;
            ++hidden_by_[candidate.occluder];
            break;
        case Verdict::TooSmall:
            ++small_;
            break;
        case Verdict::Cropped:
            ++cropped_;
            break;
        case Verdict::Legal:
            break;
        default:
            return;  // not free: nothing was sampled
    }
    most_visible_ = std::max(most_visible_, candidate.visible_fraction);
}

Loss CandidateTally::loss() const {
    if (free() == 0) return Loss::NoFreePose;
    // Candidates legal in a coarse estimate but not in a fine one show almost enough: then
    // occlusion decides, if anything is occluded.
    const int left = inSight() - legal_;
    if (left == 0 && (hidden_ > 0 || legal_ == 0)) return Loss::Occluded;
    return small_ > 0 || cropped_ == 0 ? Loss::TooSmall : Loss::DoesNotFit;
}

int CandidateTally::occluder() const {
    int most = 0;
    int by = 0;
    for (const auto& [id, count] : hidden_by_) {
        if (count <= most) continue;
        most = count;
        by = id;
    }
    return by;
}

std::string CandidateTally::refusals(const Scene& scene, std::size_t kinds) const {
    std::vector<std::pair<int, std::string>> order;
    for (const auto& [why, count] : refused_) {
        order.emplace_back(count, inWords(scene, why.first, why.second));
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min(kinds, order.size()); ++i) {
        text += fmt::format("{}{} ({})", i == 0 ? "" : ", ", order[i].second, order[i].first);
    }
    return text;
}

std::string CandidateTally::reason(const Scene& scene) const {
    if (tried_ == 0) return "No candidate position was found.";
    const double best = 100.0 * most_visible_;
    if (legal_ > 0) {
        return fmt::format(
            "{} of {} candidates seemed to capture it, but a count of its pixels shows too little "
            "of it.",
            legal_, tried_);
    }
    switch (loss()) {
        case Loss::NoFreePose:
            return fmt::format("None of the {} candidates is free: {}.", tried_, refusals(scene));
        case Loss::Occluded:
            return fmt::format(
                "Hidden from each of the {} free candidates, mostly by {}; the best shows {:.0f} "
                "%.",
                free(), nameOf(scene, occluder(), "itself"), best);
        case Loss::TooSmall:
            return fmt::format(
                "Too small in the image from each of the {} candidates from which it is visible.",
                inSight());
        default:
            return fmt::format(
                "Does not fit into the image from any of the {} candidates from which it is "
                "visible; the best shows {:.0f} %.",
                inSight(), best);
    }
}

CandidateTally tallyOf(const Plan& plan, int object_id) {
    CandidateTally alone;
    CandidateTally in_groups;
    for (std::size_t o = 0; o < plan.observation_points.size(); ++o) {
        const std::vector<int>& objects = plan.observation_points[o].objects;
        if (std::find(objects.begin(), objects.end(), object_id) == objects.end()) continue;
        CandidateTally& tally = objects.size() == 1 ? alone : in_groups;
        for (const Candidate& candidate : plan.searches[o].candidates) tally.add(candidate);
    }
    return alone.tried() > 0 ? alone : in_groups;
}

}  // namespace dollytrack::planning
