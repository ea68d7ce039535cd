#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "datasets/import/mat_value.h"

namespace hoplab {

/// A variable of a MAT-file of version 5, of an object of a class only its reference.
struct Mat5Variable {
  std::string name;
  std::string type_system;  // "MCOS" of an object of a class
  std::string class_name;   // "table"; empty for what is no object
  MatValue value;
};

/// Reads the variables of a stream of level 5 elements, packed ones too, byte by byte within
/// bounds.
class Mat5Elements {
 public:
  /// `part` is how messages call the stream. `swapped`: its numbers are in the other byte order.
  /// `numbers` false: numbers and texts of variables that are no object are passed over.
  Mat5Elements(std::string file, std::string part, bool swapped, bool numbers)
      : file_(std::move(file)), part_(std::move(part)), swapped_(swapped), numbers_(numbers) {}

  /// The variables in `bytes` from `begin` to the end, or the first alone. Throws InputError with
  /// the file, the part and the byte where they are cut off or contradict themselves.
  std::vector<Mat5Variable> Read(std::string_view bytes, std::size_t begin, bool first_alone);

 private:
  struct Element {
    std::uint32_t type = 0;
    std::string_view data;
    std::size_t at = 0;  // of its tag
  };
  struct Span {  // of a stream that is being read
    std::string_view bytes;
    std::size_t at = 0;
  };
  [[noreturn]] void Damaged(std::size_t at, const std::string& rule) const;
  std::uint32_t Word(std::string_view data, std::size_t at) const;
  Element Next(Span* span) const;
  Element Next(Span* span, std::uint32_t type) const;
  std::string Inflated(const Element& packed);
  Mat5Variable Matrix(const Element& element, int depth, bool numbers);
  void Reference(Span* span, int depth, Mat5Variable* variable);
  void Cells(Span* span, int depth, bool numbers, MatValue* value);
  void Struct(Span* span, int depth, bool numbers, bool of_class, MatValue* value);
  void Numbers(Span* span, std::uint32_t klass, bool complex, MatValue* value) const;
  void Text(Span* span, MatValue* value) const;
  template <class Number>
  std::vector<Number> NumbersOf(const Element& element, std::size_t count) const;

  std::string file_, part_;
  bool swapped_, numbers_;
  std::size_t inflated_ = 0, values_ = 0;  // bytes and values so far
};

}  // namespace hoplab
