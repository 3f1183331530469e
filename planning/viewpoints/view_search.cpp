#include "planning/viewpoints/view_search.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/candidate_evaluator.h"
#include "planning/viewpoints/candidate_source.h"
#include "planning/viewpoints/exact_viewpoint_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kRefined = 5;  // candidates resampled with the fine grid
constexpr int kConeDirections = 20;
constexpr int kAroundDirections = 64;
constexpr int kHardPlaces = 400;
constexpr int kRandomPlaces = 160;
constexpr double kLeastRandomFill = 0.08;
// An object larger than the image may still show enough of itself: a wardrobe in a narrow room.
constexpr double kMostRandomFill = 2.0;
constexpr int kCeilingDirections = 12;
constexpr double kCeilingHalfAngle = 0.35;  // rad
constexpr int kHardDirections = 200;
constexpr int kEnoughGood = 12;
// Evolutionary search around the best candidates, if sampling found no good view.
constexpr std::size_t kParents = 8;
constexpr int kGenerations = 10;
constexpr std::size_t kChildren = 48;
constexpr double kFirstSpread = 0.3;         // relative to the distance to the target
constexpr double kShrinking = 0.75;          // factor of the spread per generation
constexpr double kHope = 1.1;                // nearness that one unit of spread can still gain
constexpr double kWorthAnotherSearch = 0.4;  // largest missing nearness for another round of
                                             // directions
constexpr double kWorthLuck = 0.2;           // largest missing nearness for a last random search
constexpr double kApart = 0.25;              // least distance between parents, relative to the
                                             // spread
constexpr double kNegligible = 0.01;         // difference in quality
constexpr int kEarlySamplings = 2;           // fine samplings tried during the coarse pass, to end
                                             // the search early
// The range of fill that the paper searches.
constexpr double kLeastFill = 0.35;
constexpr double kMostFill = 0.85;

/// Whether the verdict needed rays, and not the position alone.
bool neededRays(Verdict verdict) {
    return verdict == Verdict::Legal || verdict == Verdict::OccludedBy ||
           verdict == Verdict::Cropped || verdict == Verdict::TooSmall ||
           verdict == Verdict::InGap || verdict == Verdict::Unscanned;
}

class Search {
  public:
    Search(const PlanningEnvironment& environment, const ObservationPoint& point,
           const ViewpointParams& params, Random random)
        : environment_(environment),
          point_(point),
          params_(params),
          evaluator_(environment, point, params.fill),
          random_(random) {
        for (const int id : point.objects)
            footprint_.target.extend(reachedBox(environment.views, id));
    }

    FoundView run() {
        const double half_angle = params_.cone_half_angle_deg * std::numbers::pi / 180.0;
        tryDirections(directionsInCone(point_.direction, half_angle, kConeDirections),
                      {1.0, 0.8, 1.25});
        // A group without a good view in its cone is split; only single objects are searched
        // further.
        if (!refineBest() && point_.objects.size() == 1) {
            tryDirections(directionsAllAround(point_.direction, kAroundDirections),
                          {1.0, 0.75, 0.55});
            if (!refineBest()) {
                footprint_.sampled_around = evaluator_.subject().center;
                footprint_.sampled_within_m =
                    furthestUseful(environment_.views, evaluator_.subject(), kLeastRandomFill);
                tryRandomPlaces(kLeastRandomFill, kMostRandomFill, kRandomPlaces);
                tryFromTheCeiling();
                if (!refineBest()) searchHard();
            }
        }
        return finish();
    }

  private:
    void tryDirections(const std::vector<Eigen::Vector3d>& directions,
                       const std::vector<double>& shares_of_wish) {
        const double wish = evaluator_.wishedFill();
        for (const Eigen::Vector3d& wanted : directions) {
            // Directions are sorted, the best first: stop after enough good views.
            const auto good = std::count_if(
                pending_.begin(), pending_.end(),
                [](const EvaluatedCandidate& evaluated) { return evaluated.all_well; });
            if (good >= kEnoughGood) break;
            // With a pitch band most directions are too steep: clamp them to the band.
            const Eigen::Vector3d direction =
                environment_.pitch.restricts()
                    ? Eigen::Vector3d(-intoBand(-wanted, environment_.pitch))
                    : wanted;
            for (const double share : shares_of_wish) {
                const double fill =
                    std::clamp(share * wish, std::min(kLeastFill, wish), std::max(kMostFill, wish));
                const double distance =
                    distanceForFill(environment_.views, evaluator_.subject(), direction, fill);
                // With a height band most positions are outside it: clamp them to the band.
                const bool legal = take(evaluator_.evaluate(
                    environment_.sphere.inBand(evaluator_.subject().center + direction * distance),
                    SamplingDensity::Coarse));
                if (legal && isAsGoodAsAny()) return;
            }
        }
    }

    /// Whether the last candidate is as good as possible by fine sampling; then it is the result.
    bool isAsGoodAsAny() {
        if (early_samplings_ == kEarlySamplings ||
            pending_.back().quality < highestQuality() - kNegligible) {
            return false;
        }
        ++early_samplings_;
        EvaluatedCandidate fine =
            evaluator_.evaluate(pending_.back().candidate.position, SamplingDensity::Fine);
        if (!fine.all_well || fine.quality < highestQuality() - kNegligible) return false;
        best_ = std::move(fine);
        pending_.clear();
        return true;
    }

    void tryRandomPlaces(double least_fill, double most_fill, int count) {
        for (EvaluatedCandidate& evaluated : evaluateAll(
                 randomPlaces(environment_.free_space, environment_.sphere, environment_.views,
                              evaluator_.subject(), least_fill, most_fill, count, random_),
                 SamplingDensity::Coarse)) {
            take(std::move(evaluated));
        }
    }

    /// An object between tall ones may only be visible from straight above, where the wished
    /// distance of a low object would be above the ceiling.
    void tryFromTheCeiling() {
        const Eigen::Vector3d& center = evaluator_.subject().center;
        double above = 0.0;
        for (const Eigen::Vector3d& p : evaluator_.subject().points) {
            above = std::max(above, (p - center).norm());
        }
        const double reach = environment_.sphere.radius() + SweptSphere::kMargin;
        std::vector<Eigen::Vector3d> places;
        for (const Eigen::Vector3d& up :
             directionsInCone(Eigen::Vector3d::UnitZ(), kCeilingHalfAngle, kCeilingDirections)) {
            const RayHit ceiling = environment_.views.rays().cast(center + up * above, up);
            if (ceiling.object_id == 0) continue;
            for (const double share : {1.0, 0.6}) {
                const double distance = above + share * (ceiling.distance - reach / up.z());
                places.push_back(environment_.sphere.inBand(center + up * distance));
            }
        }
        for (EvaluatedCandidate& evaluated : evaluateAll(places, SamplingDensity::Coarse))
            take(std::move(evaluated));
    }

    /// Evaluates candidates in parallel, for the long stages of the search.
    std::vector<EvaluatedCandidate> evaluateAll(const std::vector<Eigen::Vector3d>& places,
                                                SamplingDensity density) const {
        std::vector<EvaluatedCandidate> evaluated(places.size());
        parallelFor(places.size(),
                    [&](std::size_t i) { evaluated[i] = evaluator_.evaluate(places[i], density); });
        return evaluated;
    }

    /// Records what a candidate depends on. Finer sampling at the same position depends on nothing
    /// more.
    void note(const EvaluatedCandidate& evaluated) {
        footprint_.places.push_back(
            {evaluated.candidate.position, neededRays(evaluated.candidate.verdict)});
    }

    /// Adds a candidate. Returns whether it is legal and worth finer sampling.
    bool take(EvaluatedCandidate evaluated) {
        note(evaluated);
        candidates_.push_back(evaluated.candidate);
        if (evaluated.quality < 0.0) return false;
        evaluated.order = static_cast<int>(pending_.size());
        if (point_.objects.size() == 1) promising_.push_back(evaluated);
        pending_.push_back(std::move(evaluated));
        return true;
    }

    /// Resamples the best new candidates with the fine grid. Returns whether the best view captures
    /// all objects well.
    bool refineBest() {
        const auto count = std::min(kRefined, pending_.size());
        std::partial_sort(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(count),
                          pending_.end(),
                          [](const EvaluatedCandidate& a, const EvaluatedCandidate& b) {
                              return std::pair(a.quality, b.order) > std::pair(b.quality, a.order);
                          });
        for (std::size_t i = 0; i < count; ++i) {
            // Most objects are fully visible from the first candidate already.
            constexpr double kRounding = 1e-9;
            if (pending_[i].at_most <= (best_ ? best_->quality : 0.0) + kRounding) continue;
            EvaluatedCandidate fine =
                evaluator_.evaluate(pending_[i].candidate.position, SamplingDensity::Fine);
            if (!best_ || fine.quality > best_->quality) best_ = std::move(fine);
        }
        pending_.clear();
        return best_ && best_->all_well;
    }

    /// Keeps the candidates with the highest nearness, at a distance from one another.
    void chooseParents(double spread) {
        std::stable_sort(promising_.begin(), promising_.end(),
                         [](const EvaluatedCandidate& a, const EvaluatedCandidate& b) {
                             return std::pair(a.nearness, a.quality) >
                                    std::pair(b.nearness, b.quality);
                         });
        std::vector<EvaluatedCandidate> parents;
        for (EvaluatedCandidate& one : promising_) {
            if (parents.size() == kParents) break;
            const double apart = kApart * spread * distanceOf(one);
            if (std::all_of(parents.begin(), parents.end(), [&](const EvaluatedCandidate& other) {
                    return (one.candidate.position - other.candidate.position).norm() >= apart;
                })) {
                parents.push_back(std::move(one));
            }
        }
        promising_ = std::move(parents);
    }

    /// Samples around the best candidates with shrinking spread. Many objects are visible only from
    /// a small region, for example between two objects, that random samples miss.
    void breed() {
        double spread = kFirstSpread;
        for (int generation = 0; generation < kGenerations; ++generation) {
            chooseParents(spread);
            // The possible gain shrinks with the spread.
            if (promising_.empty() || missing() > kHope * spread) return;
            std::vector<Eigen::Vector3d> children;
            for (std::size_t i = 0; i < kChildren; ++i) {
                const EvaluatedCandidate& parent = promising_[i % promising_.size()];
                const Eigen::Vector3d offset(random_.normal(), random_.normal(), random_.normal());
                children.push_back(environment_.sphere.onHeight(
                    parent.candidate.position + spread * distanceOf(parent) * offset));
            }
            for (EvaluatedCandidate& child : evaluateAll(children, SamplingDensity::Medium)) {
                note(child);
                if (child.quality >= 0.0) promising_.push_back(std::move(child));
            }
            chooseParents(spread);
            for (EvaluatedCandidate& one : promising_) {
                if (!one.all_well) break;
                // If fine sampling rejects a candidate, it stays a parent with its corrected
                // nearness.
                one = evaluator_.evaluate(one.candidate.position, SamplingDensity::Fine);
                if (one.all_well) {
                    best_ = std::move(one);
                    return;
                }
            }
            spread *= kShrinking;
        }
    }

    /// Nearness that the best candidate lacks.
    [[nodiscard]] double missing() const { return 2.0 - promising_.front().nearness; }

    void searchHard() {
        breed();
        if (best_ && best_->all_well) return;
        if (promising_.empty() || missing() > kWorthAnotherSearch) return;
        tryDirections(directionsAllAround(point_.direction, kHardDirections), {1.3, 0.9, 0.6});
        if (refineBest()) return;
        breed();
        if (best_ && best_->all_well) return;
        if (takeJustCaptured() || missing() > kWorthLuck) return;
        // Once more with other random candidates: hitting a small region is chance, and few objects
        // get here.
        tryRandomPlaces(0.15, 1.0, kHardPlaces);
        if (refineBest()) return;
        breed();
        if (best_ && best_->all_well) return;
        takeJustCaptured();
    }

    /// Accepts a view that captures the object without the safety margins.
    bool takeJustCaptured() {
        chooseParents(kFirstSpread);
        std::vector<Eigen::Vector3d> places;
        for (const EvaluatedCandidate& one : promising_) {
            if (one.nearness >= kPromisingNearness) places.push_back(one.candidate.position);
        }
        const ExactSearchResult exact =
            searchExactViewpoint(environment_, evaluator_, point_.objects.front(), places, random_);
        for (const EvaluatedCandidate& tried : exact.tried) note(tried);
        if (exact.place) best_ = evaluator_.evaluate(*exact.place, SamplingDensity::Fine);
        return exact.place.has_value();
    }

    [[nodiscard]] double distanceOf(const EvaluatedCandidate& evaluated) const {
        return (evaluated.candidate.position - evaluator_.subject().center).norm();
    }

    FoundView finish() {
        FoundView found;
        found.search.candidates = std::move(candidates_);
        found.footprint = std::make_shared<const SearchFootprint>(std::move(footprint_));
        if (!best_) {
            found.not_well = point_.objects;
            return found;
        }
        PositionPoint p;
        p.pose = aim(best_->candidate.position, evaluator_.subject().center, environment_.pitch);
        p.component = environment_.free_space.componentAt(p.pose.position);
        p.fill = best_->candidate.fill;
        if (best_->all_well) {
            p.well_captured = p.captured = point_.objects;
            p.own = std::move(best_->shown);
            found.best = std::move(p);
            return found;
        }
        for (const int id : point_.objects) {
            // Exact and without margins: the trajectory passes through this pose, and an object
            // captured only just is better than none.
            const ObjectView view = makeView(environment_.views.estimateExactly(p.pose, id), id, 0);
            if (isWellCaptured(view)) {
                p.well_captured.push_back(id);
            } else {
                found.not_well.push_back(id);
            }
            if (isCaptured(view)) p.captured.push_back(id);
        }
        if (!p.captured.empty()) found.best = std::move(p);
        return found;
    }

    const PlanningEnvironment& environment_;
    const ObservationPoint& point_;
    const ViewpointParams& params_;
    CandidateEvaluator evaluator_;
    Random random_;
    std::vector<Candidate> candidates_;
    std::vector<EvaluatedCandidate> pending_;
    std::vector<EvaluatedCandidate> promising_;  // legal candidates of a single object, for breed()
    std::optional<EvaluatedCandidate> best_;
    int early_samplings_ = 0;
    SearchFootprint footprint_;
};

}  // namespace

FoundView searchView(const PlanningEnvironment& environment, const ObservationPoint& point,
                     const ViewpointParams& params, Random random) {
    return Search(environment, point, params, random).run();
}

}  // namespace dollytrack::planning
