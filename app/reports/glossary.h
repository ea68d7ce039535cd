#pragma once

#include <string>
#include <vector>

namespace hoplab {

/// A word that reports and tables use, for a reader who meets it for the first time. `hoplab
/// explain` and the reports say the same of it.
struct GlossaryEntry {
  std::string word;     // small letters, hyphens
  std::string also;     // other names of it, separated by blanks
  std::string what;     // what it is, with its equation and unit; its first sentence stands alone
  std::string meaning;  // what it means for the reader, and what to do about it
};

/// In the order of the alphabet; read from app/reports/texts/glossary.txt when first asked for.
const std::vector<GlossaryEntry>& Glossary();

}  // namespace hoplab
