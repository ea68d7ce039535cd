#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "app/records/run_record.h"
#include "app/runs/problem_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/progress.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"
#include "app/terminal/usage_error.h"
#include "base/text.h"
#include "datasets/read_dataset.h"
#include "experiments/law_comparison.h"

namespace hoplab {
namespace {

struct CompareSettings {
  ProblemSettings problem;
  std::vector<std::string> variants;  // "law+effect+effect"
  std::vector<std::string> truth;     // "name=value"
  bool json = false, quiet = false;
};

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

std::string TextOf(const Variant& variant) {
  std::string text = variant.law;
  for (const std::string& effect : variant.with_effects) text += " + " + effect;
  return text;
}

// "22.53 GPa (+2.4 %)": a value with its unit, and how far it is from a stated truth.
std::string ValueText(const VariantResult& row, int k, const std::map<std::string, double>& truth) {
  const SharedParameter& s = row.fit.problem.shared[k];
  const double value = row.fit.result.shared[k];
  const ReadableUnit unit = ReadableUnitOf(value, s.unit);
  std::string text = s.name + " " + Significant(value * unit.factor, 4);
  if (!unit.unit.empty()) text += " " + unit.unit;
  if (const auto known = truth.find(s.name); known != truth.end())
    text += fmt::format(" ({:+.1f} %)", 100.0 * (value / known->second - 1.0));
  return text;
}

std::string ErrorsText(const VariantResult& row, const RoleErrors& errors) {
  if (errors.trials == 0) return "-";
  if (errors.incomplete > 0) return fmt::format("{} fell", errors.incomplete);
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < errors.rmse.size(); ++c) {
    const std::string name(NameOf(row.fit.problem.channels[c].channel));
    parts.push_back(ErrorText(errors.rmse[c], ChannelUnit(*ChannelFromName(name))));
  }
  return Join(parts);
}

void PrintTable(const LawComparison& comparison, const std::map<std::string, double>& truth,
                Console& console) {
  using enum TextTable::Align;
  TextTable table({kLeft, kLeft, kLeft, kRight, kLeft});
  std::vector<std::string> channels;
  for (const ChannelProblem& c : comparison.rows.front().fit.problem.channels)
    channels.push_back(WithoutUnit(std::string(NameOf(c.channel))));
  table.AddRow({"model", "first value", "test error " + Join(channels), "chi2", ""});
  for (const VariantResult& row : comparison.rows) {
    if (!row.fit.result.ok) {
      table.AddRow({TextOf(row.variant), "no fit", "", "", row.fit.result.message});
      continue;
    }
    table.AddRow({TextOf(row.variant), ValueText(row, 0, truth), ErrorsText(row, row.test),
                  Significant(row.uncertainty.chi2_per_dof, 3),
                  row.fit.by_hop ? "hop by hop" : ""});
  }
  for (const std::string& line : table.Lines()) console.out << line << '\n';
  for (const VariantResult& row : comparison.rows) {
    std::vector<std::string> others;
    for (int k = 1; row.fit.result.ok && k < row.fit.problem.shared_count(); ++k)
      others.push_back(ValueText(row, k, truth));
    if (!others.empty()) console.out << "  " << TextOf(row.variant) << ": " << Join(others) << '\n';
    if (!row.fit.note.empty()) console.out << "    note: " << row.fit.note << '\n';
  }
}

Json RowRecord(const VariantResult& row) {
  const bool ok = row.fit.result.ok;
  Json parameters = Json::object(), test = Json::object();
  for (int k = 0; k < row.fit.problem.shared_count(); ++k)
    parameters[row.fit.problem.shared[k].name] =
        ok ? NumberOrNull(row.fit.result.shared[k]) : Json(nullptr);
  for (std::size_t c = 0; c < row.fit.problem.channels.size(); ++c)
    test[std::string(NameOf(row.fit.problem.channels[c].channel))] =
        ok ? NumberOrNull(row.test.rmse[c]) : Json(nullptr);
  return {{"law", row.variant.law},
          {"with", row.variant.with_effects},
          {"parameters", parameters},
          {"test_rmse", test},
          {"test_nll_per_sample", ok ? NumberOrNull(row.test.nll_per_sample) : Json(nullptr)},
          {"chi2_per_dof", ok ? NumberOrNull(row.uncertainty.chi2_per_dof) : Json(nullptr)},
          {"by_hop", row.fit.by_hop},
          {"note", row.fit.note},
          {"message", row.fit.result.message}};
}

ExitCode RunCompare(const CompareSettings& settings, Console& console) {
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const std::map<std::string, double> truth = ParseAssignments(settings.truth, "--true");
  FitOptions fit;
  fit.jobs = JobsOf(settings.problem.jobs);
  Progress progress(console, settings.quiet);
  progress.Stage("fitting each model");
  const std::vector<Variant> variants = VariantsOf(settings, dataset);
  const LawComparison comparison =
      CompareLaws(dataset, variants, ProblemOptionsOf(settings.problem), fit,
                  FitSpan::kWholeElseHops, [&](int done) {
                    progress.Step("fitting each model: " + std::to_string(done) + " of " +
                                      std::to_string(variants.size()),
                                  done, static_cast<long>(variants.size()));
                  });
  progress.Clear();
  if (!settings.json) {
    PrintTable(comparison, truth, console);
    return ExitCode::kDone;
  }
  RecordHeader header;
  header.command = "compare";
  header.dataset = dataset.name;
  Json record = NewRecord(header);
  record["rows"] = Json::array();
  for (const VariantResult& row : comparison.rows) record["rows"].push_back(RowRecord(row));
  console.out << hoplab::TextOf(record);
  return ExitCode::kDone;
}

void AddCompare(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<CompareSettings>();
  AddProblemOptions(sub, settings->problem);
  // A variant says both.
  for (const char* name : {"--law", "--with"}) sub.remove_option(sub.get_option(name));
  sub.add_option("--variant", settings->variants,
                 "A law, and effects to fit with it; repeatable (default: every law)")
      ->option_text("LAW+EFFECT...")
      ->allow_extra_args(false);
  sub.add_option("--true", settings->truth, "name=value known from elsewhere, to compare with")
      ->delimiter(',')
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false);
  OnParsed(sub, invocation, settings, RunCompare);
}

}  // namespace

namespace commands {
extern constexpr Command compare = {
    .place = 70,
    .name = "compare",
    .what = "Fit the same hops with every law of the leg",
    .footer =
        "Examples:\n"
        "  hoplab compare datasets/rig-drops --true E=21.991e9\n"
        "  hoplab compare my-hops --variant consistent\n"
        "  hoplab compare my-hops --variant large_deflection+leg_material_damping",
    .add = AddCompare};
}  // namespace commands
}  // namespace hoplab
