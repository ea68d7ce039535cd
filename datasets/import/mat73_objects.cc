// MAT-files of version 7.3 are HDF5. A variable is a dataset with its dimensions the other way
// round and attributes that say what it is: MATLAB_class, MATLAB_empty, MATLAB_object_decode = 3
// for what refers to an object. A struct is a group, a cell array a dataset of references into
// /#refs#, the objects' cells are /#subsystem#/MCOS.

#include <hdf5.h>

#include <algorithm>
#include <array>

#include "base/input_error.h"
#include "datasets/import/hdf5_handle.h"
#include "datasets/import/limits.h"
#include "datasets/import/mat_objects.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostStored = 1ull << 27;
constexpr std::array<const char*, 10> kClasses = {"double", "single", "int8",   "uint8", "int16",
                                                  "uint16", "int32",  "uint32", "int64", "uint64"};

hid_t NativeType(double) { return H5T_NATIVE_DOUBLE; }
hid_t NativeType(float) { return H5T_NATIVE_FLOAT; }
hid_t NativeType(std::int8_t) { return H5T_NATIVE_INT8; }
hid_t NativeType(std::uint8_t) { return H5T_NATIVE_UINT8; }
hid_t NativeType(std::int16_t) { return H5T_NATIVE_INT16; }
hid_t NativeType(std::uint16_t) { return H5T_NATIVE_UINT16; }
hid_t NativeType(std::int32_t) { return H5T_NATIVE_INT32; }
hid_t NativeType(std::uint32_t) { return H5T_NATIVE_UINT32; }
hid_t NativeType(std::int64_t) { return H5T_NATIVE_INT64; }
hid_t NativeType(std::uint64_t) { return H5T_NATIVE_UINT64; }

bool HasNumber(hid_t object, const char* name, int number) {
  if (H5Aexists(object, name) <= 0) return false;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  int value = 0;
  return H5Sget_simple_extent_npoints(space.get()) == 1 &&
         H5Aread(attribute.get(), H5T_NATIVE_INT, &value) >= 0 && value == number;
}

std::vector<std::string> LinksOf(hid_t group) {
  std::vector<std::string> names;
  const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names);
  return names;
}

class Mat73Reader {
 public:
  explicit Mat73Reader(const std::string& file)
      : file_(file), h5_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    subsystem_.file = file;
  }

  MatSubsystem Read() {
    if (!h5_.ok()) return subsystem_;  // matio says what is wrong with it
    if (H5Lexists(h5_.get(), "#subsystem#", H5P_DEFAULT) <= 0) return subsystem_;
    FindReferences(h5_.get(), "", 0);
    if (std::none_of(subsystem_.references.begin(), subsystem_.references.end(),
                     [](const MatReference& r) { return IsTable(r.class_name); }))
      return subsystem_;
    const Hdf5Handle cells(H5Oopen(h5_.get(), "#subsystem#/MCOS", H5P_DEFAULT), H5Oclose);
    if (!cells.ok() || H5Iget_type(cells.get()) != H5I_DATASET)
      Damaged("/#subsystem#/MCOS", "is not there");
    subsystem_.cells = Cells(cells.get(), "/#subsystem#/MCOS", 0).cells;
    return subsystem_;
  }

 private:
  [[noreturn]] void Damaged(const std::string& path, const std::string& rule) const {
    throw InputError({file_, path, rule, "The file is damaged: copy or save it again."});
  }

  // Objects among the variables, and in structs.
  void FindReferences(hid_t group, const std::string& within, int depth) {
    if (depth > kDeepestStruct) return;
    for (const std::string& link : LinksOf(group)) {
      if (link.starts_with("#")) continue;
      const Hdf5Handle object(H5Oopen(group, link.c_str(), H5P_DEFAULT), H5Oclose);
      const std::string name = within.empty() ? link : within + "." + link;
      const H5I_type_t kind = object.ok() ? H5Iget_type(object.get()) : H5I_BADID;
      if (kind == H5I_GROUP) FindReferences(object.get(), name, depth + 1);
      if (kind != H5I_DATASET || !HasNumber(object.get(), "MATLAB_object_decode", 3)) continue;
      subsystem_.references.push_back(
          {name, Hdf5TextAttribute(object.get(), "MATLAB_class"), Value(object.get(), name, 0)});
    }
  }

  MatValue Value(hid_t object, const std::string& path, int depth) {
    if (++values_ > kMostObjectValues) Damaged(path, "holds more than 2e6 values");
    if (depth > kDeepestValue) Damaged(path, "is nested more than 24 levels deep");
    if (H5Iget_type(object) == H5I_GROUP) return Struct(object, path, depth);
    MatValue value;
    if (H5Iget_type(object) != H5I_DATASET) return value;
    const std::string klass = Hdf5TextAttribute(object, "MATLAB_class");
    if (HasNumber(object, "MATLAB_empty", 1)) {
      value.size = {0, 0};
      value.kind = klass == "cell"   ? MatValue::Kind::kCells
                   : klass == "char" ? MatValue::Kind::kText
                                     : MatValue::Kind::kOther;
      return value;
    }
    const Hdf5Handle type(H5Dget_type(object), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind == H5T_REFERENCE) return Cells(object, path, depth);
    value.size = SizeOf(object, path);
    if (klass == "char") return Text(object, path, std::move(value));
    if (kind == H5T_COMPOUND) return Complex(object, path, std::move(value));
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) return value;
    const auto found = std::find(kClasses.begin(), kClasses.end(), klass);
    // Logical values are uint8, references to objects uint32.
    const std::size_t index = found != kClasses.end() ? found - kClasses.begin()
                              : klass == "logical"    ? 3
                                                      : 7;
    value.kind = MatValue::Kind::kNumbers;
    value.numbers = EmptyNumbers(index);
    std::visit([&](auto& numbers) { ReadNumbers(object, path, value.size, &numbers); },
               value.numbers);
    return value;
  }

  // The dimensions as MATLAB counts them.
  std::vector<std::size_t> SizeOf(hid_t dataset, const std::string& path) {
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 0 || rank > 16) Damaged(path, "has no size");
    std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
    std::vector<std::size_t> size(extent.rbegin(), extent.rend());
    while (size.size() < 2) size.push_back(1);
    const std::size_t count = CountOf(size);
    if (count > kMostStored - stored_) Damaged(path, "holds more than 1.3e8 numbers");
    stored_ += count;
    return size;
  }

  template <class Number>
  void ReadNumbers(hid_t dataset, const std::string& path, const std::vector<std::size_t>& size,
                   std::vector<Number>* numbers) {
    numbers->resize(CountOf(size));
    if (H5Dread(dataset, NativeType(Number()), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers->data()) < 0)
      Damaged(path, "cannot be read");
  }

  MatValue Text(hid_t dataset, const std::string& path, MatValue value) {
    if (value.size.size() != 2 || value.size[0] != 1) return value;  // several rows
    std::vector<std::uint16_t> units;
    ReadNumbers(dataset, path, value.size, &units);
    value.kind = MatValue::Kind::kText;
    value.text = Utf8Of(units);
    return value;
  }

  MatValue Complex(hid_t dataset, const std::string& path, MatValue value) {
    std::vector<double> real(CountOf(value.size));
    value.imaginary.resize(real.size());
    for (const bool first : {true, false}) {
      const Hdf5Handle part(H5Tcreate(H5T_COMPOUND, sizeof(double)), H5Tclose);
      H5Tinsert(part.get(), first ? "real" : "imag", 0, H5T_NATIVE_DOUBLE);
      if (H5Dread(dataset, part.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                  first ? real.data() : value.imaginary.data()) < 0)
        Damaged(path, "cannot be read");
    }
    value.kind = MatValue::Kind::kNumbers;
    value.numbers = std::move(real);
    return value;
  }

  MatValue Cells(hid_t dataset, const std::string& path, int depth) {
    MatValue value;
    value.kind = MatValue::Kind::kCells;
    value.size = SizeOf(dataset, path);
    std::vector<hobj_ref_t> cells(CountOf(value.size));
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
    if (H5Tequal(type.get(), H5T_STD_REF_OBJ) <= 0 ||
        H5Dread(dataset, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()) < 0)
      Damaged(path, "cannot be read");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string cell = path + "{" + std::to_string(i + 1) + "}";
      const Hdf5Handle object(H5Rdereference2(dataset, H5P_DEFAULT, H5R_OBJECT, &cells[i]),
                              H5Oclose);
      if (!object.ok()) Damaged(cell, "leads nowhere");
      value.cells.push_back(Value(object.get(), cell, depth + 1));
    }
    return value;
  }

  MatValue Struct(hid_t group, const std::string& path, int depth) {
    MatValue value;
    value.kind = MatValue::Kind::kStruct;
    value.size = {1, 1};
    for (const std::string& field : LinksOf(group)) {
      const std::string below = path + "." + field;
      const Hdf5Handle object(H5Oopen(group, field.c_str(), H5P_DEFAULT), H5Oclose);
      if (!object.ok()) Damaged(below, "leads nowhere");
      value.fields.push_back(field);
      value.cells.push_back(Value(object.get(), below, depth + 1));
    }
    return value;
  }

  std::string file_;
  Hdf5Handle h5_;
  MatSubsystem subsystem_;
  std::size_t values_ = 0, stored_ = 0;
};

}  // namespace

MatSubsystem ReadMat73Subsystem(const std::string& file) {
  const Hdf5Silence silence;
  return Mat73Reader(file).Read();
}

}  // namespace hoplab
