// Checks the per-frame HDF5 files in BlenderProc's layout: the frame's images and its pose.
#include "engine/io/files/bounded_json.h"
#include "engine/io/hdf5/hdf5_reader.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/json_file.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace dollytrack::verify {
namespace {

using Json = nlohmann::json;

constexpr double kHdf5Tolerance = 1e-6;

class Hdf5FrameCheck {
  public:
    Hdf5FrameCheck(const StoredDataset& dataset, FrameImages& images, Findings& findings)
        : dataset_(dataset),
          images_(images),
          findings_(findings),
          file_(fmt::format("hdf5/{:06}.hdf5", images.frame())) {}

    void run() {
        compareColors();
        compareDepth();
        compareIds();
        comparePose();
    }

  private:
    void add(std::string found, std::string expected) {
        findings_.add({file_, images_.frame(), {}, std::move(found), std::move(expected)});
    }

    /// Reads an image; returns nothing and adds a finding if its size differs.
    std::optional<std::vector<double>> image(const std::string& name, std::size_t channels) {
        const auto width = static_cast<std::uint64_t>(dataset_.lens.width);
        const auto height = static_cast<std::uint64_t>(dataset_.lens.height);
        auto numbers = readHdf5Numbers(dataset_.folder / file_, name, width * height * channels);
        if (!numbers) {
            add(numbers.error().message, name);
            return std::nullopt;
        }
        std::vector<std::uint64_t> size = {height, width};
        if (channels > 1) size.push_back(channels);
        if (numbers->size != size) {
            add(name + " of another size", fmt::format("{} x {}", width, height));
            return std::nullopt;
        }
        return std::move(numbers->values);
    }

    /// `expected(i)` is value i, row 0 at the top; NaN accepts any value.
    template <class Expected>
    void compare(const std::string& name, const std::vector<double>& found, std::size_t channels,
                 double tolerance, const Expected& expected) {
        WrongPixels wrong;
        const std::size_t width = dataset_.lens.width;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double right = expected(i);
            if (std::isnan(right) || std::abs(found[i] - right) <= tolerance) continue;
            const std::size_t pixel = i / channels;
            wrong.add(static_cast<int>(pixel % width), static_cast<int>(pixel / width), [&] {
                return WrongPixels::Text{fmt::format("{} {:.6g}", name, found[i]),
                                         fmt::format("{:.6g}", right)};
            });
        }
        wrong.report(file_, images_.frame(), findings_);
    }

    void compareColors() {
        const auto colors = image("colors", 3);
        const Image8* rgb = images_.image8("rgb");
        if (!colors || !rgb) return;
        compare("colors", *colors, 3, 0.0, [&](std::size_t i) { return rgb->values[i]; });
    }

    void compareDepth() {
        const auto metres = image("depth", 1);
        const FrameImages::Depth* depth = images_.depth();
        if (!metres || !depth) return;
        // A depth image in millimetres does not cover depth beyond its range.
        const bool exact = std::string_view(depth->modality) == "depth_exr";
        compare("depth", *metres, 1, depth->rounding_m + kHdf5Tolerance, [&](std::size_t i) {
            const double known = depth->metres.values[i];
            return known > 0.0 || exact ? known : std::nan("");
        });
    }

    void compareIds() {
        const Image16* ids = images_.image16("instance");
        if (!ids) return;
        if (const auto instances = image("instance_segmaps", 1)) {
            compare("instance", *instances, 1, 0.0, [&](std::size_t i) { return ids->values[i]; });
        }
        if (const auto classes = image("category_id_segmaps", 1)) {
            compare("class", *classes, 1, 0.0,
                    [&](std::size_t i) { return dataset_.pixelClass(ids->values[i]); });
        }
        compareAttributes();
    }

    void compareAttributes() {
        constexpr const char* kName = "instance_attribute_maps";
        const auto text = readHdf5Text(dataset_.folder / file_, kName);
        if (!text) return add(text.error().message, kName);
        const auto& seen = images_.seen();
        std::set<int> listed;
        const Json things = parseJson(*text).value_or(Json());
        for (const Json& one : things) {
            const int id = one.at("idx").get<int>();
            listed.insert(id);
            const StoredObject* object = dataset_.object(id);
            if (!object || !seen.contains(id)) {
                add(fmt::format("{} lists object {}", kName, id), "the visible objects");
            } else if (one.at("category_id").get<int>() != object->class_id ||
                       one.at("name").get<std::string>() != object->name) {
                add(fmt::format("object {}: {}", id, one.dump()),
                    fmt::format("{}, class {}", object->name, object->class_id));
            }
        }
        for (const auto& [id, pixels] : seen) {
            if (!listed.contains(id)) {
                add(fmt::format("{} lists no object {}", kName, id), "the visible objects");
            }
        }
    }

    void comparePose() {
        const auto text = readHdf5Text(dataset_.folder / file_, "campose");
        if (!text) return add(text.error().message, "campose");
        const auto rows =
            parseJson(*text).value_or(Json()).get<std::array<std::array<double, 4>, 4>>();
        Eigen::Matrix4d expected = images_.stored().pose.worldFromCamera().matrix();
        expected.col(1) *= -1.0;  // y up, z back in these files
        expected.col(2) *= -1.0;
        double off = 0.0;
        for (std::size_t i = 0; i < 16; ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            off = std::max(off, std::abs(rows[i / 4][i % 4] - expected(at / 4, at % 4)));
        }
        if (!(off <= kHdf5Tolerance)) add(fmt::format("campose {:.3g} off", off), "dataset.json's");
    }

    const StoredDataset& dataset_;
    FrameImages& images_;
    Findings& findings_;
    std::string file_;
};

}  // namespace

CheckWork beginHdf5(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        try {
            Hdf5FrameCheck(dataset, images, findings).run();
        } catch (const Json::exception& error) {
            findings.add({fmt::format("hdf5/{:06}.hdf5", images.frame()),
                          images.frame(),
                          {},
                          plainReason(error),
                          "BlenderProc's JSON"});
        }
    };
    return work;
}

}  // namespace dollytrack::verify
