// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdf5File.H"
#include "hdf5Support.H"
#include "wideColumns.H"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace ispf
{

namespace
{

size_t sizeOfFile(const word& path)
{
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) throw fatalError("Cannot read '" + path + "': " + error.message() + ".");
    return size;
}

hdf5Id openFile(const word& path)
{
    // HDF5 does not distinguish a file without permission from one that is damaged
    if (const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC); file < 0)
        throw fatalError("Cannot read '" + path + "': " + std::strerror(errno) + ".");
    else ::close(file);
    silenceHdf5();
    const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id < 0)
        throw fatalError("Cannot read '" + path + "': not an HDF5 file, or truncated (" +
                         hdf5Reason() + ").");
    return hdf5Id(id, H5Fclose);
}

}  // namespace

hdf5Reader::hdf5Reader(const word& path)
    : path_(path), fileSize_(sizeOfFile(path)), file_(openFile(path))
{
}

void hdf5Reader::fail(const word& reason) const
{
    throw fatalError("Cannot read '" + path_ + "': " + reason + ".");
}

hdf5Id hdf5Reader::checked(hid_t id, hdf5Id::closer close, const word& what) const
{
    if (id < 0) fail("'" + what + "' is missing or damaged (" + hdf5Reason() + ")");
    return hdf5Id(id, close);
}

bool hdf5Reader::found(const word& path) const
{
    for (size_t end = path.find('/', 1);; end = path.find('/', end + 1))
    {
        const word part = path.substr(0, end);
        if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
        if (end == word::npos) return H5Oexists_by_name(file_, path.c_str(), H5P_DEFAULT) > 0;
    }
}

List<word> hdf5Reader::children(const word& group) const
{
    const hdf5Id id = checked(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose, group);
    List<word> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
        static_cast<List<word>*>(list)->push_back(name);
        return 0;
    };
    if (H5Literate(id, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names) < 0)
        fail("the list of '" + group + "' is damaged (" + hdf5Reason() + ")");
    std::sort(names.begin(), names.end());
    return names;
}

bool hdf5Reader::foundAttribute(const word& object, const word& name) const
{
    return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

List<word> hdf5Reader::attributes(const word& object) const
{
    List<word> names;
    const auto add = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
        static_cast<List<word>*>(list)->push_back(name);
        return 0;
    };
    if (H5Aiterate_by_name(file_, object.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add,
                           &names, H5P_DEFAULT) < 0)
        fail("the attributes of '" + object + "' are damaged (" + hdf5Reason() + ")");
    std::sort(names.begin(), names.end());
    return names;
}

size_t hdf5Reader::width(const word& path) const
{
    const hdf5Id set = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const hdf5Id space = checked(H5Dget_space(set), H5Sclose, path);
    hsize_t shape[2] = {0, 0};
    if (H5Sget_simple_extent_ndims(space) == 2) H5Sget_simple_extent_dims(space, shape, nullptr);
    if (shape[1] == 0 || shape[1] > mostComponents) fail("'" + path + "' has another shape");
    return shape[1];
}

bool hdf5Reader::exceedsIntegers(const word& path) const
{
    const bool wide = kindOf(path) == kind::wideIntegers;
    const hdf5Id set = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const hdf5Id type = checked(H5Dget_type(set), H5Tclose, path);
    if (H5Tget_size(type) > sizeof(globalId)) return true;
    if (H5Tget_sign(type) != H5T_SGN_NONE || H5Tget_size(type) < sizeof(globalId)) return false;
    List<std::uint64_t> values;
    const size_t n = wide ? width(path) : 1;
    readData(path, kindOf(path), n * sizeof(globalId), H5T_NATIVE_UINT64,
             [&](size_t rows) { return values.resize(rows * n), values.data(); });
    return std::any_of(values.begin(), values.end(), [](std::uint64_t v) { return v >> 63; });
}

hdf5Reader::kind hdf5Reader::kindOf(const word& path) const
{
    if (!found(path)) fail("'" + path + "' is missing");
    H5O_info_t object;
    if (H5Oget_info_by_name(file_, path.c_str(), &object, H5P_DEFAULT) < 0 ||
        object.type != H5O_TYPE_DATASET)
        return kind::other;
    const hdf5Id set = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const hdf5Id type = checked(H5Dget_type(set), H5Tclose, path);
    const hdf5Id space = checked(H5Dget_space(set), H5Sclose, path);
    const int rank = H5Sget_simple_extent_ndims(space);
    hsize_t shape[2] = {0, 0};
    if (rank > 2) return kind::other;
    H5Sget_simple_extent_dims(space, shape, nullptr);
    const bool isWide = rank == 2 && shape[1] > 0 && shape[1] <= mostComponents;
    switch (H5Tget_class(type))
    {
        case H5T_FLOAT:
            return rank == 1                    ? kind::scalars
                   : rank == 2 && shape[1] == 3 ? kind::vectors
                   : isWide                     ? kind::wideScalars
                                                : kind::other;
        case H5T_INTEGER:
            return rank == 1 ? kind::integers : isWide ? kind::wideIntegers : kind::other;
        case H5T_STRING:
            return rank == 0 ? kind::text : kind::other;
        default:
            return kind::other;
    }
}

void hdf5Reader::readData(const word& path, kind asked, size_t rowBytes, hid_t type,
                          const std::function<void*(size_t)>& resize) const
{
    if (kindOf(path) != asked) fail("'" + path + "' has another type or shape than expected");
    const hdf5Id set = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const hdf5Id space = checked(H5Dget_space(set), H5Sclose, path);
    hsize_t shape[2] = {0, 0};
    H5Sget_simple_extent_dims(space, shape, nullptr);
    // a damaged length must not ask for all the memory of the machine
    if (shape[0] > fileSize_ / rowBytes + 1) fail("'" + path + "' is longer than the file");
    void* data = resize(shape[0]);
    if (shape[0] > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
        fail("'" + path + "' is truncated or damaged (" + hdf5Reason() + ")");
}

void hdf5Reader::read(const word& path, List<scalar>& values) const
{
    readData(path, kind::scalars, sizeof(scalar), H5T_NATIVE_DOUBLE,
             [&](size_t n) { return values.resize(n), values.data(); });
}

void hdf5Reader::read(const word& path, List<vector>& values) const
{
    readData(path, kind::vectors, sizeof(vector), H5T_NATIVE_DOUBLE,
             [&](size_t n) { return values.resize(n), values.data(); });
}

void hdf5Reader::read(const word& path, List<globalId>& values) const
{
    readData(path, kind::integers, sizeof(globalId), H5T_NATIVE_INT64,
             [&](size_t n) { return values.resize(n), values.data(); });
}

void hdf5Reader::readWide(const word& path, List<scalar>& values) const
{
    const size_t n = width(path);
    readData(path, kind::wideScalars, n * sizeof(scalar), H5T_NATIVE_DOUBLE,
             [&](size_t rows) { return values.resize(rows * n), values.data(); });
}

void hdf5Reader::readWide(const word& path, List<globalId>& values) const
{
    const size_t n = width(path);
    readData(path, kind::wideIntegers, n * sizeof(globalId), H5T_NATIVE_INT64,
             [&](size_t rows) { return values.resize(rows * n), values.data(); });
}

void hdf5Reader::read(const word& path, word& text) const
{
    if (kindOf(path) != kind::text) fail("'" + path + "' is not a text");
    const hdf5Id set = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const hdf5Id type = checked(H5Dget_type(set), H5Tclose, path);
    if (H5Tis_variable_str(type) > 0)
    {
        char* chars = nullptr;
        if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &chars) < 0)
            fail("'" + path + "' is truncated or damaged (" + hdf5Reason() + ")");
        text = chars ? chars : "";
        H5free_memory(chars);
        return;
    }
    const size_t size = H5Tget_size(type);
    if (size > fileSize_) fail("'" + path + "' is longer than the file");
    text.assign(size, '\0');
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
        fail("'" + path + "' is truncated or damaged (" + hdf5Reason() + ")");
    text.resize(std::min(size, text.find('\0')));
}

void hdf5Reader::attribute(const word& object, const word& name, List<globalId>& values) const
{
    const word what = object + "@" + name;
    const hdf5Id id =
        checked(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose, what);
    const hdf5Id type = checked(H5Aget_type(id), H5Tclose, what);
    const hdf5Id space = checked(H5Aget_space(id), H5Sclose, what);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    if (H5Tget_class(type) != H5T_INTEGER || n < 0 || size_t(n) > fileSize_)
        fail("attribute '" + what + "' is not a whole number");
    values.resize(size_t(n));
    if (n > 0 && H5Aread(id, H5T_NATIVE_INT64, values.data()) < 0)
        fail("attribute '" + what + "' is damaged (" + hdf5Reason() + ")");
}

}  // namespace ispf
