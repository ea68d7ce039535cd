#include "app/runs/compare_settings.h"

#include <algorithm>

namespace hoplab {

void AddCompareOptions(CLI::App& sub, CompareSettings& settings) {
  AddProblemOptions(sub, settings.problem);
  // A variant says both.
  for (const char* name : {"--law", "--with"}) sub.remove_option(sub.get_option(name));
  sub.add_option("--variant", settings.variants,
                 "A law, and effects to fit with it; repeatable (default: every law)")
      ->option_text("LAW+EFFECT...")
      ->allow_extra_args(false);
  sub.add_option("--true", settings.truth, "name=value known from elsewhere, to compare with")
      ->delimiter(',')
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false);
}

std::vector<Variant> VariantsOf(const CompareSettings& settings, const Dataset& dataset) {
  if (settings.variants.empty()) return AllLaws(dataset);
  std::vector<Variant> variants;
  for (const std::string& text : settings.variants) {
    Variant variant;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('+', begin), text.size());
      const std::string word = text.substr(begin, end - begin);
      if (begin == 0)
        variant.law = word;
      else
        variant.with_effects.push_back(word);
      begin = end + 1;
    }
    variants.push_back(variant);
  }
  return variants;
}

}  // namespace hoplab
