#include "engine/io/trajectories/number_lines.h"
#include "engine/io/trajectories/pose_list.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>

namespace dollytrack::io {
namespace {

constexpr const char* kPositions = "camera_keyframe_positions.hdf5";
constexpr const char* kOrientations = "camera_keyframe_orientations.hdf5";

/// Closes what HDF5 opened.
class Handle {
  public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    [[nodiscard]] hid_t get() const { return id_; }
    [[nodiscard]] bool ok() const { return id_ >= 0; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

struct Numbers {
    std::vector<hsize_t> size;
    std::vector<double> values;
};

/// The file's only dataset, "dataset", with whatever type of number.
Result<Numbers> readDataset(const std::filesystem::path& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // we say it ourselves
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file.ok()) {
        return fail(ErrorCode::BadInput, "The file is missing or is no HDF5 file.", path.string());
    }
    const Handle dataset(H5Dopen2(file.get(), "dataset", H5P_DEFAULT), H5Dclose);
    if (!dataset.ok()) {
        return fail(ErrorCode::BadInput, "There is no dataset named \"dataset\" in it.",
                    path.string());
    }
    const Handle space(H5Dget_space(dataset.get()), H5Sclose);
    const int rank = space.ok() ? H5Sget_simple_extent_ndims(space.get()) : -1;
    if (rank < 1 || rank > 3) {
        return fail(ErrorCode::BadInput, "Its dataset is not a table of numbers.", path.string());
    }
    Numbers numbers;
    numbers.size.resize(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), numbers.size.data(), nullptr);
    hsize_t count = 1;
    constexpr hsize_t kMost = 100'000'000;
    for (const hsize_t length : numbers.size) {
        // By division: the product of what a file claims may wrap around to a small number.
        if (length != 0 && count > kMost / length) {
            return fail(ErrorCode::BadInput, "Its dataset is too large for a list of poses.",
                        path.string());
        }
        count *= length;
    }
    numbers.values.resize(count);
    if (count > 0 && H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                             numbers.values.data()) < 0) {
        return fail(ErrorCode::BadInput, "Its dataset cannot be read as numbers.", path.string());
    }
    return numbers;
}

}  // namespace

// Hypersim: positions and orientations of a camera's key frames in two files of one folder, in the
// units of the scene file; x right, y up, z back; one frame a second.
Result<PoseList> readHypersim(const PoseFile& file) {
    std::error_code error;
    const std::filesystem::path folder =
        std::filesystem::is_directory(file.path, error) ? file.path : file.path.parent_path();
    const Result<Numbers> positions = readDataset(folder / kPositions);
    if (!positions) return tl::unexpected<Error>(positions.error());
    const Result<Numbers> orientations = readDataset(folder / kOrientations);
    if (!orientations) return tl::unexpected<Error>(orientations.error());
    const hsize_t count = positions->size[0];
    if (positions->size != std::vector<hsize_t>{count, 3} || count == 0) {
        return fail(ErrorCode::BadInput, "Positions must be a table of N x 3 numbers.",
                    (folder / kPositions).string());
    }
    if (orientations->size != std::vector<hsize_t>{count, 3, 3}) {
        return fail(ErrorCode::BadInput,
                    fmt::format("Orientations must be a table of {} x 3 x 3 numbers.", count),
                    (folder / kOrientations).string());
    }
    PoseList list;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string where = fmt::format("{}: row {}", (folder / kOrientations).string(), i);
        const Eigen::Matrix3d matrix =
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
                &orientations->values[9 * i]);
        auto rotation = rotationFrom(matrix, where);
        if (!rotation) return tl::unexpected<Error>(std::move(rotation.error()));
        rotation->rightCols<2>() *= -1.0;
        list.poses.push_back({Eigen::Map<const Eigen::Vector3d>(&positions->values[3 * i]),
                              *rotation, static_cast<double>(i)});
    }
    return list;
}

}  // namespace dollytrack::io
