// The level 5 format as MathWorks publishes it: elements of a tag (type, length) and data; a matrix
// is an element of elements: flags, size, name, contents. A small element has both in one word.
// What is not published: class 17 has no size but three names, the variable's, that of the system
// of types and that of the class, and one matrix, which refers to the object or holds it.

#include "datasets/import/mat5_elements.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "base/input_error.h"
#include "datasets/import/limits.h"

namespace hoplab {
namespace {

enum Type : std::uint32_t {
  kInt8 = 1,
  kUint8 = 2,
  kInt16 = 3,
  kUint16 = 4,
  kInt32 = 5,
  kUint32 = 6,
  kSingle = 7,
  kDouble = 9,
  kInt64 = 12,
  kUint64 = 13,
  kMatrix = 14,
  kPacked = 15,
  kUtf8 = 16,
  kUtf16 = 17,
  kUtf32 = 18,
};

enum Class : std::uint32_t {
  kCellClass = 1,
  kStructClass = 2,
  kObjectClass = 3,
  kCharClass = 4,
  kDoubleClass = 6,  // and on in the order of MatNumbers
  kUint64Class = 15,
  kOpaqueClass = 17,
};

constexpr std::size_t kTag = 8;
constexpr std::size_t kMostInflated = 1ull << 30;
constexpr std::uint32_t kComplexFlag = 0x800;

std::size_t SizeOfType(std::uint32_t type) {
  switch (type) {
    case kInt8:
    case kUint8:
    case kUtf8:
      return 1;
    case kInt16:
    case kUint16:
    case kUtf16:
      return 2;
    case kInt32:
    case kUint32:
    case kSingle:
    case kUtf32:
      return 4;
    case kDouble:
    case kInt64:
    case kUint64:
      return 8;
    default:
      return 0;
  }
}

template <class Stored>
Stored Take(const char* data, bool swapped) {
  std::array<char, sizeof(Stored)> raw{};
  std::memcpy(raw.data(), data, raw.size());
  if (swapped) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Stored>(raw);
}

template <class Number, class Stored>
std::vector<Number> Converted(std::string_view data, bool swapped) {
  std::vector<Number> numbers;
  numbers.reserve(data.size() / sizeof(Stored));
  for (std::size_t at = 0; at + sizeof(Stored) <= data.size(); at += sizeof(Stored))
    numbers.push_back(static_cast<Number>(Take<Stored>(data.data() + at, swapped)));
  return numbers;
}

}  // namespace

void Mat5Elements::Damaged(std::size_t at, const std::string& rule) const {
  throw InputError({file_, part_ + ", byte " + std::to_string(at), rule,
                    "The file is damaged: copy or save it again."});
}

std::uint32_t Mat5Elements::Word(std::string_view data, std::size_t at) const {
  return Take<std::uint32_t>(data.data() + at, swapped_);
}

Mat5Elements::Element Mat5Elements::Next(Span* span) const {
  const std::size_t at = span->at, left = span->bytes.size() - at;
  if (left < kTag) Damaged(at, "is cut off: a tag has 8 bytes");
  Element element;
  element.at = at;
  const std::uint32_t first = Word(span->bytes, at);
  if (first >> 16 != 0) {
    const std::size_t length = first >> 16;
    if (length > 4) Damaged(at, "a small element has at most 4 bytes");
    element.type = first & 0xFFFF;
    element.data = span->bytes.substr(at + 4, length);
    span->at = at + kTag;
    return element;
  }
  element.type = first;
  const std::size_t length = Word(span->bytes, at + 4);
  if (length > left - kTag)
    Damaged(at, "is cut off: " + std::to_string(length) + " bytes are said to follow, " +
                    std::to_string(left - kTag) + " do");
  element.data = span->bytes.substr(at + kTag, length);
  const std::size_t padding = element.type == kPacked ? 0 : (8 - length % 8) % 8;
  span->at = at + kTag + length + std::min(padding, left - kTag - length);
  return element;
}

Mat5Elements::Element Mat5Elements::Next(Span* span, std::uint32_t type) const {
  const Element element = Next(span);
  // Some programs write names and sizes without a sign.
  const bool alike = SizeOfType(type) != 0 && SizeOfType(type) == SizeOfType(element.type);
  if (element.type != type && !alike)
    Damaged(element.at, "has an element of type " + std::to_string(element.type) + " where type " +
                            std::to_string(type) + " belongs");
  return element;
}

std::vector<Mat5Variable> Mat5Elements::Read(std::string_view bytes, std::size_t begin,
                                             bool first_alone) {
  std::vector<Mat5Variable> variables;
  Span span{bytes, std::min(begin, bytes.size())};
  do {
    if (span.at == bytes.size() && !first_alone) break;
    const Element element = Next(&span);
    if (element.type == kMatrix) {
      variables.push_back(Matrix(element, 0, numbers_));
    } else if (element.type == kPacked) {
      const std::string unpacked = Inflated(element);
      Span inner{unpacked, 0};
      const Element matrix = Next(&inner, kMatrix);
      variables.push_back(Matrix(matrix, 0, numbers_));
    } else {
      Damaged(element.at, "type " + std::to_string(element.type) + " is no variable");
    }
  } while (!first_alone);
  return variables;
}

std::string Mat5Elements::Inflated(const Element& packed) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) Damaged(packed.at, "cannot be unpacked");
  // zlib reads from what it does not promise to leave alone.
  std::string input(packed.data);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  std::string output;
  int state = Z_OK;
  while (state == Z_OK) {
    const std::size_t before = output.size();
    output.resize(before + std::max<std::size_t>(4096, before));
    stream.next_out = reinterpret_cast<Bytef*>(output.data() + before);
    stream.avail_out = static_cast<uInt>(
        std::min<std::size_t>(output.size() - before, std::numeric_limits<uInt>::max()));
    const std::size_t room = stream.avail_out;
    state = inflate(&stream, Z_NO_FLUSH);
    output.resize(before + (room - stream.avail_out));
    if (output.size() > kMostInflated - inflated_) break;
  }
  inflateEnd(&stream);
  inflated_ += output.size();
  if (inflated_ > kMostInflated) Damaged(packed.at, "unpacks to more than 1 GiB");
  if (state != Z_STREAM_END) Damaged(packed.at, "cannot be unpacked: the packed data are damaged");
  return output;
}

Mat5Variable Mat5Elements::Matrix(const Element& element, int depth, bool numbers) {
  Mat5Variable variable;
  if (++values_ > kMostObjectValues) Damaged(element.at, "holds more than 2e6 values");
  if (element.data.empty()) return variable;  // how an empty cell is written
  if (depth > kDeepestValue) Damaged(element.at, "is nested more than 24 levels deep");
  Span span{element.data, 0};
  const Element flags = Next(&span, kUint32);
  if (flags.data.size() != 8) Damaged(element.at, "its flags are no 8 bytes");
  const std::uint32_t word = Word(flags.data, 0), klass = word & 0xFF;
  MatValue& value = variable.value;
  if (klass == kOpaqueClass) {
    Reference(&span, depth, &variable);
    return variable;
  }
  const Element size = Next(&span, kInt32);
  for (std::size_t at = 0; at + 4 <= size.data.size(); at += 4)
    value.size.push_back(Word(size.data, at));
  variable.name = std::string(Next(&span, kInt8).data);
  if (klass == kCellClass) {
    Cells(&span, depth, numbers, &value);
  } else if (klass == kStructClass || klass == kObjectClass) {
    Struct(&span, depth, numbers, klass == kObjectClass, &value);
  } else if (klass == kCharClass && numbers) {
    Text(&span, &value);
  } else if (klass >= kDoubleClass && klass <= kUint64Class && numbers) {
    Numbers(&span, klass, (word & kComplexFlag) != 0, &value);
  }
  return variable;
}

void Mat5Elements::Reference(Span* span, int depth, Mat5Variable* variable) {
  variable->name = std::string(Next(span, kInt8).data);
  variable->type_system = std::string(Next(span, kInt8).data);
  variable->class_name = std::string(Next(span, kInt8).data);
  variable->value = Matrix(Next(span, kMatrix), depth + 1, true).value;
}

void Mat5Elements::Cells(Span* span, int depth, bool numbers, MatValue* value) {
  value->kind = MatValue::Kind::kCells;
  const std::size_t count = CountOf(value->size);
  if (count > (span->bytes.size() - span->at) / kTag)
    Damaged(span->at, "has fewer cells than its size says");
  for (std::size_t i = 0; i < count; ++i)
    value->cells.push_back(Matrix(Next(span, kMatrix), depth + 1, numbers).value);
}

void Mat5Elements::Struct(Span* span, int depth, bool numbers, bool of_class, MatValue* value) {
  if (of_class) Next(span, kInt8);  // its class's name
  value->kind = MatValue::Kind::kStruct;
  const Element width = Next(span, kInt32);
  const Element names = Next(span, kInt8);
  const std::size_t length = width.data.size() == 4 ? Word(width.data, 0) : 0;
  if (length == 0) {
    if (!names.data.empty()) Damaged(width.at, "its field names have no length");
    return;
  }
  for (std::size_t at = 0; at + length <= names.data.size(); at += length) {
    const std::string_view name = names.data.substr(at, length);
    value->fields.emplace_back(name.substr(0, name.find('\0')));
  }
  const std::size_t structs = CountOf(value->size);
  const std::size_t most = (span->bytes.size() - span->at) / kTag;
  if (!value->fields.empty() && structs > most / value->fields.size())
    Damaged(span->at, "has fewer fields than its size says");
  for (std::size_t i = 0; i < structs * value->fields.size(); ++i) {
    Mat5Variable field = Matrix(Next(span, kMatrix), depth + 1, numbers);
    // An object within a struct: the field is its reference, its class goes with it.
    if (!field.class_name.empty()) field.value.text = field.class_name;
    value->cells.push_back(std::move(field.value));
  }
}

template <class Number>
std::vector<Number> Mat5Elements::NumbersOf(const Element& element, std::size_t count) const {
  const std::size_t width = SizeOfType(element.type);
  if (width == 0 || element.data.size() % width != 0 || element.data.size() / width != count)
    Damaged(element.at, "its size and its numbers do not agree");
  switch (element.type) {
    case kInt8:
      return Converted<Number, std::int8_t>(element.data, swapped_);
    case kUint8:
    case kUtf8:
      return Converted<Number, std::uint8_t>(element.data, swapped_);
    case kInt16:
      return Converted<Number, std::int16_t>(element.data, swapped_);
    case kUint16:
    case kUtf16:
      return Converted<Number, std::uint16_t>(element.data, swapped_);
    case kInt32:
      return Converted<Number, std::int32_t>(element.data, swapped_);
    case kUint32:
    case kUtf32:
      return Converted<Number, std::uint32_t>(element.data, swapped_);
    case kInt64:
      return Converted<Number, std::int64_t>(element.data, swapped_);
    case kUint64:
      return Converted<Number, std::uint64_t>(element.data, swapped_);
    default:
      break;
  }
  if constexpr (std::is_floating_point_v<Number>) {
    return element.type == kSingle ? Converted<Number, float>(element.data, swapped_)
                                   : Converted<Number, double>(element.data, swapped_);
  }
  Damaged(element.at, "has fractions where whole numbers belong");
}

void Mat5Elements::Numbers(Span* span, std::uint32_t klass, bool complex, MatValue* value) const {
  const std::size_t count = CountOf(value->size);
  const Element real = Next(span);
  value->kind = MatValue::Kind::kNumbers;
  value->numbers = EmptyNumbers(klass - kDoubleClass);
  std::visit(
      [&](auto& numbers) {
        using Number = typename std::decay_t<decltype(numbers)>::value_type;
        numbers = NumbersOf<Number>(real, count);
      },
      value->numbers);
  if (complex) value->imaginary = NumbersOf<double>(Next(span), count);
}

void Mat5Elements::Text(Span* span, MatValue* value) const {
  if (span->at == span->bytes.size()) {
    value->kind = MatValue::Kind::kText;
    return;
  }
  const Element element = Next(span);
  if (CountOf(value->size) != 0 && value->size.front() != 1) return;  // several rows
  value->kind = MatValue::Kind::kText;
  if (element.type == kUtf8) {
    value->text = std::string(element.data);
    return;
  }
  const std::size_t width = SizeOfType(element.type);
  const auto units =
      NumbersOf<std::uint16_t>(element, width == 0 ? 0 : element.data.size() / width);
  value->text = Utf8Of(units);
}

}  // namespace hoplab
