#include "ui/panels/timeline/timeline_time.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

double interval(const TimelineView& view) {
    return view.frame_interval_s > 0.0 ? view.frame_interval_s : 1.0;
}

bool hasTimes(const TimelineView& view) {
    return view.times_s != nullptr && view.times_s->size() > 1 &&
           static_cast<int>(view.times_s->size()) == view.frame_count;
}

}  // namespace

double timeOf(const TimelineView& view, double frame) {
    if (!hasTimes(view)) return frame * interval(view);
    const std::vector<double>& times = *view.times_s;
    const auto last = static_cast<double>(times.size() - 1);
    if (frame <= 0.0) return times.front() + frame * interval(view);
    if (frame >= last) return times.back() + (frame - last) * interval(view);
    const auto before = static_cast<std::size_t>(frame);
    const double share = frame - std::floor(frame);
    return share > 0.0 ? (1.0 - share) * times[before] + share * times[before + 1] : times[before];
}

double frameAt(const TimelineView& view, double time_s) {
    if (!hasTimes(view)) return time_s / interval(view);
    const std::vector<double>& times = *view.times_s;
    const auto last = static_cast<double>(times.size() - 1);
    if (time_s <= times.front()) return (time_s - times.front()) / interval(view);
    if (time_s >= times.back()) return last + (time_s - times.back()) / interval(view);
    const auto next = std::upper_bound(times.begin(), times.end(), time_s);
    const auto before = static_cast<std::size_t>(next - times.begin()) - 1;
    return static_cast<double>(before) +
           (time_s - times[before]) / (times[before + 1] - times[before]);
}

}  // namespace dollytrack::ui
