#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datasets/import/mat_value.h"

namespace hoplab {

/// An object that a MAT-file names: a variable, or a field of a struct as "log.run".
struct MatReference {
  std::string name;
  std::string class_name;
  MatValue value;  // what refers to it: 0xDD000000, how many dimensions, their sizes, the objects'
                   // numbers, the class's number
};

/// What a MAT-file keeps of objects: who refers to them, and the cells that hold them.
struct MatSubsystem {
  std::string file;
  std::vector<MatReference> references;
  std::vector<MatValue> cells;  // the first describes the others; empty: there are no objects
  bool swapped = false;         // its numbers are in the other byte order
};

/// An object: its class and what its properties hold.
struct MatObject {
  std::string class_name;
  std::map<std::string, const MatValue*> properties;  // in the cells
  /// The property; null if there is none.
  const MatValue* Find(const std::string& property) const;
};

/// True of the classes that are read: table and timetable.
bool IsTable(const std::string& class_name);
/// True if the value stands for an object that lies elsewhere.
bool RefersToObject(const MatValue& value);

/// The objects of a subsystem, found by their references.
class MatObjects {
 public:
  /// Reads the first cell: names, classes, objects and which cell holds which property. Throws
  /// InputError where it is cut off, contradicts itself or is of a version that is not known.
  explicit MatObjects(const MatSubsystem& subsystem);

  /// The one object that `value` stands for; nothing where it stands for several or none. Throws
  /// InputError if there is no such object.
  std::optional<MatObject> Find(const MatValue& value) const;

 private:
  [[noreturn]] void Damaged(const std::string& rule) const;
  std::uint32_t Word(std::size_t at) const;  // of the description, by byte
  std::vector<std::uint32_t> Region(std::size_t number) const;
  const std::string& NameAt(std::uint32_t number) const;
  void AddProperties(const std::vector<std::uint32_t>& blocks, std::uint32_t number,
                     MatObject* object) const;

  const MatSubsystem& subsystem_;
  const std::vector<std::uint8_t>* description_ = nullptr;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> classes_, saved_, objects_, plain_;
};

/// The byte of a MAT-file of version 5 at which its objects begin; 0 if it has none.
std::size_t Mat5ObjectsPlace(std::string_view bytes, bool swapped);
/// The objects of a MAT-file of version 5, read from its bytes; their cells only where one is a
/// table. Throws InputError where the file is damaged.
MatSubsystem ReadMat5Subsystem(std::string_view bytes, bool swapped, const std::string& file);
/// The same of version 7.3.
MatSubsystem ReadMat73Subsystem(const std::string& file);

}  // namespace hoplab
