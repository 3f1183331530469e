#include "render/verify/check/check_list.h"
#include "render/verify/read/amodal_masks.h"
#include "render/verify/read/number_table.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace dollytrack::verify {
namespace {

constexpr const char* kInstancesFile = "instances.csv";

struct InstancesTable {
    NumberTable rows;
    std::vector<std::map<int, std::size_t>> of_frame;  // row number by object id
};

/// Compares fields of one row.
class RowReport {
  public:
    RowReport(const InstancesTable& table, std::size_t row, int frame, Findings& findings)
        : table_(table), row_(row), frame_(frame), findings_(findings) {}

    void compare(const std::string& column, double expected, double tolerance = 0.0) {
        const std::optional<double> found = table_.rows.number(row_, column);
        if (found && std::abs(*found - expected) <= tolerance) return;
        findings_.add({fmt::format("{}:{}", kInstancesFile, row_ + 2),
                       frame_,
                       {},
                       fmt::format("{} {}", column,
                                   found ? fmt::format("{:.6g}", *found) : std::string("nothing")),
                       fmt::format("{:.6g}", expected)});
    }
    [[nodiscard]] double number(const std::string& column) const {
        return table_.rows.number(row_, column).value_or(std::nan(""));
    }

  private:
    const InstancesTable& table_;
    std::size_t row_;
    int frame_;
    Findings& findings_;
};

constexpr double kShare = 2e-5;  // numbers have about six digits
constexpr double kMetres = 2e-5;

void compareClasses(RowReport& row, const StoredDataset& dataset, const StoredObject& object) {
    row.compare("nyu40", object.nyu40);
    if (dataset.own_classes) row.compare("class_id", object.class_id);
}

void compareVisible(RowReport& row, const ObjectPixels& seen) {
    row.compare("visible_px", seen.count);
    row.compare("x", seen.x0);
    row.compare("y", seen.y0);
    row.compare("width", seen.x1 - seen.x0 + 1);
    row.compare("height", seen.y1 - seen.y0 + 1);
    // Shares must be consistent with the amodal area in the same row.
    const double whole = row.number("whole_px");
    const double silhouette = row.number("silhouette_px");
    if (whole > 0.0) {
        row.compare("visible_fraction", seen.count / whole, kShare);
        row.compare("truncation", 1.0 - silhouette / whole, kShare);
    }
    if (!(whole >= silhouette)) row.compare("whole_px", silhouette);
    if (!(silhouette >= seen.count)) row.compare("silhouette_px", seen.count);
}

/// Compares with the amodal mask and with the occluding objects.
void compareWhole(RowReport& row, const AmodalMask& mask, const Image16& ids) {
    const auto pixels = insideOf(mask, ids.width, ids.height);
    if (pixels.empty()) return;  // reported by another check
    const auto area = std::count(pixels.begin(), pixels.end(), 1);
    row.compare("silhouette_px", static_cast<double>(area));
    row.compare("amodal_x", mask.box[0]);
    row.compare("amodal_y", mask.box[1]);
    row.compare("amodal_width", mask.box[2]);
    row.compare("amodal_height", mask.box[3]);
    std::map<int, int> hiding;
    auto inside = pixels.begin();
    for (int x = 0; x < ids.width; ++x) {
        for (int y = 0; y < ids.height; ++y, ++inside) {
            const int id = ids.at(x, y);
            if (*inside != 0 && id != 0 && id != mask.object_id) ++hiding[id];
        }
    }
    int most = 0;
    for (const auto& [id, count] : hiding) most = std::max(most, count);
    const auto said = static_cast<int>(row.number("occluder_id"));
    const auto at = hiding.find(said);
    // If two objects hide the same share, either may be named.
    if (most == 0 || at == hiding.end() || at->second != most) {
        const auto first = std::find_if(hiding.begin(), hiding.end(),
                                        [most](const auto& one) { return one.second == most; });
        row.compare("occluder_id", most == 0 ? 0 : first->first);
    }
    row.compare("occluder_fraction", area > 0 ? double(most) / static_cast<double>(area) : 0.0,
                kShare);
}

void compareBox(RowReport& row, const StoredObject& object, const StoredFrame& frame) {
    const Eigen::Isometry3d box = cameraFromBox(object, frame);
    const char* const axes[] = {"x", "y", "z"};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const std::string name = axes[axis];
        row.compare("center_" + name, box.translation()[axis], kMetres);
        row.compare("size_" + name, 2.0 * object.box.half_size[axis], kMetres);
    }
    const Eigen::Quaterniond said(row.number("quaternion_w"), row.number("quaternion_x"),
                                  row.number("quaternion_y"), row.number("quaternion_z"));
    const Eigen::Quaterniond expected(box.linear());
    // q and -q are the same rotation.
    const double sign = said.dot(expected) < 0.0 ? -1.0 : 1.0;
    row.compare("quaternion_x", sign * expected.x(), kShare);
    row.compare("quaternion_y", sign * expected.y(), kShare);
    row.compare("quaternion_z", sign * expected.z(), kShare);
    row.compare("quaternion_w", sign * expected.w(), kShare);
}

std::shared_ptr<InstancesTable> readTable(const StoredDataset& dataset, Findings& findings) {
    Result<NumberTable> rows = NumberTable::read(dataset.folder / kInstancesFile);
    if (!rows) {
        findings.add({kInstancesFile, {}, {}, describe(rows.error()), "a table"});
        return nullptr;
    }
    auto table = std::make_shared<InstancesTable>(InstancesTable{std::move(*rows), {}});
    table->of_frame.resize(dataset.frames.size());
    for (std::size_t row = 0; row < table->rows.rows(); ++row) {
        const double frame = table->rows.number(row, "frame").value_or(-1.0);
        const auto id = static_cast<int>(table->rows.number(row, "object_id").value_or(0.0));
        const bool fits = frame >= 0.0 && frame < static_cast<double>(dataset.frames.size());
        if (!fits || !dataset.object(id) || !table->of_frame[frame].emplace(id, row).second) {
            findings.add({fmt::format("{}:{}", kInstancesFile, row + 2),
                          {},
                          {},
                          fmt::format("frame {}, object {}", frame, id),
                          "frames and objects of dataset.json, each pair once"});
        }
    }
    return table;
}

void compareFrame(const StoredDataset& dataset, const InstancesTable& table, FrameImages& images,
                  Findings& findings) {
    const Image16* ids = images.image16("instance");
    if (!ids) return;
    const int frame = images.frame();
    const auto& rows = table.of_frame[frame];
    const auto& seen = images.seen();
    for (const auto& [id, shown] : seen) {
        const StoredObject* object = dataset.object(id);
        if (!object || object->role != "target" || rows.contains(id)) continue;
        findings.add({kInstancesFile, frame, std::array{shown.x0, shown.y0},
                      fmt::format("no row of object {}", id), "one, because it is visible"});
    }
    std::vector<AmodalMask> masks;
    if (dataset.has("amodal")) {
        const auto read = readAmodal(dataset.folder / amodalFile(frame), ids->width, ids->height);
        if (read) masks = *read;
    }
    for (const auto& [id, number] : rows) {
        RowReport row(table, number, frame, findings);
        const auto shown = seen.find(id);
        const StoredObject& object = *dataset.object(id);
        compareClasses(row, dataset, object);
        compareVisible(row, shown == seen.end() ? ObjectPixels{} : shown->second);
        compareBox(row, object, images.stored());
        for (const AmodalMask& mask : masks) {
            if (mask.object_id == id) compareWhole(row, mask, *ids);
        }
    }
}

}  // namespace

CheckWork beginInstances(const Subject& subject, Findings& findings) {
    const auto table = readTable(subject.dataset, findings);
    if (!table) return {};
    CheckWork work;
    work.frame = [&dataset = subject.dataset, table](FrameImages& images, Findings& found) {
        compareFrame(dataset, *table, images, found);
    };
    return work;
}

}  // namespace dollytrack::verify
