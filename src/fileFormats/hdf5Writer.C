// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdf5File.H"
#include "hdf5Support.H"

#include <algorithm>

namespace ispf
{

namespace
{

[[noreturn]] void fail(const word& what)
{
    throw fatalError("HDF5 cannot compose " + what + " in memory: " + hdf5Reason());
}

hdf5Id checked(hid_t id, hdf5Id::closer close, const word& what)
{
    if (id < 0) fail(what);
    return hdf5Id(id, close);
}

hdf5Id createInMemory()
{
    silenceHdf5();
    constexpr size_t growBy = size_t(1) << 18;
    const hdf5Id access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "a file");
    if (H5Pset_fapl_core(access, growBy, false) < 0) fail("a file");
    // the name is never used on disk, but HDF5 refuses to open the same name twice
    static int serial = 0;
    const word name = "ispf-in-memory-" + std::to_string(serial++);
    return checked(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "a file");
}

// A string of fixed length without a closing NUL: ParaView refuses strings of variable length, and
// reads a closing NUL as a part of the text
hdf5Id stringType(const word& text)
{
    hdf5Id type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "a text");
    if (H5Tset_size(type, std::max<size_t>(1, text.size())) < 0 ||
        H5Tset_strpad(type, H5T_STR_NULLPAD) < 0)
        fail("a text");
    return type;
}

}  // namespace

hdf5Writer::hdf5Writer() : file_(createInMemory()) {}

void hdf5Writer::group(const word& path)
{
    const hdf5Id linkList = checked(H5Pcreate(H5P_LINK_CREATE), H5Pclose, path);
    H5Pset_create_intermediate_group(linkList, 1);
    checked(H5Gcreate2(file_, path.c_str(), linkList, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
}

void hdf5Writer::writeData(const word& path, hid_t type, const List<hsize_t>& shape,
                           const void* data)
{
    const hdf5Id linkList = checked(H5Pcreate(H5P_LINK_CREATE), H5Pclose, path);
    H5Pset_create_intermediate_group(linkList, 1);
    // no time stamps: equal contents give equal bytes
    const hdf5Id creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path);
    H5Pset_obj_track_times(creation, false);

    const hdf5Id space =
        checked(shape.empty() ? H5Screate(H5S_SCALAR)
                              : H5Screate_simple(int(shape.size()), shape.data(), nullptr),
                H5Sclose, path);
    const hdf5Id set =
        checked(H5Dcreate2(file_, path.c_str(), type, space, linkList, creation, H5P_DEFAULT),
                H5Dclose, path);
    const bool empty = !shape.empty() && shape[0] == 0;
    if (!empty && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(path);
}

void hdf5Writer::write(const word& path, const List<scalar>& values)
{
    writeData(path, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

void hdf5Writer::write(const word& path, const List<vector>& values)
{
    static_assert(sizeof(vector) == 3 * sizeof(scalar));
    writeData(path, H5T_NATIVE_DOUBLE, {values.size(), 3}, values.data());
}

void hdf5Writer::write(const word& path, const List<globalId>& values)
{
    writeData(path, H5T_NATIVE_INT64, {values.size()}, values.data());
}

void hdf5Writer::write(const word& path, const List<scalar>& values, size_t width)
{
    writeData(path, H5T_NATIVE_DOUBLE, {values.size() / width, width}, values.data());
}

void hdf5Writer::write(const word& path, const List<globalId>& values, size_t width)
{
    writeData(path, H5T_NATIVE_INT64, {values.size() / width, width}, values.data());
}

void hdf5Writer::write(const word& path, const List<std::uint8_t>& values)
{
    writeData(path, H5T_NATIVE_UINT8, {values.size()}, values.data());
}

void hdf5Writer::write(const word& path, const word& text)
{
    writeData(path, stringType(text), {}, text.c_str());
}

void hdf5Writer::writeAttribute(const word& object, const word& name, hid_t type, hid_t space,
                                const void* data)
{
    const word what = object + "@" + name;
    const hdf5Id owner = checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose, what);
    const hdf5Id attribute = checked(
        H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
    if (H5Awrite(attribute, type, data) < 0) fail(what);
}

void hdf5Writer::attribute(const word& object, const word& name, const List<globalId>& values)
{
    const hsize_t n = values.size();
    const hdf5Id space = checked(H5Screate_simple(1, &n, nullptr), H5Sclose, name);
    writeAttribute(object, name, H5T_NATIVE_INT64, space, values.data());
}

void hdf5Writer::attribute(const word& object, const word& name, const word& text)
{
    const hdf5Id space = checked(H5Screate(H5S_SCALAR), H5Sclose, name);
    writeAttribute(object, name, stringType(text), space, text.c_str());
}

word hdf5Writer::bytes()
{
    if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail("a file");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    if (size < 0) fail("a file");
    word image(size_t(size), '\0');
    if (H5Fget_file_image(file_, image.data(), image.size()) < 0) fail("a file");
    return image;
}

}  // namespace ispf
