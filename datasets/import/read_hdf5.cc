// HDF5: columns are numeric datasets of one dimension, columns of those of two, and the numeric
// members of compound ones, named by their paths: /body/z, /body/pos[:,2], /log.z (member z).

#include <hdf5.h>

#include <algorithm>

#include "base/input_error.h"
#include "datasets/import/hdf5_handle.h"
#include "datasets/import/limits.h"
#include "datasets/import/number_block.h"
#include "datasets/import/table.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

// What the attribute `units` or `unit` of a dataset says; empty if it has none.
std::string UnitAttribute(hid_t dataset) {
  for (const char* name : {"units", "unit", "Units", "Unit"}) {
    const std::string text = Hdf5TextAttribute(dataset, name);
    if (!text.empty()) return text;
  }
  return "";
}

class Hdf5Reader {
 public:
  explicit Hdf5Reader(const fs::path& file) {
    table_.file = file.string();
    table_.format = "HDF5";
    ReadFileBytes(file, kMostBytes);  // says so if the file is absent, unreadable or too large
    if (H5Fis_hdf5(file.c_str()) <= 0)
      throw InputError({table_.file, "", "is no HDF5 file", "Check the name, or say --format."});
    file_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const Hdf5Handle closing(file_, H5Fclose);
    if (!closing.ok())
      throw InputError({table_.file, "", "cannot be opened as HDF5",
                        "The file is damaged, cut off or still being written: copy it again."});
    const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* self) -> herr_t {
      static_cast<Hdf5Reader*>(self)->paths_.push_back(std::string("/") + name);
      return 0;
    };
    if (H5Lvisit(file_, H5_INDEX_NAME, H5_ITER_INC, visit, this) < 0)
      throw InputError({table_.file, "", "its list of datasets cannot be read",
                        "The file is damaged: copy it again."});
    for (const std::string& path : paths_) AddDataset(path);
  }

  Table Finish() {
    if (!table_.columns.empty()) return std::move(table_);
    throw InputError({table_.file, "", "has no numeric dataset of one or two dimensions",
                      "Write times and positions as datasets of numbers."});
  }

 private:
  void Skip(const std::string& path, const std::string& why) {
    table_.notes.push_back(path + " is not read: " + why);
  }

  void AddDataset(const std::string& path) {
    const Hdf5Handle dataset(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (!dataset.ok()) return Skip(path, "it leads nowhere or is damaged");
    if (H5Iget_type(dataset.get()) != H5I_DATASET) return;
    const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
    if (!type.ok() || !space.ok()) Damaged(path);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    hsize_t size[2] = {0, 1};
    if (rank < 1 || rank > 2) return;  // settings, images
    H5Sget_simple_extent_dims(space.get(), size, nullptr);
    if (size[0] * size[1] < 2) return;
    if (size[0] > kMostNumbers || size[1] > kWidestMatrix) return Skip(path, "too large");
    numbers_ += size[0] * size[1];
    if (numbers_ > kMostNumbers)
      throw InputError({table_.file, "", "has more than 2e7 numbers",
                        "Copy the datasets of one recording into a file of their own."});
    const std::string unit = UnitAttribute(dataset.get());
    if (H5Tget_class(type.get()) != H5T_COMPOUND)
      return AddNumbers(path, path, unit, dataset.get(), type.get(), size[0], size[1]);
    const int members = H5Tget_nmembers(type.get());
    for (int i = 0; rank == 1 && i < members; ++i) {
      const Hdf5Handle member(H5Tget_member_type(type.get(), static_cast<unsigned>(i)), H5Tclose);
      char* name = H5Tget_member_name(type.get(), static_cast<unsigned>(i));
      const std::string member_name = name == nullptr ? "" : name;
      H5free_memory(name);
      member_ = member_name;
      AddNumbers(path, path + "." + member_name, SplitTitle(member_name).unit, dataset.get(),
                 member.get(), size[0], 1);
      member_.clear();
    }
  }

  [[noreturn]] void Damaged(const std::string& path) const {
    throw InputError({table_.file, path, "cannot be read",
                      "The file is damaged, cut off or packed by a filter that is not installed."});
  }

  void AddNumbers(const std::string& path, const std::string& name, const std::string& unit,
                  hid_t dataset, hid_t type, std::size_t rows, std::size_t columns) {
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_INTEGER) {
      if (H5Tget_sign(type) == H5T_SGN_NONE)
        return Add<std::uint64_t>(path, name, unit, dataset, H5T_NATIVE_UINT64, rows, columns);
      return Add<std::int64_t>(path, name, unit, dataset, H5T_NATIVE_INT64, rows, columns);
    }
    // h5py writes booleans as an enumeration of 0 and 1.
    if (kind == H5T_ENUM) return AddEnum(path, name, dataset, type, rows, columns);
    if (kind != H5T_FLOAT) return Skip(name, "no numbers");
    if (H5Tget_size(type) <= sizeof(float))
      return Add<float>(path, name, unit, dataset, H5T_NATIVE_FLOAT, rows, columns);
    Add<double>(path, name, unit, dataset, H5T_NATIVE_DOUBLE, rows, columns);
  }

  void AddEnum(const std::string& path, const std::string& name, hid_t dataset, hid_t type,
               std::size_t rows, std::size_t columns) {
    if (H5Tget_size(type) != 1 || !member_.empty()) return Skip(name, "no numbers");
    Add<std::int8_t>(path, name, "", dataset, type, rows, columns);
  }

  // `memory` is the type of Number in memory.
  template <class Number>
  void Add(const std::string& path, const std::string& name, const std::string& unit, hid_t dataset,
           hid_t memory, std::size_t rows, std::size_t columns) {
    std::vector<Number> numbers(rows * columns);
    const Hdf5Handle one_member(member_.empty() ? -1 : H5Tcreate(H5T_COMPOUND, sizeof(Number)),
                                H5Tclose);
    if (one_member.ok()) H5Tinsert(one_member.get(), member_.c_str(), 0, memory);
    const hid_t as = one_member.ok() ? one_member.get() : memory;
    if (H5Dread(dataset, as, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) Damaged(path);
    const bool lies = rows < columns;
    const std::size_t length = std::max(rows, columns), series = std::min(rows, columns);
    for (std::size_t j = 0; j < series; ++j) {
      const std::string index = std::to_string(j);
      SourceColumn column;
      column.name = series == 1 ? name : name + (lies ? "[" + index + ",:]" : "[:," + index + "]");
      column.unit = unit.empty() ? SplitTitle(name).unit : unit;
      table_.texts.emplace_back();
      column.cells = TextOfNumbers(
          length, [&](std::size_t i) { return numbers[lies ? j * columns + i : i * columns + j]; },
          &table_.texts.back());
      table_.columns.push_back(std::move(column));
    }
  }

  Table table_;
  hid_t file_ = -1;
  std::vector<std::string> paths_;
  std::string member_;  // of the compound dataset that is being read
  std::size_t numbers_ = 0;
};

}  // namespace

Table ReadHdf5(const fs::path& file) {
  const Hdf5Silence silence;
  return Hdf5Reader(file).Finish();
}

}  // namespace hoplab
