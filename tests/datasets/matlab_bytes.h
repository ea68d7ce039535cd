#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "tests/datasets/matlab_objects.h"

namespace hoplab::testing {

/// Appends the bytes of a number.
template <class Stored>
void Put(Stored value, bool big_endian, std::string* bytes) {
  char raw[sizeof(Stored)];
  std::memcpy(raw, &value, sizeof raw);
  if (big_endian) std::reverse(raw, raw + sizeof raw);
  bytes->append(raw, sizeof raw);
}

/// Class and type of the level 5 format, class of version 7.3.
struct KindOfBytes {
  std::uint32_t klass, type;
  const char* name;
};

inline KindOfBytes BytesOf(Kind kind) {
  switch (kind) {
    case Kind::kDouble:
      return {6, 9, "double"};
    case Kind::kSingle:
      return {7, 7, "single"};
    case Kind::kInt32:
      return {12, 5, "int32"};
    case Kind::kUint8:
      return {9, 2, "uint8"};
    case Kind::kUint32:
      return {13, 6, "uint32"};
    case Kind::kLogical:
      return {9, 2, "logical"};
    case Kind::kChar:
      return {4, 4, "char"};
    case Kind::kCell:
      return {1, 14, "cell"};
    case Kind::kStruct:
      return {2, 14, "struct"};
  }
  return {};
}

/// Appends a number as `type` of level 5 has it.
inline void PutNumber(double number, std::uint32_t type, bool big, std::string* bytes) {
  switch (type) {
    case 2:
      return Put(static_cast<std::uint8_t>(number), big, bytes);
    case 5:
      return Put(static_cast<std::int32_t>(number), big, bytes);
    case 6:
      return Put(static_cast<std::uint32_t>(number), big, bytes);
    case 7:
      return Put(static_cast<float>(number), big, bytes);
    default:
      return Put(number, big, bytes);
  }
}

}  // namespace hoplab::testing
