#include "engine/io/hdf5_reader.h"

#include <hdf5.h>

namespace dollytrack::io {
namespace {

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

}  // namespace

Result<Hdf5Numbers> readHdf5Numbers(const std::filesystem::path& path) {
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
    std::vector<hsize_t> size;
    Hdf5Numbers numbers;
    size.resize(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
    hsize_t count = 1;
    constexpr hsize_t kMost = 10'000'000;
    for (const hsize_t length : size) {
        // By division: the product of what a file claims may wrap around to a small number.
        if (length != 0 && count > kMost / length) {
            return fail(ErrorCode::BadInput, "Its dataset is larger than any that belongs here.",
                        path.string());
        }
        count *= length;
    }
    numbers.size.assign(size.begin(), size.end());
    numbers.values.resize(count);
    if (count > 0 && H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                             numbers.values.data()) < 0) {
        return fail(ErrorCode::BadInput, "Its dataset cannot be read as numbers.", path.string());
    }
    return numbers;
}

}  // namespace dollytrack::io
