#include "render/encoders/modalities.h"
#include "render/frames/frame_file.h"
#include "render/frames/mask_rle.h"
#include "render/truth/visibility_mask.h"
#include "render/verify/read/exr_file.h"
#include "tests/render/dataset/dataset_fixture.h"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstring>
#include <sstream>

namespace dollytrack::render::truth_gl_test {
namespace {

namespace fs = std::filesystem;
using fixture::smallCamera;

/// A camera that passes the objects of the room, none of which is far away.
Trajectory pass(int frames) {
    Trajectory trajectory;
    for (int i = 0; i < frames; ++i) {
        TrajectoryFrame frame;
        frame.time_s = 0.1 * i;
        frame.target_in_world = {2.2, 2.4, 0.4};
        frame.pose = lookAt({0.9 + 0.12 * i, 0.4, 0.6}, frame.target_in_world);
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

struct Flow {
    std::vector<Eigen::Vector2f> motion;
    cv::Mat mask;
};

class TruthGl : public fixture::DatasetGlTest {
  protected:
    int idOf(const std::string& name) const {
        for (const Object& object : scene_.objects) {
            if (object.name == name) return object.id;
        }
        ADD_FAILURE() << "there is no " << name;
        return 0;
    }

    /// Exports all modalities of a short motion; if `moving`, the first target moves.
    void exportAll(bool moving) {
        trajectory_ = pass(4);
        auto context = gl::createOsMesaContext();
        ASSERT_TRUE(context);
        DatasetSettings settings;
        settings.folder = folder_ / "out";
        settings.modalities = {"all"};
        settings.formats = {"all"};
        settings.flow_distances = {1, 2};
        DatasetOrigin origin;
        if (moving) {
            const Object& sofa = scene_.object(idOf("sofa"));
            ObjectMotion& motion = origin.motions.emplace_back();
            motion.object_id = sofa.id;
            for (int i = 0; i < 4; ++i) {
                motion.by_frame.push_back(
                    Eigen::Translation3d(sofa.box.center + Eigen::Vector3d(0.08 * i, 0, 0.02 * i)) *
                    Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitZ()) *
                    Eigen::Translation3d(-sofa.box.center));
            }
        }
        motions_ = origin.motions;
        const auto summary = exportDataset(std::move(*context), scene_, rays_, trajectory_,
                                           smallCamera(), settings, origin, {});
        ASSERT_TRUE(summary) << describe(summary.error());
    }

    cv::Mat image(const std::string& file) const {
        cv::Mat found = cv::imread((folder_ / "out" / file).string(), cv::IMREAD_UNCHANGED);
        EXPECT_FALSE(found.empty()) << file;
        return found;
    }

    Flow flow(const std::string& folder, int from, int to) const {
        Flow result;
        const std::string bytes = read(folder_ / "out" / pairFile(folder, from, to, ".flo"));
        EXPECT_EQ(bytes.substr(0, 4), "PIEH");
        result.motion.resize((bytes.size() - 12) / 8);
        std::memcpy(static_cast<void*>(result.motion.data()), bytes.data() + 12, bytes.size() - 12);
        result.mask = image(pairFile(folder, from, to, "_mask.png"));
        return result;
    }

    /// The scene as it is in a frame.
    Scene sceneAt(int frame) const {
        Scene moved = scene_;
        for (const ObjectMotion& motion : motions_) {
            const Object& object = scene_.object(motion.object_id);
            for (std::uint32_t v = 0; v < object.vertex_count; ++v) {
                Eigen::Vector3f& p = moved.positions[object.first_vertex + v];
                p = (motion.by_frame[frame] * p.cast<double>()).cast<float>();
            }
        }
        return moved;
    }

    Trajectory trajectory_;
};

/// Computes the flow from ray casting, not from the rendered image.
TEST_F(TruthGl, FlowFollowsWhatRaysMeetAlsoOfMovingThings) {
    exportAll(true);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    int seen = 0;
    int occluded = 0;
    int of_moving = 0;
    for (const auto& [from, to] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}}) {
        const Flow flow = this->flow(to > from ? "flow_forward" : "flow_backward", from, to);
        const RayCaster now(sceneAt(from));
        const RayCaster then(sceneAt(to));
        const Pose& camera = trajectory_.frames[from].pose;
        const Pose& other = trajectory_.frames[to].pose;
        for (int y = 2; y < lens.height; y += 5) {
            for (int x = 1; x < lens.width; x += 5) {
                const Eigen::Vector2d at(x + 0.5, y + 0.5);
                const Eigen::Vector3d ahead = camera.rotation * lens.unproject(at.x(), at.y());
                const RayHit hit = now.cast(camera.position, ahead, 1e9, smallCamera().near_m);
                const auto mask = static_cast<PixelVisibility>(flow.mask.at<std::uint8_t>(y, x));
                const Eigen::Vector2f motion =
                    flow.motion[static_cast<std::size_t>(y) * lens.width + x];
                if (hit.object_id == 0) {
                    EXPECT_EQ(mask, PixelVisibility::Nothing);
                    continue;
                }
                Eigen::Vector3d place = camera.position + hit.distance * ahead;
                if (!motions_.empty() && hit.object_id == motions_[0].object_id) {
                    place = motions_[0].by_frame[to] * motions_[0].by_frame[from].inverse() * place;
                    ++of_moving;
                }
                const Eigen::Vector3d there = other.toCamera(place);
                const Eigen::Vector2d expected = lens.project(there) - at;
                // A ray and the rasterizer may assign a border pixel to different objects.
                if ((expected.cast<float>() - motion).norm() > 0.02F) continue;
                ++seen;
                if (mask == PixelVisibility::Outside) continue;
                // The ray starts slightly in front of the surface, so that it does not hide itself.
                const Eigen::Vector3d before = place + 0.01 * (other.position - place).normalized();
                if (mask == PixelVisibility::Occluded) {
                    ++occluded;
                    EXPECT_FALSE(then.sees(other.position, place)) << x << ", " << y;
                } else {
                    EXPECT_TRUE(then.sees(other.position, before)) << x << ", " << y;
                }
            }
        }
    }
    EXPECT_GT(seen, 0.98 * 4 * 24 * 32);
    EXPECT_GT(occluded, 20);
    EXPECT_GT(of_moving, 50);
}

TEST_F(TruthGl, SceneFlowFollowsWhatRaysMeetAlsoOfMovingObjects) {
    exportAll(true);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    const RayCaster rays(sceneAt(1));
    const Pose& camera = trajectory_.frames[1].pose;
    const Pose& other = trajectory_.frames[3].pose;
    const auto decoded = verify::decodeExr(read(folder_ / "out/scene_flow/000001_000003.exr"), 3);
    ASSERT_TRUE(decoded);
    int compared = 0;
    int moving = 0;
    for (int y = 2; y < lens.height; y += 5) {
        for (int x = 1; x < lens.width; x += 5) {
            const Eigen::Vector3d ahead = camera.rotation * lens.unproject(x + 0.5, y + 0.5);
            const RayHit hit = rays.cast(camera.position, ahead, 1e9, smallCamera().near_m);
            const Eigen::Vector3d found =
                Eigen::Map<const Eigen::Vector3f>(decoded->pixel(x, y)).cast<double>();
            if (hit.object_id == 0) {
                EXPECT_GT(found.minCoeff(), 1e9);
                continue;
            }
            const Eigen::Vector3d position = camera.position + hit.distance * ahead;
            Eigen::Vector3d then = position;
            if (hit.object_id == motions_[0].object_id) {
                then = motions_[0].by_frame[3] * motions_[0].by_frame[1].inverse() * position;
                ++moving;
            }
            const Eigen::Vector3d expected = other.toCamera(then) - camera.toCamera(position);
            // A ray and the rasterizer may assign a border pixel to different objects.
            if ((found - expected).norm() < 1e-3) ++compared;
        }
    }
    EXPECT_GT(compared, 0.98 * 24 * 32);
    EXPECT_GT(moving, 10);
}

/// Reads the values of a .npy file.
template <class Value>
std::vector<Value> valuesOf(const std::string& bytes) {
    const std::size_t begin =
        10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    std::vector<Value> values((bytes.size() - begin) / sizeof(Value));
    std::memcpy(values.data(), bytes.data() + begin, sizeof(Value) * values.size());
    return values;
}

TEST_F(TruthGl, TracksFollowPointsAlsoOfMovingObjects) {
    exportAll(true);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    const auto bytes = [&](const char* name) {
        return read(folder_ / "out" / (std::string("tracks/000000_") + name + ".npy"));
    };
    const auto points = valuesOf<float>(bytes("points"));
    const auto places = valuesOf<float>(bytes("points_3d"));
    const auto occluded = valuesOf<std::uint8_t>(bytes("occluded"));
    const auto queries = valuesOf<float>(bytes("query_points"));
    const auto ids = valuesOf<std::uint16_t>(bytes("object_ids"));
    constexpr std::size_t kFrames = 4;
    const std::size_t count = lens.width * lens.height / 30;  // the room is closed
    ASSERT_EQ(ids.size(), count);
    ASSERT_EQ(queries.size(), 3 * count);
    ASSERT_EQ(occluded.size(), kFrames * count);
    ASSERT_EQ(points.size(), 2 * kFrames * count);
    ASSERT_EQ(places.size(), 3 * kFrames * count);
    int hidden = 0;
    int outside = 0;
    int moving = 0;
    std::vector<std::unique_ptr<RayCaster>> rays_at;
    for (int t = 0; t < 4; ++t) rays_at.push_back(std::make_unique<RayCaster>(sceneAt(t)));
    for (std::size_t t = 0; t < kFrames; ++t) {
        const RayCaster& rays = *rays_at[t];
        const Pose& camera = trajectory_.frames[t].pose;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = i * kFrames + t;
            const Eigen::Vector2d point(points[2 * at], points[2 * at + 1]);
            // Where the ray of the query meets its object, moved to this frame.
            const auto chosen = static_cast<std::size_t>(queries[3 * i]);
            ASSERT_LT(chosen, kFrames);
            const Pose& then = trajectory_.frames[chosen].pose;
            const Eigen::Vector3d ahead =
                then.rotation * lens.unproject(queries[3 * i + 2], queries[3 * i + 1]);
            const RayHit hit =
                rays_at[chosen]->cast(then.position, ahead, 1e9, smallCamera().near_m);
            ASSERT_EQ(hit.object_id, ids[i]);
            Eigen::Vector3d place = then.position + hit.distance * ahead;
            if (hit.object_id == motions_[0].object_id) {
                place = motions_[0].by_frame[t] * motions_[0].by_frame[chosen].inverse() * place;
                moving += t == chosen ? 0 : 1;
            }
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(places[3 * at + axis], place[axis], 1e-4);
            }
            const Eigen::Vector3d there = camera.toCamera(place);
            if (there.z() < smallCamera().near_m) {
                EXPECT_EQ(point, Eigen::Vector2d(-1, -1));
                EXPECT_EQ(occluded[at], 1);
                continue;
            }
            EXPECT_LT((point - lens.project(there)).norm(), 1e-2);
            if (point.x() < 0 || point.y() < 0 || point.x() >= lens.width ||
                point.y() >= lens.height) {
                EXPECT_EQ(occluded[at], 1);
                ++outside;
                continue;
            }
            const Eigen::Vector3d before = place + 0.01 * (camera.position - place).normalized();
            if (occluded[at] != 0) {
                ++hidden;
                EXPECT_NE(t, chosen);
                EXPECT_FALSE(rays.sees(camera.position, place));
            } else {
                EXPECT_TRUE(rays.sees(camera.position, before));
            }
        }
    }
    EXPECT_GT(hidden, 5);
    EXPECT_GT(outside, 20);
    EXPECT_GT(moving, 5);
}

TEST_F(TruthGl, WholeMasksAreWhatRaysMeetOfAnObjectAlone) {
    exportAll(false);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    const Pose& camera = trajectory_.frames[1].pose;
    const auto amodal = nlohmann::json::parse(read(folder_ / "out/amodal/000001.json"));
    const cv::Mat instance = image("instance/000001.png");
    int hidden = 0;
    ASSERT_GE(amodal.at("objects").size(), 3U);
    for (const auto& one : amodal.at("objects")) {
        const int id = one.at("object_id").get<int>();
        const auto counts = decompressCounts(one.at("counts").get<std::string>());
        std::vector<bool> inside;  // column by column
        for (std::size_t i = 0; i < counts.size(); ++i)
            inside.insert(inside.end(), counts[i], i % 2);
        ASSERT_EQ(inside.size(), static_cast<std::size_t>(lens.width * lens.height));
        int differ = 0;
        int covered = 0;
        for (int y = 0; y < lens.height; ++y) {
            for (int x = 0; x < lens.width; ++x) {
                const bool is = inside[static_cast<std::size_t>(x) * lens.height + y];
                const bool expected = rays_.meetsObject(
                    id, camera.position, camera.rotation * lens.unproject(x + 0.5, y + 0.5));
                covered += is ? 1 : 0;
                differ += is != expected ? 1 : 0;
                hidden += is && instance.at<std::uint16_t>(y, x) != id ? 1 : 0;
                const bool shows = instance.at<std::uint16_t>(y, x) == id;
                EXPECT_TRUE(is || !shows);
            }
        }
        EXPECT_LE(differ, 2 + covered / 100) << scene_.object(id).name;
    }
    EXPECT_GT(hidden, 10);
}

TEST_F(TruthGl, InstancesSayWhatThePixelsDo) {
    exportAll(false);
    std::istringstream rows(read(folder_ / "out/instances.csv"));
    std::string line;
    std::getline(rows, line);
    int count = 0;
    while (std::getline(rows, line)) {
        std::vector<double> values;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
        ASSERT_EQ(values.size(), 28U);
        const cv::Mat instance = image(frameFile("instance", static_cast<int>(values[0])));
        const cv::Mat mask = instance == static_cast<int>(values[1]);
        const cv::Rect box = cv::boundingRect(mask);
        EXPECT_EQ(cv::countNonZero(mask), static_cast<int>(values[3]));
        EXPECT_EQ(box, cv::Rect(static_cast<int>(values[10]), static_cast<int>(values[11]),
                                static_cast<int>(values[12]), static_cast<int>(values[13])));
        EXPECT_GE(values[4], values[3]);
        EXPECT_GE(values[5], values[4]);
        EXPECT_NEAR(values[6], values[3] / values[5], 1e-5);
        EXPECT_NEAR(values[7], 1.0 - values[4] / values[5], 1e-5);
        ++count;
    }
    EXPECT_GE(count, 12);
}

TEST_F(TruthGl, ThePairOfCamerasSeesWhatDisparitySays) {
    exportAll(false);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    const cv::Mat disparity = image("disparity/000002.png");
    const cv::Mat mask = image("disparity/000002_mask.png");
    const cv::Mat depth = image("depth/000002.png");
    const cv::Mat right = image("depth_right/000002.png");
    int agree = 0;
    int seen = 0;
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            const double d = disparity.at<std::uint16_t>(y, x) / 256.0;
            const double z = depth.at<std::uint16_t>(y, x) / 1000.0;
            EXPECT_NEAR(d, lens.fx * 0.1 / z, 0.005 + 0.001 * d);
            if (mask.at<std::uint8_t>(y, x) != 0) continue;
            ++seen;
            const int there = static_cast<int>(std::floor(x + 0.5 - d));
            for (const int beside : {there - 1, there, there + 1}) {
                if (beside < 0 || beside >= lens.width) continue;
                if (std::abs(right.at<std::uint16_t>(y, beside) / 1000.0 - z) > 0.05) continue;
                ++agree;
                break;
            }
        }
    }
    EXPECT_GT(seen, 10000);
    EXPECT_GT(agree, 0.995 * seen);
}

// A box with smoothed normals: near its outline they point away from the camera.
TEST_F(TruthGl, NormalsAreOnTheSideThatIsSeenAlsoWhereFacesAreSmoothed) {
    for (const Object& object : scene_.objects) {
        if (object.structure) continue;
        for (std::uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count;
             ++v) {
            const Eigen::Vector3d out = scene_.positions[v].cast<double>() - object.box.center;
            scene_.normals[v] = out.normalized().cast<float>();
        }
    }
    exportAll(false);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    int past_outline = 0;
    int wrong = 0;
    for (int frame = 0; frame < 4; ++frame) {
        const cv::Mat normals = image(frameFile("normal_world", frame));
        const cv::Mat instance = image(frameFile("instance", frame));
        const Pose& camera = trajectory_.frames[frame].pose;
        for (int y = 0; y < lens.height; ++y) {
            for (int x = 0; x < lens.width; ++x) {
                const Eigen::Vector3d ahead =
                    (camera.rotation * lens.unproject(x + 0.5, y + 0.5)).normalized();
                const RayHit hit = rays_.cast(camera.position, ahead, 1e9, smallCamera().near_m);
                ASSERT_NE(hit.object_id, 0);
                const Object& object = scene_.object(hit.object_id);
                if (object.structure || instance.at<std::uint16_t>(y, x) != object.id) continue;
                const auto& [a, b, c] = scene_.triangles[hit.triangle];
                Eigen::Vector3d face = (scene_.positions[b] - scene_.positions[a])
                                           .cross(scene_.positions[c] - scene_.positions[a])
                                           .cast<double>()
                                           .normalized();
                if (face.dot(ahead) > 0.0) face = -face;
                Eigen::Vector3d out =
                    (camera.position + hit.distance * ahead - object.box.center).normalized();
                if (out.dot(face) < 0.0) out = -out;
                const auto bgr = normals.at<cv::Vec3w>(y, x);
                const Eigen::Vector3d found =
                    Eigen::Vector3d(bgr[2], bgr[1], bgr[0]) * (2.0 / 65535.0) -
                    Eigen::Vector3d::Ones();
                past_outline += out.dot(ahead) > 0.05 ? 1 : 0;
                if (found.dot(ahead) > 1e-3 || found.dot(face) < -1e-3) ++wrong;
            }
        }
    }
    EXPECT_GT(past_outline, 50);
    EXPECT_LE(wrong, 5);
}

TEST_F(TruthGl, AContinuedExportOfEverythingEndsWithTheBytesOfAnUnbrokenOne) {
    exportAll(true);
    const auto expected = tree(folder_ / "out");
    DatasetSettings settings;
    settings.folder = folder_ / "continued";
    settings.modalities = {"all"};
    settings.formats = {"all"};
    settings.flow_distances = {1, 2};
    settings.resume = true;
    DatasetOrigin origin;
    origin.motions = motions_;
    const auto run = [&](const DatasetSettings& wanted, const JobContext& job) {
        auto context = gl::createOsMesaContext();
        EXPECT_TRUE(context);
        return exportDataset(std::move(*context), scene_, rays_, trajectory_, smallCamera(), wanted,
                             origin, job);
    };
    for (const int frames : {1, 3}) {
        auto cancel = std::make_shared<std::atomic<bool>>(false);
        const JobContext job(cancel, {}, [&](int done, int) { *cancel = done >= frames; });
        EXPECT_FALSE(run(settings, job));
    }
    // The same images but different flow: not the same dataset.
    DatasetSettings others = settings;
    others.flow_distances = {1};
    const auto refused = run(others, {});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("optical flow"), std::string::npos);
    fs::remove(folder_ / "continued/flow_forward/000000_000002_mask.png");
    ASSERT_TRUE(run(settings, {}));
    EXPECT_TRUE(tree(folder_ / "continued") == expected);
}

}  // namespace
}  // namespace dollytrack::render::truth_gl_test
