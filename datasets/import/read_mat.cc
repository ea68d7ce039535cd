// MATLAB's .mat by matio: versions 5 (-v6, -v7) and 7.3. Columns are numeric vectors, columns of
// matrices and those in structs, named as in MATLAB: t, log.t, log.pos(:,2).

#include <matio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <system_error>

#include "base/input_error.h"
#include "datasets/import/number_block.h"
#include "datasets/import/table.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestStruct = 4;
constexpr std::size_t kWidestMatrix = 256;
constexpr std::uint64_t kMostBytes = 1ull << 30;

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

// matio fills what a file that was cut off lacks with zeros, so the lengths that a version 5 file
// states for its variables are added up here: 128 bytes of header, then tags of type and length.
// Returns how many variables there are.
std::size_t CountVariables(std::string_view bytes, bool swapped, const std::string& name) {
  constexpr std::size_t kHeader = 128, kTag = 8;
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
    at += kTag + length;
    ++count;
  }
  return count;
}

// Throws unless the file is of version 5 or 7.3 and whole. Returns how many variables it has, 0 for
// version 7.3.
std::size_t CheckHeader(const fs::path& file) {
  const std::string bytes = ReadFileBytes(file, kMostBytes);
  const std::string mark = bytes.size() >= 128 ? bytes.substr(124, 4) : "";
  const bool little = mark.size() == 4 && mark.substr(2) == "IM";
  const bool big = mark.size() == 4 && mark.substr(2) == "MI";
  const int version = little ? mark[1] : big ? mark[0] : 0;
  if (version != 1 && version != 2)
    throw InputError({file.string(), "", "is no MAT-file of version 5, 7 or 7.3",
                      "In MATLAB or Octave: save('log.mat', '-v7', ...)."});
  return version == 1 ? CountVariables(bytes, big, file.string()) : 0;
}

class MatReader {
 public:
  explicit MatReader(const fs::path& file) {
    table_.file = file.string();
    table_.format = "MAT-file";
    const std::size_t stated = CheckHeader(file);
    const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
    if (!mat)
      throw InputError({table_.file, "", "cannot be read as a MAT-file",
                        "The file is damaged: copy or save it again."});
    std::size_t read = 0;
    while (true) {
      const std::unique_ptr<matvar_t, FreeVariable> variable(Mat_VarReadNext(mat.get()));
      if (!variable) break;
      ++read;
      if (variable->name != nullptr) Add(*variable, variable->name, 0);
    }
    if (read < stated)
      throw InputError({table_.file, "variable " + std::to_string(read + 1), "cannot be read",
                        "The file is damaged: copy or save it again."});
  }

  Table Finish() {
    if (!table_.columns.empty()) return std::move(table_);
    std::string value;
    for (const std::string& name : skipped_) value += (value.empty() ? "" : ", ") + name;
    throw InputError({table_.file, value, "has no numeric vector",
                      "Save vectors, matrices or a struct of them; a table by s = table2struct(T, "
                      "'ToScalar', true); save('log.mat', '-struct', 's')."});
  }

 private:
  void Skip(const std::string& name, const std::string& why) {
    skipped_.push_back(name + " (" + why + ")");
    table_.notes.push_back(name + " is not read: " + why);
  }

  void Add(matvar_t& variable, const std::string& name, int depth) {
    if (variable.rank != 2 || variable.dims == nullptr) return Skip(name, "no vector or matrix");
    if (variable.class_type == MAT_C_STRUCT) return AddStruct(variable, name, depth);
    if (variable.isComplex != 0) return Skip(name, "complex numbers");
    if (variable.data == nullptr) return;  // empty
    switch (variable.class_type) {
      case MAT_C_DOUBLE:
        return AddMatrix<double>(variable, name);
      case MAT_C_SINGLE:
        return AddMatrix<float>(variable, name);
      case MAT_C_INT8:
        return AddMatrix<std::int8_t>(variable, name);
      case MAT_C_UINT8:
        return AddMatrix<std::uint8_t>(variable, name);
      case MAT_C_INT16:
        return AddMatrix<std::int16_t>(variable, name);
      case MAT_C_UINT16:
        return AddMatrix<std::uint16_t>(variable, name);
      case MAT_C_INT32:
        return AddMatrix<std::int32_t>(variable, name);
      case MAT_C_UINT32:
        return AddMatrix<std::uint32_t>(variable, name);
      case MAT_C_INT64:
        return AddMatrix<std::int64_t>(variable, name);
      case MAT_C_UINT64:
        return AddMatrix<std::uint64_t>(variable, name);
      case MAT_C_CHAR:
        return;  // a remark, no measurement
      case MAT_C_OPAQUE:
      case MAT_C_OBJECT:
        return Skip(name, "a MATLAB object such as a table or a timeseries");
      default:
        return Skip(name, "no numbers");
    }
  }

  void AddStruct(matvar_t& variable, const std::string& name, int depth) {
    if (variable.dims[0] * variable.dims[1] != 1) return Skip(name, "an array of structs");
    if (depth == kDeepestStruct) return Skip(name, "structs within structs");
    const unsigned count = Mat_VarGetNumberOfFields(&variable);
    char* const* names = Mat_VarGetStructFieldnames(&variable);
    for (unsigned i = 0; i < count && names != nullptr; ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      if (field != nullptr) Add(*field, name + "." + names[i], depth + 1);
    }
  }

  template <class Number>
  void AddMatrix(const matvar_t& variable, const std::string& name) {
    const std::size_t rows = variable.dims[0], columns = variable.dims[1];
    if (rows * columns < 2) return;  // a setting such as a sample rate
    // The bytes matio has are those of the class, or it could not make sense of the file.
    if (variable.nbytes / sizeof(Number) < rows * columns || rows > kMostNumbers / columns)
      return Skip(name, "its size and its numbers do not agree");
    const auto* numbers = static_cast<const Number*>(variable.data);
    const bool lies = rows < columns;  // one series a row, as a row vector has
    const std::size_t length = std::max(rows, columns), series = std::min(rows, columns);
    if (series > kWidestMatrix) return Skip(name, "too many columns");
    for (std::size_t j = 0; j < series; ++j) {
      const std::string index = std::to_string(j + 1);
      SourceColumn column;
      column.name = series == 1 ? name : name + (lies ? "(" + index + ",:)" : "(:," + index + ")");
      column.unit = SplitTitle(name).unit;
      table_.texts.emplace_back();
      column.cells = TextOfNumbers(
          length, [&](std::size_t i) { return numbers[lies ? j + i * rows : i + j * rows]; },
          &table_.texts.back());
      table_.columns.push_back(std::move(column));
    }
    numbers_ += rows * columns;
    if (numbers_ > kMostNumbers)
      throw InputError({table_.file, "", "has more than 2e7 numbers",
                        "Save the variables of one recording only."});
  }

  Table table_;
  std::vector<std::string> skipped_;
  std::size_t numbers_ = 0;
};

}  // namespace

Table ReadMat(const fs::path& file) { return MatReader(file).Finish(); }

}  // namespace hoplab
