#pragma once

#include <span>
#include <string_view>

namespace hoplab {

/// A word that reports and tables use, for a reader who meets it for the first time. `hoplab
/// explain` and the reports say the same of it.
struct GlossaryEntry {
  std::string_view word;  // small letters, hyphens
  std::string_view also;  // other names of it, separated by blanks
  std::string_view what;  // what it is, with its equation and unit; its first sentence stands alone
  std::string_view meaning;  // what it means for the reader, and what to do about it
};

/// In the order of the alphabet.
std::span<const GlossaryEntry> Glossary();

}  // namespace hoplab
