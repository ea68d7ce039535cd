// MATLAB's .mat by matio: versions 5 (-v6, -v7) and 7.3. Columns are numeric vectors, columns of
// matrices, series of arrays of three dimensions and those in structs, named as in MATLAB: t,
// log.t, log.pos(:,2), log.markers(1,3,:). A struct of Qualisys' names its markers and its frame
// rate: hip.X, Time. Tables and timetables, which matio does not know, are read by mat_tables.cc.

#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/limits.h"
#include "datasets/import/mat_tables.h"
#include "datasets/import/number_block.h"
#include "datasets/import/table.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

// matio fills what a file that was cut off lacks with zeros, so the lengths that a version 5 file
// states for its variables are added up here: 128 bytes of header, then tags of type and length.
// Returns how many variables there are, without what holds the objects: matio may fail at that.
std::size_t CountVariables(std::string_view bytes, bool swapped, const std::string& name) {
  constexpr std::size_t kHeader = 128, kTag = 8;
  const std::size_t objects = Mat5ObjectsPlace(bytes, swapped);
  std::size_t at = kHeader, count = 0;
  while (at < bytes.size()) {
    std::array<unsigned char, 4> raw{};
    if (bytes.size() - at >= kTag) std::memcpy(raw.data(), bytes.data() + at + 4, raw.size());
    if (swapped) std::reverse(raw.begin(), raw.end());
    std::uint32_t length = 0;
    std::memcpy(&length, raw.data(), raw.size());
    if (bytes.size() - at < kTag || bytes.size() - at - kTag < length)
      throw InputError({name, "size = " + std::to_string(bytes.size()) + " bytes",
                        "the variable at byte " + std::to_string(at) + " is cut off",
                        "The file was not written or copied to its end: copy or save it again."});
    count += at != objects;
    at += kTag + length;
  }
  return count;
}

// The bytes of a file of version 5, nothing of one of version 7.3; throws for another one.
std::string CheckedBytes(const fs::path& file, bool* swapped) {
  std::string bytes = ReadFileBytes(file, kMostBytes);
  const std::string mark = bytes.size() >= 128 ? bytes.substr(124, 4) : "";
  const bool little = mark.size() == 4 && mark.substr(2) == "IM";
  const bool big = mark.size() == 4 && mark.substr(2) == "MI";
  const int version = little ? mark[1] : big ? mark[0] : 0;
  if (version != 1 && version != 2)
    throw InputError({file.string(), "", "is no MAT-file of version 5, 7 or 7.3",
                      "In MATLAB or Octave: save('log.mat', '-v7', ...)."});
  *swapped = big;
  return version == 1 ? bytes : "";
}

class MatReader {
 public:
  explicit MatReader(const fs::path& file) {
    table_.file = file.string();
    table_.format = "MAT-file";
    bool swapped = false;
    const std::string bytes = CheckedBytes(file, &swapped);
    const std::size_t stated = bytes.empty() ? 0 : CountVariables(bytes, swapped, table_.file);
    objects_ = bytes.empty() ? ReadMat73Subsystem(table_.file)
                             : ReadMat5Subsystem(bytes, swapped, table_.file);
    const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
    if (!mat)
      throw InputError({table_.file, "", "cannot be read as a MAT-file",
                        "The file is damaged: copy or save it again."});
    std::size_t read = 0;
    while (true) {
      const std::unique_ptr<matvar_t, FreeVariable> variable(Mat_VarReadNext(mat.get()));
      if (!variable) break;
      ++read;
      // What has no name belongs to objects.
      if (variable->name != nullptr && *variable->name != '\0') Add(*variable, variable->name, 0);
    }
    if (read < stated)
      throw InputError({table_.file, "variable " + std::to_string(read + 1), "cannot be read",
                        "The file is damaged: copy or save it again."});
    AddObjects();
  }

  Table Finish() {
    if (!table_.columns.empty()) return std::move(table_);
    std::string value;
    for (const std::string& name : skipped_) value += (value.empty() ? "" : ", ") + name;
    throw InputError({table_.file, value, "has no numeric vector or array",
                      "Save vectors, matrices, a struct or a table of them; of a timeseries its "
                      "Time and Data."});
  }

 private:
  void Skip(const std::string& name, const std::string& why) {
    skipped_.push_back(name + " (" + why + ")");
    table_.notes.push_back(name + " is not read: " + why);
  }

  // Tables, which matio does not read.
  void AddObjects() {
    std::optional<MatObjects> objects;
    for (const MatReference& reference : objects_.references) {
      if (!IsTable(reference.class_name)) {
        Skip(reference.name, "an object of MATLAB's class " + reference.class_name);
        continue;
      }
      if (!objects) objects.emplace(objects_);
      const std::string why = AddMatTable(*objects, reference, &table_);
      if (!why.empty()) Skip(reference.name, why);
    }
  }

  bool IsObject(const std::string& name) const {
    return std::any_of(objects_.references.begin(), objects_.references.end(),
                       [&](const MatReference& r) { return r.name == name; });
  }

  void Add(matvar_t& variable, const std::string& name, int depth) {
    // AddObjects sees to objects; of those at the top matio does not know the names.
    if (IsObject(name) || (variable.class_type == MAT_C_OPAQUE && !objects_.references.empty()))
      return;
    if (variable.class_type == MAT_C_OPAQUE) return Skip(name, "an object of a MATLAB class");
    if (variable.rank < 2 || variable.rank > 3 || variable.dims == nullptr)
      return Skip(name, "more than three dimensions");
    if (variable.class_type == MAT_C_STRUCT) return AddStruct(variable, name, depth);
    if (variable.isComplex != 0) return Skip(name, "complex numbers");
    if (variable.data == nullptr) return;  // empty
    switch (variable.class_type) {
      case MAT_C_DOUBLE:
        return AddArray<double>(variable, name);
      case MAT_C_SINGLE:
        return AddArray<float>(variable, name);
      case MAT_C_INT8:
        return AddArray<std::int8_t>(variable, name);
      case MAT_C_UINT8:
        return AddArray<std::uint8_t>(variable, name);
      case MAT_C_INT16:
        return AddArray<std::int16_t>(variable, name);
      case MAT_C_UINT16:
        return AddArray<std::uint16_t>(variable, name);
      case MAT_C_INT32:
        return AddArray<std::int32_t>(variable, name);
      case MAT_C_UINT32:
        return AddArray<std::uint32_t>(variable, name);
      case MAT_C_INT64:
        return AddArray<std::int64_t>(variable, name);
      case MAT_C_UINT64:
        return AddArray<std::uint64_t>(variable, name);
      case MAT_C_CHAR:
        return;  // a remark, no measurement
      case MAT_C_OBJECT:
        return Skip(name, "an object of a MATLAB class");
      default:
        return Skip(name, "no numbers");
    }
  }

  void AddStruct(matvar_t& variable, const std::string& name, int depth) {
    if (variable.rank != 2 || variable.dims[0] * variable.dims[1] != 1)
      return Skip(name, "an array of structs");
    if (depth == kDeepestStruct) return Skip(name, "structs within structs");
    const std::optional<double> rate = QualisysRate(variable);
    if (rate) qualisys_ = true;
    labels_ = LabelsIn(variable);
    const unsigned count = Mat_VarGetNumberOfFields(&variable);
    char* const* names = Mat_VarGetStructFieldnames(&variable);
    for (unsigned i = 0; i < count && names != nullptr; ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      const bool is_labels =
          field != nullptr && field->class_type == MAT_C_CELL && !labels_.empty();
      if (field == nullptr || is_labels) continue;
      const std::vector<std::string> labels = labels_;
      Add(*field, name + "." + names[i], depth + 1);
      labels_ = labels;
    }
    labels_.clear();
    if (!rate) return;
    qualisys_ = false;
    AddFrameTimes(name, *rate);
  }

  // The frame rate of a struct as Qualisys Track Manager exports it; nothing for another one.
  static std::optional<double> QualisysRate(matvar_t& variable) {
    const matvar_t* rate = Mat_VarGetStructFieldByName(&variable, "FrameRate", 0);
    const bool motion = Mat_VarGetStructFieldByName(&variable, "Trajectories", 0) != nullptr ||
                        Mat_VarGetStructFieldByName(&variable, "RigidBodies", 0) != nullptr;
    if (!motion || rate == nullptr || rate->class_type != MAT_C_DOUBLE || rate->data == nullptr ||
        rate->nbytes < sizeof(double))
      return std::nullopt;
    const double hz = *static_cast<const double*>(rate->data);
    return hz > 0 && std::isfinite(hz) ? std::optional(hz) : std::nullopt;
  }

  // What a struct calls the first index of its arrays: the cells of `Labels` or `Name`.
  static std::vector<std::string> LabelsIn(matvar_t& variable) {
    std::vector<std::string> labels;
    for (const char* key : {"Labels", "Name"}) {
      const matvar_t* list = Mat_VarGetStructFieldByName(&variable, key, 0);
      if (list == nullptr || list->class_type != MAT_C_CELL || list->data == nullptr) continue;
      const auto* cells = static_cast<matvar_t* const*>(list->data);
      for (std::size_t i = 0; i < list->nbytes / sizeof(matvar_t*); ++i)
        labels.push_back(cells[i] == nullptr ? "" : TextOf(*cells[i]));
      return labels;
    }
    return labels;
  }

  // A row of characters; those beyond ASCII as ?.
  static std::string TextOf(const matvar_t& variable) {
    std::string text;
    if (variable.class_type != MAT_C_CHAR || variable.data == nullptr) return text;
    const auto add = [&](const auto* units, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        text += units[i] < 128 ? static_cast<char>(units[i]) : '?';
    };
    if (variable.data_size == 2)
      add(static_cast<const std::uint16_t*>(variable.data), variable.nbytes / 2);
    else
      add(static_cast<const unsigned char*>(variable.data), variable.nbytes);
    return text;
  }

  // Qualisys writes no times, but how many frames a second it took.
  void AddFrameTimes(const std::string& name, double rate) {
    if (frames_ == 0) return;
    SourceColumn column;
    column.name = "Time";
    column.unit = "s";
    table_.texts.emplace_back();
    column.cells = TextOfNumbers(
        frames_, [&](std::size_t i) { return static_cast<double>(i) / rate; },
        &table_.texts.back());
    table_.columns.push_back(std::move(column));
    table_.units[Dimension::kTime] = "s";
    table_.notes.push_back(name + ": markers in mm, Time is frame / " + FormatDouble(rate) + " Hz");
    frames_ = 0;
  }

  // The longest dimension is time; each place in the others is a column.
  template <class Number>
  void AddArray(const matvar_t& variable, const std::string& name) {
    const bool flat = variable.rank == 2;
    const std::array<std::size_t, 3> size = {variable.dims[0], variable.dims[1],
                                             flat ? 1 : variable.dims[2]};
    if (size[0] == 0 || size[1] == 0 || size[2] == 0) return;
    if (size[0] > kMostNumbers / size[1] / size[2])
      return Skip(name, "its size and its numbers do not agree");
    const std::size_t count = size[0] * size[1] * size[2];
    if (count < 2) return;  // a setting such as a sample rate
    // The bytes matio has are those of the class, or it could not make sense of the file.
    if (variable.nbytes / sizeof(Number) < count)
      return Skip(name, "its size and its numbers do not agree");
    std::size_t along = flat && size[0] >= size[1] ? 0 : flat ? 1 : 2;
    for (std::size_t d = 0; d < 3; ++d)
      if (size[d] > size[along]) along = d;
    if (count / size[along] > kWidestMatrix) return Skip(name, "too many columns");
    const std::array<std::size_t, 3> stride = {1, size[0], size[0] * size[1]};
    const std::size_t first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
    const auto* numbers = static_cast<const Number*>(variable.data);
    for (std::size_t i = 0; i < size[first]; ++i) {
      for (std::size_t j = 0; j < size[second]; ++j) {
        const Number* begin = numbers + i * stride[first] + j * stride[second];
        std::array<std::size_t, 3> place{};
        place[first] = i;
        place[second] = j;
        AddColumn({ColumnName(name, size, along, place), UnitOf(name, flat), {}}, size[along],
                  [&](std::size_t row) { return begin[row * stride[along]]; });
      }
    }
    if (qualisys_ && !flat && along == 2) frames_ = size[2];
    numbers_ += count;
    if (numbers_ > kMostNumbers)
      throw InputError({table_.file, "", "has more than 2e7 numbers",
                        "Save the variables of one recording only."});
  }

  template <class Next>
  void AddColumn(SourceColumn column, std::size_t length, const Next& next) {
    table_.texts.emplace_back();
    column.cells = TextOfNumbers(length, next, &table_.texts.back());
    table_.columns.push_back(std::move(column));
  }

  std::string UnitOf(const std::string& name, bool flat) const {
    const bool positions = name.ends_with(".Data") || name.ends_with(".Positions");
    if (qualisys_ && !flat && positions) return "mm";
    return SplitTitle(name).unit;
  }

  // log.pos, log.pos(:,2), log.markers(1,3,:); of a labelled array hip.X.
  std::string ColumnName(const std::string& name, const std::array<std::size_t, 3>& size,
                         std::size_t along, const std::array<std::size_t, 3>& place) const {
    static constexpr std::array<const char*, 4> kAxes = {".X", ".Y", ".Z", ".residual"};
    const std::size_t series = size[0] * size[1] * size[2] / size[along];
    if (series == 1) return name;
    if (along == 2 && labels_.size() == size[0] && size[1] <= kAxes.size() && size[1] >= 3) {
      const std::string field = name.substr(name.rfind('.') + 1);
      return labels_[place[0]] + (field == "Data" ? "" : "." + field) + kAxes[place[1]];
    }
    const bool flat = size[2] == 1;
    std::string index;
    for (std::size_t d = 0; d < (flat ? 2u : 3u); ++d)
      index += (d > 0 ? "," : "") + (d == along ? ":" : std::to_string(place[d] + 1));
    return name + "(" + index + ")";
  }

  Table table_;
  MatSubsystem objects_;
  std::vector<std::string> skipped_;
  std::size_t numbers_ = 0;
  bool qualisys_ = false;            // within a struct of Qualisys'
  std::vector<std::string> labels_;  // of the struct that is being read
  std::size_t frames_ = 0;           // of the arrays read in it
};

}  // namespace

Table ReadMat(const fs::path& file) { return MatReader(file).Finish(); }

}  // namespace hoplab
