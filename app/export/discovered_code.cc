#include "app/export/discovered_code.h"

#include "app/export/effect_code.h"
#include "app/records/discovery_words.h"
#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {
namespace {
std::string CodeFile(const FormulaSource& source) { return source.name + ".cc"; }
}  // namespace

std::map<std::string, std::string> DiscoveryCode(const Discovery& d) {
  std::map<std::string, std::string> files;
  for (std::size_t i = 0; i < d.found.size(); ++i) {
    const FormulaSource source = WrittenSource(d.found[i], i);
    if (UnknownToCode(source).empty()) files[CodeFile(source)] = EffectCodeOf(source, source.name);
  }
  return files;
}

std::string CodeReport(const Discovery& d, bool colours) {
  std::string text;
  for (std::size_t i = 0; i < d.found.size(); ++i) {
    const FormulaSource source = WrittenSource(d.found[i], i);
    const std::vector<std::string> unknown = UnknownToCode(source);
    text += Labelled("code",
                     unknown.empty()
                         ? CodeFile(source) + ", for model/effects"
                         : "none of " + DiscoveredFile(i) + ": a compiled effect does not know " +
                               Join(unknown) + " there",
                     colours);
  }
  return text;
}

}  // namespace hoplab
