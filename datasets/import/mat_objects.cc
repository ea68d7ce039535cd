// How MATLAB keeps objects of classes is not published; this is the layout that others found out
// and wrote down. The cells: a description, nothing, the properties' values, one or more cells of
// unknown use, the defaults of the classes. The description: a version, the number of names, eight
// places of regions, the names; the regions are the classes (name space, name, 0, 0), the
// properties of objects that a class saves in a form of its own, the objects (class, 0, 0, block of
// the former region, block of the next, number), the properties of the others. A block of
// properties is a count and as many of name, kind, value; it begins at a multiple of 8 bytes. The
// first of everything stands for nothing. Kind 0: the value is a name; 1: the cell, from the third
// on; 2: the value.

#include "datasets/import/mat_objects.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/input_error.h"
#include "datasets/import/limits.h"
#include "datasets/import/mat5_elements.h"

namespace hoplab {
namespace {

constexpr std::uint32_t kMark = 0xDD000000;
constexpr std::uint32_t kOldest = 2, kNewest = 4;
constexpr std::size_t kNamesBegin = 40, kRegionsBegin = 8;
constexpr std::size_t kPerClass = 4, kPerObject = 6, kPerProperty = 3;
constexpr std::size_t kFirstCell = 2;
constexpr std::size_t kHeader = 128, kOffsetAt = 116;

const std::vector<std::uint32_t>* WordsOf(const MatValue& value) {
  return value.kind == MatValue::Kind::kNumbers
             ? std::get_if<std::vector<std::uint32_t>>(&value.numbers)
             : nullptr;
}

// The objects among the fields of a struct, by name.
void AddReferences(const std::string& name, const MatValue& value, int depth,
                   std::vector<MatReference>* references) {
  if (value.kind != MatValue::Kind::kStruct || value.cells.size() != value.fields.size() ||
      depth == kDeepestStruct)
    return;
  for (std::size_t i = 0; i < value.cells.size(); ++i) {
    const std::string field = name + "." + value.fields[i];
    if (RefersToObject(value.cells[i]))
      references->push_back({field, value.cells[i].text, value.cells[i]});
    else
      AddReferences(field, value.cells[i], depth + 1, references);
  }
}

// The cells of the stream that a MAT-file has at its subsystem's place.
void ReadCells(std::string_view bytes, std::size_t offset, bool swapped, MatSubsystem* subsystem) {
  Mat5Elements outer(subsystem->file, "objects' place", swapped, true);
  const std::vector<Mat5Variable> stored = outer.Read(bytes, offset, true);
  const auto* stream = std::get_if<std::vector<std::uint8_t>>(&stored.front().value.numbers);
  if (stream == nullptr || stream->size() < 8)
    throw InputError({subsystem->file, "objects' place, byte " + std::to_string(offset),
                      "does not hold bytes", "The file is damaged: copy or save it again."});
  const std::string inner(stream->begin(), stream->end());
  subsystem->swapped = inner.compare(2, 2, "MI") == 0;
  Mat5Elements elements(subsystem->file, "objects", subsystem->swapped, true);
  for (Mat5Variable& variable : elements.Read(inner, 8, true)) {
    const MatValue* cells = FieldOf(variable.value, "MCOS");
    if (cells != nullptr && cells->kind == MatValue::Kind::kCells) subsystem->cells = cells->cells;
  }
}

}  // namespace

const MatValue* MatObject::Find(const std::string& property) const {
  const auto found = properties.find(property);
  return found == properties.end() ? nullptr : found->second;
}

bool IsTable(const std::string& class_name) {
  return class_name == "table" || class_name == "timetable";
}

bool RefersToObject(const MatValue& value) {
  const std::vector<std::uint32_t>* words = WordsOf(value);
  return words != nullptr && words->size() >= 3 && words->front() == kMark;
}

std::size_t Mat5ObjectsPlace(std::string_view bytes, bool swapped) {
  if (bytes.size() < kHeader) return 0;
  std::array<unsigned char, 8> raw{};
  std::memcpy(raw.data(), bytes.data() + kOffsetAt, raw.size());
  std::uint64_t place = 0;
  for (std::size_t i = 0; i < raw.size(); ++i)
    place |= static_cast<std::uint64_t>(raw[i]) << 8 * (swapped ? 7 - i : i);
  // Files without objects have nothing there, or blanks, or the end of a remark.
  return place >= kHeader && place < bytes.size() ? place : 0;
}

MatSubsystem ReadMat5Subsystem(std::string_view bytes, bool swapped, const std::string& file) {
  MatSubsystem subsystem;
  subsystem.file = file;
  const std::size_t place = Mat5ObjectsPlace(bytes, swapped);
  if (place == 0) return subsystem;
  Mat5Elements elements(file, "variables", swapped, false);
  for (Mat5Variable& variable : elements.Read(bytes, kHeader, false)) {
    if (!variable.class_name.empty())
      subsystem.references.push_back(
          {variable.name, variable.class_name, std::move(variable.value)});
    else if (!variable.name.empty())
      AddReferences(variable.name, variable.value, 0, &subsystem.references);
  }
  if (std::any_of(subsystem.references.begin(), subsystem.references.end(),
                  [](const MatReference& r) { return IsTable(r.class_name); }))
    ReadCells(bytes, place, swapped, &subsystem);
  return subsystem;
}

MatObjects::MatObjects(const MatSubsystem& subsystem) : subsystem_(subsystem) {
  if (subsystem.cells.size() > kFirstCell &&
      subsystem.cells.front().kind == MatValue::Kind::kNumbers)
    description_ = std::get_if<std::vector<std::uint8_t>>(&subsystem.cells.front().numbers);
  if (description_ == nullptr || description_->size() < kNamesBegin)
    Damaged("have no description of 40 bytes or more");
  const std::uint32_t version = Word(0), names = Word(4);
  if (version < kOldest || version > kNewest)
    throw InputError({subsystem_.file, "objects, version = " + std::to_string(version),
                      "must be 2, 3 or 4",
                      "Save s = table2struct(T, 'ToScalar', true); save('log.mat', '-struct', "
                      "'s')."});
  const std::size_t names_end = Word(kRegionsBegin);
  if (names_end > description_->size()) Damaged("have names behind the end of their description");
  std::string name;
  for (std::size_t at = kNamesBegin; at < names_end && names_.size() < names; ++at) {
    const char letter = static_cast<char>((*description_)[at]);
    if (letter != '\0') {
      name += letter;
      continue;
    }
    names_.push_back(name);
    name.clear();
  }
  if (names_.size() < names) Damaged("have fewer names than are said");
  classes_ = Region(0);
  saved_ = Region(1);
  objects_ = Region(2);
  plain_ = Region(3);
}

void MatObjects::Damaged(const std::string& rule) const {
  throw InputError(
      {subsystem_.file, "objects", rule, "The file is damaged: copy or save it again."});
}

std::uint32_t MatObjects::Word(std::size_t at) const {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= static_cast<std::uint32_t>((*description_)[at + i])
            << 8 * (subsystem_.swapped ? 3 - i : i);
  return word;
}

std::vector<std::uint32_t> MatObjects::Region(std::size_t number) const {
  const std::size_t begin = Word(kRegionsBegin + 4 * number);
  const std::size_t end = Word(kRegionsBegin + 4 * number + 4);
  if (begin > end || end > description_->size() || begin < kNamesBegin)
    Damaged("have a region that lies outside their description");
  std::vector<std::uint32_t> words;
  for (std::size_t at = begin; at + 4 <= end; at += 4) words.push_back(Word(at));
  return words;
}

const std::string& MatObjects::NameAt(std::uint32_t number) const {
  if (number == 0 || number > names_.size())
    Damaged("have no name " + std::to_string(number) + ": there are " +
            std::to_string(names_.size()));
  return names_[number - 1];
}

void MatObjects::AddProperties(const std::vector<std::uint32_t>& blocks, std::uint32_t number,
                               MatObject* object) const {
  std::size_t at = 0;
  for (std::uint32_t block = 0;; ++block) {
    if (at >= blocks.size()) Damaged("have no block " + std::to_string(number) + " of properties");
    const std::size_t count = blocks[at];
    if (count > (blocks.size() - at - 1) / kPerProperty)
      Damaged("have a block of properties that is cut off");
    if (block == number) break;
    at += 1 + kPerProperty * count;
    at += at % 2;
  }
  const std::size_t count = blocks[at];
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t* property = &blocks[at + 1 + kPerProperty * i];
    if (property[1] != 1) continue;  // a word or a flag, which no table needs
    const std::size_t cell = kFirstCell + static_cast<std::size_t>(property[2]);
    if (cell >= subsystem_.cells.size())
      Damaged("have " + std::to_string(subsystem_.cells.size()) +
              " cells, and a property in cell " + std::to_string(cell + 1));
    object->properties[NameAt(property[0])] = &subsystem_.cells[cell];
  }
}

std::optional<MatObject> MatObjects::Find(const MatValue& value) const {
  if (!RefersToObject(value)) return std::nullopt;
  const std::vector<std::uint32_t>& words = *WordsOf(value);
  const std::size_t dimensions = words[1];
  if (dimensions > 16 || words.size() < 4 + dimensions) Damaged("have a reference that is cut off");
  std::vector<std::size_t> size(words.begin() + 2,
                                words.begin() + 2 + static_cast<std::ptrdiff_t>(dimensions));
  if (CountOf(size) != 1) return std::nullopt;
  const std::uint32_t number = words[2 + dimensions];
  const std::size_t at = kPerObject * static_cast<std::size_t>(number);
  if (number == 0 || at + kPerObject > objects_.size())
    Damaged("have no object " + std::to_string(number));
  const std::size_t klass = objects_[at];
  if (klass == 0 || kPerClass * klass + kPerClass > classes_.size())
    Damaged("have no class " + std::to_string(klass));
  MatObject object;
  object.class_name = NameAt(classes_[kPerClass * klass + 1]);
  if (const std::uint32_t space = classes_[kPerClass * klass]; space != 0)
    object.class_name = NameAt(space) + "." + object.class_name;
  // What a property holds unless something else was saved.
  const MatValue& defaults = subsystem_.cells.back();
  if (defaults.kind == MatValue::Kind::kCells && klass < defaults.cells.size()) {
    const MatValue& of_class = defaults.cells[klass];
    for (const std::string& field : of_class.fields) {
      if (const MatValue* held = FieldOf(of_class, field)) object.properties[field] = held;
    }
  }
  const std::uint32_t saved = objects_[at + 3], plain = objects_[at + 4];
  if (saved != 0)
    AddProperties(saved_, saved, &object);
  else
    AddProperties(plain_, plain, &object);
  return object;
}

}  // namespace hoplab
