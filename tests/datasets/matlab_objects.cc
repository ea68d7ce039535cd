// MAT-files with objects of MATLAB's classes, written from the layout that datasets/import
// describes and from files that MATLAB itself wrote of function handles, byte
// by byte. Nothing of the reader is used here.

#include "tests/datasets/matlab_objects.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tests/datasets/matlab_bytes.h"

namespace hoplab::testing {
namespace {

constexpr std::uint32_t kMark = 0xDD000000;

std::string Element(std::uint32_t type, const std::string& data, bool big) {
  std::string bytes;
  const auto length = static_cast<std::uint32_t>(data.size());
  if (length > 0 && length <= 4) {
    Put(length << 16 | type, big, &bytes);
    bytes += data;
  } else {
    Put(type, big, &bytes);
    Put(length, big, &bytes);
    bytes += data;
  }
  bytes.resize((bytes.size() + 7) / 8 * 8);
  return bytes;
}

std::string Words(const std::vector<std::uint32_t>& words, bool big) {
  std::string bytes;
  for (const std::uint32_t word : words) Put(word, big, &bytes);
  return bytes;
}

std::string Matrix(const std::string& name, const MatlabValue& value, bool big);

std::string Contents(const MatlabValue& value, bool big) {
  const KindOfBytes kind = BytesOf(value.kind);
  std::string bytes;
  if (value.kind == Kind::kCell || value.kind == Kind::kStruct) {
    if (value.kind == Kind::kStruct) {
      std::size_t width = 1;
      for (const std::string& field : value.fields) width = std::max(width, field.size() + 1);
      std::string names;
      for (std::string field : value.fields) {
        field.resize(width);
        names += field;
      }
      bytes += Element(5, Words({static_cast<std::uint32_t>(width)}, big), big);
      bytes += Element(1, names, big);
    }
    for (const MatlabValue& cell : value.cells) bytes += Matrix("", cell, big);
    return bytes;
  }
  std::string numbers;
  if (value.kind == Kind::kChar) {
    for (const char letter : value.text)
      Put(static_cast<std::uint16_t>(static_cast<unsigned char>(letter)), big, &numbers);
    return Element(kind.type, numbers, big);
  }
  // MATLAB writes whole numbers as the smallest that hold them.
  const bool small = value.kind == Kind::kDouble && value.imaginary.empty() &&
                     std::all_of(value.real.begin(), value.real.end(), [](double number) {
                       return number >= 0 && number < 256 && number == std::floor(number);
                     });
  const std::uint32_t type = small ? 2 : kind.type;
  for (const double number : value.real) PutNumber(number, type, big, &numbers);
  bytes = Element(type, numbers, big);
  if (value.imaginary.empty()) return bytes;
  numbers.clear();
  for (const double number : value.imaginary) PutNumber(number, kind.type, big, &numbers);
  return bytes + Element(kind.type, numbers, big);
}

// An opaque matrix: three names and one matrix.
std::string Opaque(const std::string& name, const std::string& class_name,
                   const std::string& matrix, bool big) {
  return Element(14,
                 Element(6, Words({17, 0}, big), big) + Element(1, name, big) +
                     Element(1, "MCOS", big) + Element(1, class_name, big) + matrix,
                 big);
}

std::string Matrix(const std::string& name, const MatlabValue& value, bool big) {
  if (!value.class_name.empty()) {
    MatlabValue words = value;
    words.class_name.clear();
    return Opaque(name, value.class_name, Matrix("", words, big), big);
  }
  std::uint32_t flags = BytesOf(value.kind).klass;
  if (value.kind == Kind::kLogical) flags |= 0x200;
  if (!value.imaginary.empty()) flags |= 0x800;
  std::vector<std::uint32_t> size(value.size.begin(), value.size.end());
  return Element(14,
                 Element(6, Words({flags, 0}, big), big) + Element(5, Words(size, big), big) +
                     Element(1, name, big) + Contents(value, big),
                 big);
}

std::string Packed(const std::string& element, bool big) {
  std::string data(compressBound(element.size()), '\0');
  uLongf length = data.size();
  compress(reinterpret_cast<Bytef*>(data.data()), &length,
           reinterpret_cast<const Bytef*>(element.data()), element.size());
  std::string bytes;
  Put(std::uint32_t{15}, big, &bytes);
  Put(static_cast<std::uint32_t>(length), big, &bytes);
  return bytes + data.substr(0, length);
}

}  // namespace

MatlabValue MatlabMatrix(std::size_t rows, std::size_t columns, std::vector<double> numbers,
                         Kind kind) {
  MatlabValue value;
  value.kind = kind;
  value.size = {rows, columns};
  value.real = std::move(numbers);
  return value;
}

MatlabValue MatlabColumn(std::vector<double> numbers, Kind kind) {
  const std::size_t rows = numbers.size();
  return MatlabMatrix(rows, 1, std::move(numbers), kind);
}

MatlabValue MatlabNumber(double number) { return MatlabColumn({number}); }

MatlabValue MatlabText(const std::string& text) {
  MatlabValue value;
  value.kind = Kind::kChar;
  value.size = {text.empty() ? std::size_t{0} : 1, text.size()};
  value.text = text;
  return value;
}

MatlabValue MatlabCells(std::vector<MatlabValue> cells) {
  MatlabValue value;
  value.kind = Kind::kCell;
  value.size = {cells.empty() ? std::size_t{0} : 1, cells.size()};
  value.cells = std::move(cells);
  return value;
}

MatlabValue MatlabTexts(const std::vector<std::string>& texts) {
  std::vector<MatlabValue> cells;
  std::transform(texts.begin(), texts.end(), std::back_inserter(cells), MatlabText);
  return MatlabCells(std::move(cells));
}

MatlabValue MatlabStruct(const MatlabFields& fields) {
  MatlabValue value;
  value.kind = Kind::kStruct;
  value.size = {1, 1};
  for (const auto& [name, of] : fields) {
    value.fields.push_back(name);
    value.cells.push_back(of);
  }
  return value;
}

std::uint32_t MatlabObjects::NumberOfName(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) names_.push_back(name);
  return static_cast<std::uint32_t>(std::find(names_.begin(), names_.end(), name) - names_.begin() +
                                    1);
}

std::uint32_t MatlabObjects::NumberOfClass(const std::string& name) {
  const std::uint32_t number = NumberOfName(name);
  auto found = std::find(classes_.begin(), classes_.end(), number);
  if (found == classes_.end()) {
    classes_.push_back(number);
    defaults_.emplace_back();
    found = classes_.end() - 1;
  }
  return static_cast<std::uint32_t>(found - classes_.begin() + 1);
}

MatlabValue MatlabObjects::Add(const std::string& class_name, const MatlabFields& properties,
                               bool own_form) {
  Object object;
  object.klass = NumberOfClass(class_name);
  object.own_form = own_form;
  for (const auto& [name, value] : properties) {
    object.properties.push_back({NumberOfName(name), static_cast<std::uint32_t>(values_.size())});
    values_.push_back(value);
    // Within the cells what refers to an object is bare numbers.
    const auto bare = [](auto&& self, MatlabValue* v) -> void {
      v->class_name.clear();
      for (MatlabValue& cell : v->cells) self(self, &cell);
    };
    bare(bare, &values_.back());
  }
  objects_.push_back(std::move(object));
  MatlabValue reference =
      MatlabColumn({static_cast<double>(kMark), 2, 1, 1, static_cast<double>(objects_.size()),
                    static_cast<double>(objects_.back().klass)},
                   Kind::kUint32);
  reference.class_name = class_name;
  return reference;
}

void MatlabObjects::SetDefault(const std::string& class_name, const MatlabFields& properties) {
  defaults_[NumberOfClass(class_name) - 1] = properties;
}

std::string MatlabObjects::Description(bool big) const {
  std::string names;
  for (const std::string& name : names_) names += name + '\0';
  names.resize((names.size() + 7) / 8 * 8);
  std::vector<std::uint32_t> classes = {0, 0, 0, 0}, saved = {0, 0}, objects(6, 0), plain = {0, 0};
  for (const std::uint32_t klass : classes_) classes.insert(classes.end(), {0, klass, 0, 0});
  std::uint32_t blocks_saved = 0, blocks_plain = 0, number = 0;
  for (const Object& object : objects_) {
    std::vector<std::uint32_t>& region = object.own_form ? saved : plain;
    ++(object.own_form ? blocks_saved : blocks_plain);
    ++number;
    objects.insert(objects.end(), {object.klass, 0, 0, object.own_form ? blocks_saved : 0,
                                   object.own_form ? 0 : blocks_plain, number});
    region.push_back(static_cast<std::uint32_t>(object.properties.size()));
    for (const Property& p : object.properties) region.insert(region.end(), {p.name, 1, p.cell});
    if (region.size() % 2 != 0) region.push_back(0);
  }
  const std::vector<std::uint32_t> dynamic(2 * (objects_.size() + 1), 0);
  const std::string regions[] = {Words(classes, big), Words(saved, big), Words(objects, big),
                                 Words(plain, big), Words(dynamic, big)};
  std::string bytes;
  Put(version_, big, &bytes);
  Put(static_cast<std::uint32_t>(names_.size()), big, &bytes);
  auto at = static_cast<std::uint32_t>(40 + names.size());
  Put(at, big, &bytes);
  for (const std::string& region : regions) {
    at += static_cast<std::uint32_t>(region.size());
    Put(at, big, &bytes);
  }
  for (int i = 0; i < 2; ++i) Put(version_ < 4 ? 0 : at, big, &bytes);
  bytes += names;
  for (const std::string& region : regions) bytes += region;
  return bytes;
}

std::vector<MatlabValue> MatlabObjects::Cells(bool big) const {
  std::vector<double> description;
  for (const char byte : Description(big)) description.push_back(static_cast<unsigned char>(byte));
  std::vector<MatlabValue> cells = {MatlabColumn(description, Kind::kUint8), MatlabCells({})};
  cells.insert(cells.end(), values_.begin(), values_.end());
  std::vector<MatlabValue> defaults = {MatlabStruct({})};
  for (const MatlabFields& fields : defaults_) defaults.push_back(MatlabStruct(fields));
  std::vector<MatlabValue> unknown(defaults.size(), MatlabStruct({}));
  if (version_ >= 4) cells.push_back(MatlabCells(unknown));
  if (version_ >= 3)
    cells.push_back(MatlabColumn(std::vector<double>(defaults.size(), 0), Kind::kInt32));
  cells.push_back(MatlabCells(defaults));
  return cells;
}

std::string Level5Bytes(const MatlabVariables& variables, const MatlabObjects& objects, bool packed,
                        bool big) {
  std::string body;
  const auto add = [&](const std::string& element) {
    body += packed ? Packed(element, big) : element;
  };
  for (const auto& [name, value] : variables) add(Matrix(name, value, big));
  const std::size_t offset = 128 + body.size();

  MatlabValue cells = MatlabCells(objects.Cells(big));
  std::swap(cells.size[0], cells.size[1]);
  std::string inner(big ? std::string("\1\0MI", 4) : std::string("\0\1IM", 4));
  inner.resize(8);
  // A struct of one field, which is an opaque matrix.
  inner += Element(14,
                   Element(6, Words({2, 0}, big), big) + Element(5, Words({1, 1}, big), big) +
                       Element(1, "", big) + Element(5, Words({5}, big), big) +
                       Element(1, std::string("MCOS\0", 5), big) +
                       Opaque("", "FileWrapper__", Matrix("", cells, big), big),
                   big);
  std::vector<double> stream;
  for (const char byte : inner) stream.push_back(static_cast<unsigned char>(byte));
  add(Matrix("", MatlabMatrix(1, stream.size(), stream, Kind::kUint8), big));

  std::string header = "MATLAB 5.0 MAT-file, written by a test";
  header.resize(116, ' ');
  Put(static_cast<std::uint64_t>(offset), big, &header);
  header += big ? std::string("\1\0MI", 4) : std::string("\0\1IM", 4);
  return header + body;
}

}  // namespace hoplab::testing
