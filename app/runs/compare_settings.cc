#include "app/runs/compare_settings.h"

#include <algorithm>

namespace hoplab {

void AddCompareOptions(CLI::App& sub, CompareSettings& settings) {
  AddProblemOptions(sub, settings.problem);
  // A model (`--variant`) says both.
  for (const char* name : {"--law", "--with"}) sub.remove_option(sub.get_option(name));
  sub.add_option("--variant", settings.models,
                 "A law, and effects to fit with it; repeatable (default: every law)")
      ->option_text("LAW+EFFECT...")
      ->allow_extra_args(false);
  sub.add_option("--true", settings.truth, "name=value known from elsewhere, to compare with")
      ->delimiter(',')
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false);
}

std::vector<ComparedModel> ComparedModels(const CompareSettings& settings, const Dataset& dataset) {
  if (settings.models.empty()) return AllLaws(dataset);
  std::vector<ComparedModel> models;
  for (const std::string& text : settings.models) {
    ComparedModel model;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('+', begin), text.size());
      const std::string word = text.substr(begin, end - begin);
      if (begin == 0)
        model.law = word;
      else
        model.with_effects.push_back(word);
      begin = end + 1;
    }
    models.push_back(model);
  }
  return models;
}

}  // namespace hoplab
