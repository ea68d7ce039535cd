#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hoplab::testing {

/// A value as MATLAB would hold it, to be written into a MAT-file byte by byte.
struct MatlabValue {
  enum class Kind { kDouble, kSingle, kInt32, kUint8, kUint32, kLogical, kChar, kCell, kStruct };
  Kind kind = Kind::kDouble;
  std::vector<std::size_t> size;
  std::vector<double> real, imaginary;  // column by column
  std::string text;
  std::vector<std::string> fields;
  std::vector<MatlabValue> cells;  // or the fields' values
  std::string class_name;          // of an object that this refers to
};

using Kind = MatlabValue::Kind;
using MatlabFields = std::vector<std::pair<std::string, MatlabValue>>;

MatlabValue MatlabMatrix(std::size_t rows, std::size_t columns, std::vector<double> numbers,
                         Kind kind = Kind::kDouble);
MatlabValue MatlabColumn(std::vector<double> numbers, Kind kind = Kind::kDouble);
MatlabValue MatlabNumber(double number);
MatlabValue MatlabText(const std::string& text);
MatlabValue MatlabCells(std::vector<MatlabValue> cells);  // a row
MatlabValue MatlabTexts(const std::vector<std::string>& texts);
MatlabValue MatlabStruct(const MatlabFields& fields);

/// The objects of one file: what MATLAB keeps of them beside the variables.
class MatlabObjects {
 public:
  /// `version` of the description, 2 to 4.
  explicit MatlabObjects(std::uint32_t version = 4) : version_(version) {}

  /// Adds an object and gives what refers to it. `own_form`: its class saves it in a form of its
  /// own, as timetables and strings are.
  MatlabValue Add(const std::string& class_name, const MatlabFields& properties,
                  bool own_form = false);
  /// Sets what a property of a class holds unless an object says otherwise.
  void SetDefault(const std::string& class_name, const MatlabFields& properties);

  /// The description: numbers in the byte order of the file.
  std::string Description(bool big_endian) const;
  /// All cells, the description first.
  std::vector<MatlabValue> Cells(bool big_endian) const;

 private:
  struct Property {
    std::uint32_t name = 0, cell = 0;
  };
  struct Object {
    std::uint32_t klass = 0;
    bool own_form = false;
    std::vector<Property> properties;
  };
  std::uint32_t NumberOfName(const std::string& name);
  std::uint32_t NumberOfClass(const std::string& name);

  std::uint32_t version_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> classes_;  // their names' numbers
  std::vector<MatlabFields> defaults_;  // of the classes
  std::vector<Object> objects_;
  std::vector<MatlabValue> values_;
};

using MatlabVariables = std::vector<std::pair<std::string, MatlabValue>>;

/// The bytes of a MAT-file of version 5. `packed`: as -v7 saves it, else as -v6.
std::string Level5Bytes(const MatlabVariables& variables, const MatlabObjects& objects, bool packed,
                        bool big_endian = false);
/// Writes a MAT-file of version 7.3.
void WriteMat73(const std::filesystem::path& file, const MatlabVariables& variables,
                const MatlabObjects& objects);

}  // namespace hoplab::testing
