#include "engine/io/hdf5/hdf5_reader.h"

#include "engine/io/files/input_file.h"
#include "engine/io/hdf5/hdf5_functions.h"
#include "engine/io/hdf5/hdf5_library.h"

#include <algorithm>
#include <memory>

namespace dollytrack {
namespace {

constexpr unsigned kReadOnly = 0;  // H5F_ACC_RDONLY; the macro itself calls the library
constexpr std::uint64_t kMostHdf5Bytes = std::uint64_t{512} << 20U;

/// Opens a file image in memory, so that the library does not open files.
hid_t openBytes(const Hdf5Functions& h5, const std::filesystem::path& path) {
    h5.H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are reported here
    h5.H5PLset_loading_state(0);                     // a file could name plugins to load
    Result<std::string> bytes = readNamedFile(path, kMostHdf5Bytes);
    if (!bytes) return -1;
    const Hdf5Handle access(h5.H5Pcreate(h5.file_access), h5.H5Pclose);
    constexpr std::size_t kGrowth = 65536;
    if (access < 0 || h5.H5Pset_fapl_core(access, kGrowth, 0) < 0 ||
        h5.H5Pset_file_image(access, bytes->data(), bytes->size()) < 0) {
        return -1;
    }
    return h5.H5Fopen("numbers.hdf5", kReadOnly, access);
}

/// Whether a dataset is in this file: it can be a link to another file, or have its data there.
bool liesInFile(const Hdf5Functions& h5, hid_t file, hid_t dataset, const std::string& name) {
    H5L_info_t link;
    if (h5.H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) {
        return false;
    }
    const Hdf5Handle made(h5.H5Dget_create_plist(dataset), h5.H5Pclose);
    return made >= 0 && h5.H5Pget_external_count(made) == 0 &&
           h5.H5Pget_layout(made) != H5D_VIRTUAL;
}

/// A file and one of its datasets, open during the lifetime of this object.
struct OpenDataset {
    const Hdf5Functions& h5;
    Hdf5Lock lock;
    Hdf5Handle file;
    Hdf5Handle id;

    OpenDataset(const Hdf5Functions& functions, const std::filesystem::path& path,
                const std::string& name)
        : h5(functions),
          file(openBytes(h5, path), h5.H5Fclose),
          id(file >= 0 ? h5.H5Dopen2(file, name.c_str(), H5P_DEFAULT) : -1, h5.H5Dclose) {}
};

Result<std::unique_ptr<const OpenDataset>> openDataset(const std::filesystem::path& path,
                                                       const std::string& name) {
    const Hdf5Functions* library = hdf5Functions();
    if (library == nullptr) {
        return fail(ErrorCode::Failed, missingHdf5(), path.string());
    }
    auto dataset = std::make_unique<const OpenDataset>(*library, path, name);
    const auto refused = [&](const std::string& why) {
        return fail(ErrorCode::BadInput, why, path.string());
    };
    if (dataset->file < 0) return refused("The file is missing or is not an HDF5 file.");
    if (dataset->id < 0) return refused("There is no dataset named \"" + name + "\" in it.");
    if (!liesInFile(*library, dataset->file, dataset->id, name)) {
        return refused("The dataset \"" + name + "\" is a link to another file.");
    }
    return dataset;
}

}  // namespace

const char* missingHdf5() {
    return hdf5Functions() != nullptr ? nullptr
                                      : "the HDF5 library is missing (" DOLLYTRACK_HDF5_LIBRARY
                                        "); on Debian, install libhdf5-103-1";
}

Result<Hdf5Numbers> readHdf5Numbers(const std::filesystem::path& path, const std::string& name,
                                    std::uint64_t most) {
    const auto opened = openDataset(path, name);
    if (!opened) return tl::unexpected(opened.error());
    const OpenDataset& dataset = **opened;
    const Hdf5Functions& h5 = dataset.h5;
    const Hdf5Handle space(h5.H5Dget_space(dataset.id), h5.H5Sclose);
    const int rank = space >= 0 ? h5.H5Sget_simple_extent_ndims(space) : -1;
    if (rank < 1 || rank > 3) {
        return fail(
            ErrorCode::BadInput,
            "The HDF5 dataset is not a table of numbers; download or export the file again.",
            path.string());
    }
    std::vector<hsize_t> size;
    Hdf5Numbers numbers;
    size.resize(rank);
    h5.H5Sget_simple_extent_dims(space, size.data(), nullptr);
    hsize_t count = 1;
    for (const hsize_t length : size) {
        // Checked by division, because the product of declared sizes may overflow.
        if (length != 0 && count > most / length) {
            return fail(ErrorCode::BadInput, "Its dataset is larger than supported.",
                        path.string());
        }
        count *= length;
    }
    numbers.size.assign(size.begin(), size.end());
    numbers.values.resize(count);
    if (count > 0 && h5.H5Dread(dataset.id, h5.native_double, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                numbers.values.data()) < 0) {
        return fail(ErrorCode::BadInput, "Its dataset cannot be read as numbers.", path.string());
    }
    return numbers;
}

Result<std::string> readHdf5Text(const std::filesystem::path& path, const std::string& name) {
    constexpr std::size_t kMost = std::size_t{16} << 20U;
    const auto opened = openDataset(path, name);
    if (!opened) return tl::unexpected(opened.error());
    const OpenDataset& dataset = **opened;
    const Hdf5Functions& h5 = dataset.h5;
    const Hdf5Handle type(h5.H5Dget_type(dataset.id), h5.H5Tclose);
    const Hdf5Handle space(h5.H5Dget_space(dataset.id), h5.H5Sclose);
    const bool text = type >= 0 && h5.H5Tget_class(type) == H5T_STRING &&
                      h5.H5Tis_variable_str(type) == 0 &&
                      h5.H5Sget_simple_extent_npoints(space) == 1;
    const std::size_t length = text ? h5.H5Tget_size(type) : 0;
    if (length == 0 || length > kMost) {
        return fail(ErrorCode::BadInput, "\"" + name + "\" is not a text of at most 16 MiB.",
                    path.string());
    }
    std::string read(length, '\0');
    if (h5.H5Dread(dataset.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()) < 0) {
        return fail(ErrorCode::BadInput, "\"" + name + "\" cannot be read.", path.string());
    }
    read.resize(std::min(read.find('\0'), read.size()));
    return read;
}

}  // namespace dollytrack
