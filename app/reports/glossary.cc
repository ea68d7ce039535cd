#include "app/reports/glossary.h"

#include "app/reports/text_entries.h"

namespace hoplab {
namespace {

constexpr std::string_view kGlossaryKeys[] = {"word", "also", "what", "meaning"};

std::vector<GlossaryEntry> ReadGlossary() {
  std::vector<GlossaryEntry> words;
  for (const TextEntry& e : EntriesOf("glossary.txt", kGlossaryKeys))
    words.push_back({e[0], e[1], e[2], e[3]});
  return words;
}

}  // namespace

const std::vector<GlossaryEntry>& Glossary() {
  static const std::vector<GlossaryEntry> kWords = ReadGlossary();
  return kWords;
}

}  // namespace hoplab
