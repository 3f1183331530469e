#include "engine/plan/capture.h"
#include "engine/plan/image_score.h"
#include "render/verify/check/check_list.h"
#include "render/verify/compare/frame_rays.h"
#include "render/verify/read/number_table.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace dollytrack::verify {
namespace {

constexpr const char* kFramesFile = "frames.csv";

/// The file has six digits per number.
constexpr double kFramesRounding = 1e-5;

struct FramesTable {
    NumberTable rows;
    std::vector<std::vector<Eigen::AlignedBox2d>> boxes;  // of targets, by frame
    std::vector<char> seen;                               // whether the frame's image was read
    std::vector<double> clearances_m;                     // empty without a scene
};

class FramesReport {
  public:
    FramesReport(const FramesTable& table, Findings& findings)
        : table_(table), findings_(findings) {}

    void compare(std::size_t frame, const std::string& column, std::optional<double> expected) {
        const std::optional<double> found = table_.rows.number(frame, column);
        const auto text = [](std::optional<double> value) {
            return value ? fmt::format("{:.6g}", *value) : std::string("nothing");
        };
        if (found.has_value() == expected.has_value()) {
            // Near an expected 0, differences below the file's six digits are accepted.
            if (!found) return;
            const double off = std::abs(*found - *expected);
            if (off <= kFramesRounding * std::max(std::abs(*expected), 0.01)) return;
        }
        findings_.add({fmt::format("{}:{}", kFramesFile, frame + 2),
                       static_cast<int>(frame),
                       {},
                       column + " " + text(found),
                       text(expected)});
    }

    /// Requires a number between `low` and `high`.
    void within(std::size_t frame, const std::string& column, double low, double high) {
        const std::optional<double> found = table_.rows.number(frame, column);
        const double rounding = kFramesRounding * std::max(std::abs(low), std::abs(high));
        if (found && *found >= low - rounding && *found <= high + rounding) return;
        findings_.add({fmt::format("{}:{}", kFramesFile, frame + 2),
                       static_cast<int>(frame),
                       {},
                       column + (found ? fmt::format(" {:.6g}", *found) : std::string(" nothing")),
                       fmt::format("{:.6g} to {:.6g}", low, high)});
    }

  private:
    const FramesTable& table_;
    Findings& findings_;
};

/// The frames as imageScores() needs them; only their path matters.
Trajectory motionsOf(const FramesTable& table) {
    Trajectory trajectory;
    for (std::size_t i = 0; i < table.rows.rows(); ++i) {
        TrajectoryFrame frame;
        frame.path = static_cast<int>(table.rows.number(i, "path").value_or(0.0));
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

ScoreWeights weightsOf(const StoredDataset& dataset) {
    ScoreWeights weights;
    const auto repair = dataset.card.at("parameters").value("repair", nlohmann::ordered_json());
    if (!repair.is_object()) return weights;
    weights.separation = repair.value("separation_weight", weights.separation);
    weights.continuity = repair.value("continuity_weight", weights.continuity);
    weights.window = repair.value("score_window", weights.window);
    weights.squared = repair.value("squared_separation", weights.squared);
    return weights;
}

void compareMotion(const Subject& subject, const FramesTable& table, FramesReport& report) {
    const auto& frames = subject.dataset.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        report.compare(i, "frame", static_cast<double>(i));
        report.compare(i, "time_s", frames[i].time_s);
        report.compare(i, "trajectory_frame", frames[i].source_frame);
        const bool goes_on =
            i > 0 && table.rows.number(i, "path") == table.rows.number(i - 1, "path");
        std::optional<double> speed, turn;
        if (goes_on && frames[i].time_s > frames[i - 1].time_s) {
            const double seconds = frames[i].time_s - frames[i - 1].time_s;
            const Pose& before = frames[i - 1].pose;
            const Pose& now = frames[i].pose;
            speed = (now.position - before.position).norm() / seconds;
            const Eigen::AngleAxisd between(before.rotation.conjugate() * now.rotation);
            turn = std::abs(between.angle()) * 180.0 / std::numbers::pi / seconds;
        }
        report.compare(i, "speed_mps", speed);
        report.compare(i, "turn_dps", turn);
        if (!table.clearances_m.empty()) {
            report.compare(i, "clearance_m", table.clearances_m[i]);
        }
    }
}

/// Light that varies by frame must stay within its range around the set value: a factor, or for the
/// exposure a difference.
void compareLight(const StoredDataset& dataset, const FramesTable& table, FramesReport& report) {
    const auto set = dataset.card.at("parameters").value("light", nlohmann::ordered_json());
    if (!set.is_object() || set.value("light_varies", "") != "frame") return;
    const double variation = set.value("light_variation", 0.0);
    if (variation <= 0.0) return;
    struct Column {
        const char* name;
        double most;  // as a power of two
    };
    for (const auto& [name, most] :
         {Column{"lamp_strength", 1.0}, Column{"lamp_temperature_K", 0.5},
          Column{"sky_strength", 0.7}, Column{"sun_strength", 0.7}, Column{"exposure_ev", 0.7}}) {
        double middle = set.value(name, 0.0);
        const std::string column = name;
        if (column == "lamp_temperature_K" && middle == 0.0) middle = 5500.0;
        const double times = std::exp2(most * variation);
        double low = middle / times;
        double high = middle * times;
        if (column == "exposure_ev") {
            low = middle - most * variation;
            high = middle + most * variation;
        } else if (column == "lamp_temperature_K") {
            low = std::max(low, 1000.0);
            high = std::min(std::max(high, low), 20000.0);
        } else {
            high = std::min(high, column == "sky_strength" ? 20.0 : 10.0);
        }
        for (std::size_t i = 0; i < table.rows.rows(); ++i) report.within(i, column, low, high);
    }
}

void compareImages(const StoredDataset& dataset, const FramesTable& table, FramesReport& report) {
    const auto scores = imageScores(motionsOf(table), table.boxes, weightsOf(dataset));
    bool all_seen = true;
    for (std::size_t i = 0; i < table.boxes.size(); ++i) {
        if (!table.seen[i]) {
            all_seen = false;
            continue;
        }
        report.compare(i, "targets", static_cast<double>(table.boxes[i].size()));
        if (all_seen) report.compare(i, "score", scores[i]);  // scores depend on earlier frames
    }
}

void takeBoxes(const StoredDataset& dataset, FrameImages& images, FramesTable& table) {
    const Image16* ids = images.image16("instance");
    if (!ids) return;
    const std::size_t frame = images.frame();
    // Smaller objects count as not shown; the rule is for 640 x 480.
    const double least_px =
        CaptureRules{}.min_visible_px * ids->width * ids->height / (640.0 * 480.0);
    for (const auto& [id, shown] : images.seen()) {
        const StoredObject* object = dataset.object(id);
        if (!object || object->role != "target" || shown.count < least_px) continue;
        table.boxes[frame].emplace_back(Eigen::Vector2d(shown.x0, shown.y0),
                                        Eigen::Vector2d(shown.x1 + 1, shown.y1 + 1));
    }
    table.seen[frame] = 1;
}

}  // namespace

CheckWork beginFrames(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    Result<NumberTable> rows = NumberTable::read(dataset.folder / kFramesFile);
    if (!rows) {
        findings.add({kFramesFile, {}, {}, describe(rows.error()), "a table"});
        return {};
    }
    if (rows->rows() != dataset.frames.size()) {
        findings.add({kFramesFile,
                      {},
                      {},
                      fmt::format("{} rows", rows->rows()),
                      fmt::format("{}, one a frame", dataset.frames.size())});
        return {};
    }
    auto table = std::make_shared<FramesTable>(FramesTable{std::move(*rows), {}, {}, {}});
    table->boxes.resize(dataset.frames.size());
    table->seen.resize(dataset.frames.size(), 0);
    if (subject.rays) table->clearances_m.resize(dataset.frames.size(), 0.0);
    CheckWork work;
    work.frame = [&subject, table](FrameImages& images, Findings& /*found*/) {
        takeBoxes(subject.dataset, images, *table);
        if (!subject.rays) return;
        const StoredFrame& frame = images.stored();
        table->clearances_m[images.frame()] = FrameRays(subject, frame, frame.pose).clearance();
    };
    work.finish = [&subject, table](Findings& found, const JobContext&) {
        FramesReport report(*table, found);
        compareMotion(subject, *table, report);
        compareLight(subject.dataset, *table, report);
        compareImages(subject.dataset, *table, report);
    };
    return work;
}

}  // namespace dollytrack::verify
