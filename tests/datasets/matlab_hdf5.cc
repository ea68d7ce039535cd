// The same objects in a MAT-file of version 7.3.

#include <hdf5.h>

#include <fstream>

#include "tests/datasets/matlab_bytes.h"
#include "tests/datasets/matlab_objects.h"

namespace hoplab::testing {
namespace {

class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& file) {
    const hid_t create = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(create, 512);
    file_ = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, create, H5P_DEFAULT);
    H5Pclose(create);
    H5Gclose(H5Gcreate2(file_, "#refs#", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Gclose(H5Gcreate2(file_, "#subsystem#", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer() { H5Fclose(file_); }

  void Write(const std::string& path, const MatlabValue& value) {
    const KindOfBytes kind = BytesOf(value.kind);
    if (value.kind == Kind::kStruct) {
      const hid_t group = H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      Say(group, "MATLAB_class", "struct");
      H5Gclose(group);
      for (std::size_t i = 0; i < value.fields.size(); ++i)
        Write(path + "/" + value.fields[i], value.cells[i]);
      return;
    }
    std::size_t count = 1;
    for (const std::size_t n : value.size) count *= n;
    if (count == 0) return WriteEmpty(path, value.size, kind.name);
    if (value.kind == Kind::kCell) return WriteCells(path, value.cells, value.size, "cell");
    if (!value.imaginary.empty()) return WriteComplex(path, value);
    std::string bytes;
    if (value.kind == Kind::kChar) {
      for (const char letter : value.text)
        Put(static_cast<std::uint16_t>(static_cast<unsigned char>(letter)), false, &bytes);
    } else {
      for (const double number : value.real) PutNumber(number, kind.type, false, &bytes);
    }
    const hid_t dataset = Make(path, Stored(kind.type), value.size);
    H5Dwrite(dataset, Stored(kind.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    Say(dataset, "MATLAB_class", value.class_name.empty() ? kind.name : value.class_name);
    if (!value.class_name.empty()) Say(dataset, "MATLAB_object_decode", 3);
    H5Dclose(dataset);
  }

  void WriteCells(const std::string& path, const std::vector<MatlabValue>& cells,
                  const std::vector<std::size_t>& size, const std::string& klass) {
    std::vector<hobj_ref_t> references(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string name = "/#refs#/r" + std::to_string(++made_);
      Write(name, cells[i]);
      H5Rcreate(&references[i], file_, name.c_str(), H5R_OBJECT, -1);
    }
    const hid_t dataset = Make(path, H5T_STD_REF_OBJ, size);
    H5Dwrite(dataset, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data());
    Say(dataset, "MATLAB_class", klass);
    if (klass == "FileWrapper__") Say(dataset, "MATLAB_object_decode", 3);
    H5Dclose(dataset);
  }

 private:
  static hid_t Stored(std::uint32_t type) {
    switch (type) {
      case 2:
        return H5T_STD_U8LE;
      case 4:
        return H5T_STD_U16LE;
      case 5:
        return H5T_STD_I32LE;
      case 6:
        return H5T_STD_U32LE;
      case 7:
        return H5T_IEEE_F32LE;
      default:
        return H5T_IEEE_F64LE;
    }
  }

  hid_t Make(const std::string& path, hid_t type, const std::vector<std::size_t>& size) {
    const std::vector<hsize_t> extent(size.rbegin(), size.rend());
    const hid_t space = H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
    const hid_t dataset =
        H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Sclose(space);
    return dataset;
  }

  void WriteEmpty(const std::string& path, const std::vector<std::size_t>& size,
                  const char* klass) {
    const hid_t dataset = Make(path, H5T_STD_U64LE, {size.size()});
    const std::vector<std::uint64_t> numbers(size.begin(), size.end());
    H5Dwrite(dataset, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    Say(dataset, "MATLAB_class", klass);
    Say(dataset, "MATLAB_empty", 1);
    H5Dclose(dataset);
  }

  void WriteComplex(const std::string& path, const MatlabValue& value) {
    const hid_t type = H5Tcreate(H5T_COMPOUND, 2 * sizeof(double));
    H5Tinsert(type, "real", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "imag", sizeof(double), H5T_NATIVE_DOUBLE);
    std::vector<double> pairs;
    for (std::size_t i = 0; i < value.real.size(); ++i)
      pairs.insert(pairs.end(), {value.real[i], value.imaginary[i]});
    const hid_t dataset = Make(path, type, value.size);
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pairs.data());
    Say(dataset, "MATLAB_class", "double");
    H5Dclose(dataset);
    H5Tclose(type);
  }

  static void Say(hid_t object, const char* name, const std::string& text) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, text.size());
    Attach(object, name, type, text.data());
    H5Tclose(type);
  }
  static void Say(hid_t object, const char* name, int number) {
    Attach(object, name, H5T_NATIVE_INT, &number);
  }
  static void Attach(hid_t object, const char* name, hid_t type, const void* data) {
    const hid_t scalar = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(object, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, data);
    H5Aclose(attribute);
    H5Sclose(scalar);
  }

  hid_t file_ = -1;
  int made_ = 0;
};

}  // namespace

void WriteMat73(const std::filesystem::path& file, const MatlabVariables& variables,
                const MatlabObjects& objects) {
  {
    Hdf5Writer writer(file);
    const std::vector<MatlabValue> cells = objects.Cells(false);
    writer.WriteCells("/#subsystem#/MCOS", cells, {1, cells.size()}, "FileWrapper__");
    for (const auto& [name, value] : variables) writer.Write("/" + name, value);
  }
  std::string header = "MATLAB 7.3 MAT-file, written by a test";
  header.resize(116, ' ');
  header.append(8, '\0');
  header += std::string("\0\2IM", 4);
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.write(header.data(), static_cast<std::streamsize>(header.size()));
}

}  // namespace hoplab::testing
