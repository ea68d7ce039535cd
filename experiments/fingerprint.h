#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "base/text.h"

namespace hoplab {

/// A hash of settings, FNV-1a with 64 bits: no more than telling one set from another is asked of
/// it.
class Fingerprint {
 public:
  void Add(std::string_view text) {
    for (const char c : text) Byte(static_cast<unsigned char>(c));
    Byte(0);
  }
  void Add(double value) { Add(FormatDouble(value)); }
  std::string Text() const {
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
    return text;
  }

 private:
  void Byte(unsigned char byte) { state_ = (state_ ^ byte) * 0x100000001b3ULL; }
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace hoplab
