#include "engine/io/files/bounded_json.h"
#include "engine/io/files/number_lines.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/json_file.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>

namespace dollytrack::verify {
namespace {

using Json = nlohmann::json;

constexpr const char* kCamera = "scene_camera.json";
constexpr const char* kTruth = "scene_gt.json";
constexpr const char* kInfo = "scene_gt_info.json";

constexpr double kBopTolerance = 1e-6;  // m and radians
constexpr double kMillimetres = 1000.0;

/// The three JSON files, parsed.
struct BopFiles {
    Json camera, truth, info;
};

Eigen::Matrix3d matrixFrom(const Json& values) {
    const auto numbers = values.get<std::array<double, 9>>();
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data());
}

/// A pose in metres from BOP's millimetres.
Eigen::Isometry3d poseFrom(const Json& rotation, const Json& translation_mm) {
    const auto t = translation_mm.get<std::array<double, 3>>();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = matrixFrom(rotation);
    pose.translation() = Eigen::Vector3d(t[0], t[1], t[2]) / kMillimetres;
    return pose;
}

/// Compares one frame of the three files with dataset.json and the instance image.
class BopFrameCheck {
  public:
    BopFrameCheck(const StoredDataset& dataset, FrameImages& images, Findings& findings)
        : dataset_(dataset), images_(images), findings_(findings), frame_(images.frame()) {}

    void run(const BopFiles& files) {
        const std::string key = std::to_string(frame_);
        compareCamera(files.camera.at(key));
        const Json& truths = files.truth.at(key);
        const Json& infos = files.info.at(key);
        if (truths.size() != infos.size()) {
            return add(kInfo, fmt::format("{} objects", infos.size()),
                       fmt::format("{}, as in {}", truths.size(), kTruth));
        }
        const Image16* ids = images_.image16("instance");
        if (!ids) return;
        const auto& seen = images_.seen();
        std::set<int> listed;
        for (std::size_t i = 0; i < truths.size(); ++i) {
            const int id = truths[i].at("obj_id").get<int>();
            const StoredObject* object = dataset_.object(id);
            const auto shown = seen.find(id);
            if (!object || shown == seen.end() || !listed.insert(id).second) {
                add(kTruth, fmt::format("object {}", id), "visible objects, each once");
                continue;
            }
            comparePose(*object, truths[i]);
            compareInfo(id, shown->second, infos[i]);
            compareMasks(id, static_cast<int>(i), *ids, infos[i]);
        }
        for (const auto& [id, shown] : seen) {
            const StoredObject* object = dataset_.object(id);
            if (!object || object->role != "target" || listed.contains(id)) continue;
            findings_.add({kTruth, frame_, std::array{shown.x0, shown.y0},
                           fmt::format("object {} is missing", id), "the visible objects"});
        }
    }

  private:
    void add(const std::string& file, std::string found, std::string expected) {
        findings_.add({file, frame_, {}, std::move(found), std::move(expected)});
    }

    void compareTransform(const char* file, const std::string& what, const Eigen::Isometry3d& found,
                          const Eigen::Isometry3d& expected) {
        const double away = (found.translation() - expected.translation()).norm();
        const double turned = (found.linear() - expected.linear()).norm() / std::sqrt(2.0);
        if (away <= kBopTolerance && turned <= kBopTolerance) return;
        add(file, fmt::format("{} {:.3g} m and {:.3g} rad off", what, away, turned),
            "that of dataset.json");
    }

    void compareCamera(const Json& camera) {
        const Intrinsics& lens = dataset_.lens;
        Eigen::Matrix3d k;
        // BOP puts pixel centres at integer coordinates.
        k << lens.fx, 0, lens.cx - 0.5, 0, lens.fy, lens.cy - 0.5, 0, 0, 1;
        if (!((matrixFrom(camera.at("cam_K")) - k).cwiseAbs().maxCoeff() <= kBopTolerance)) {
            add(kCamera, "cam_K " + camera.at("cam_K").dump(), "that of dataset.json");
        }
        compareTransform(kCamera, "camera",
                         poseFrom(camera.at("cam_R_w2c"), camera.at("cam_t_w2c")),
                         images_.stored().pose.worldFromCamera().inverse());
    }

    void comparePose(const StoredObject& object, const Json& truth) {
        compareTransform(kTruth, fmt::format("object {}", object.id),
                         poseFrom(truth.at("cam_R_m2c"), truth.at("cam_t_m2c")),
                         cameraFromBox(object, images_.stored()));
    }

    void compareInfo(int id, const ObjectPixels& shown, const Json& info) {
        const auto visible = info.at("px_count_visib").get<int>();
        if (visible != shown.count) {
            add(kInfo, fmt::format("object {}: px_count_visib {}", id, visible),
                fmt::format("{}", shown.count));
        }
        if (info.at("bbox_visib").get<std::array<double, 4>>() != shown.box()) {
            add(kInfo, fmt::format("object {}: bbox_visib {}", id, info.at("bbox_visib").dump()),
                fmt::format("{}", Json(shown.box()).dump()));
        }
        const auto silhouette = info.at("px_count_valid").get<double>();
        const auto all = info.at("px_count_all").get<double>();
        const auto fraction = info.at("visib_fract").get<double>();
        if (!(visible <= silhouette && silhouette <= all)) {
            add(kInfo,
                fmt::format("object {}: {} px seen of {} inside of {}", id, visible, silhouette,
                            all),
                "rising numbers");
        }
        if (!(std::abs(fraction * all - visible) <= kBopTolerance * all)) {
            add(kInfo, fmt::format("object {}: visib_fract {:.9g}", id, fraction),
                fmt::format("{:.9g}", visible / all));
        }
    }

    void compareMasks(int id, int number, const Image16& ids, const Json& info) {
        const Image8* visible = mask("mask_visib", number);
        if (visible) {
            compareMask("mask_visib", number, *visible,
                        [&](int x, int y, bool inside) { return inside == (ids.at(x, y) == id); });
        }
        const Image8* whole = mask("mask", number);
        if (!whole) return;
        compareMask("mask", number, *whole,
                    [&](int x, int y, bool inside) { return inside || ids.at(x, y) != id; });
        const auto covered = std::count(whole->values.begin(), whole->values.end(), 255);
        if (covered != info.at("px_count_valid").get<std::int64_t>()) {
            add(fileOf("mask", number), fmt::format("{} px inside", covered),
                fmt::format("{}, as {} says", info.at("px_count_valid").dump(), kInfo));
        }
    }

    [[nodiscard]] std::string fileOf(const char* folder, int number) const {
        return fmt::format("{}/{:06}_{:06}.png", folder, frame_, number);
    }

    /// Null, and a finding, if there is no mask of the image's size.
    const Image8* mask(const char* folder, int number) {
        const std::string file = fileOf(folder, number);
        Result<Image8> read = readImage8(dataset_.folder / file, 1);
        if (!read) {
            add(file, read.error().message, "a mask");
            return nullptr;
        }
        if (read->width != dataset_.lens.width || read->height != dataset_.lens.height) {
            add(file, fmt::format("{} x {} px", read->width, read->height), "the images' size");
            return nullptr;
        }
        mask_ = std::move(*read);
        return &mask_;
    }

    template <class Right>
    void compareMask(const char* folder, int number, const Image8& image, Right&& right) {
        WrongPixels wrong;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const int value = image.at(x, y);
                if ((value == 0 || value == 255) && right(x, y, value != 0)) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("{}", value), "the instance image's"};
                });
            }
        }
        wrong.report(fileOf(folder, number), frame_, findings_);
    }

    const StoredDataset& dataset_;
    FrameImages& images_;
    Findings& findings_;
    int frame_;
    Image8 mask_;
};

/// Null, and a finding, if the file is no JSON with one entry per frame.
Json parsed(const StoredDataset& dataset, const char* file, Findings& findings) {
    Result<Json> root = readJson(dataset.folder / file);
    if (!root || root->size() != dataset.frames.size()) {
        findings.add({file,
                      {},
                      {},
                      root ? "another number of frames" : root.error().message,
                      fmt::format("{} frames", dataset.frames.size())});
        return nullptr;
    }
    return std::move(*root);
}

}  // namespace

CheckWork beginBop(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    auto files = std::make_shared<BopFiles>();
    files->camera = parsed(dataset, kCamera, findings);
    files->truth = parsed(dataset, kTruth, findings);
    files->info = parsed(dataset, kInfo, findings);
    if (files->camera.is_null() || files->truth.is_null() || files->info.is_null()) return {};
    CheckWork work;
    work.frame = [&dataset, files = std::shared_ptr<const BopFiles>(files)](FrameImages& images,
                                                                            Findings& found) {
        try {
            BopFrameCheck(dataset, images, found).run(*files);
        } catch (const Json::exception& error) {
            found.add({kTruth, images.frame(), {}, plainReason(error), "BOP's numbers"});
        }
    };
    return work;
}

}  // namespace dollytrack::verify
