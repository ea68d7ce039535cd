#include "app/records/discovery_record.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/records/csv.h"
#include "app/records/diagnosis_parts.h"
#include "app/records/diagnosis_tables.h"
#include "app/records/discovery_words.h"
#include "app/records/formula_words.h"
#include "app/records/record_parts.h"
#include "fitting/discovery/free_curve.h"

namespace hoplab {
namespace {

Json IntervalOf(const std::optional<std::pair<double, double>>& ci) {
  return ci ? Json::array({NumberOrNull(ci->first), NumberOrNull(ci->second)}) : Json(nullptr);
}

Json ValueRecord(const FoundValue& v) {
  return {{"name", v.name},
          {"value", NumberOrNull(v.value)},
          {"ci95", IntervalOf(v.ci95)},
          {"unit", v.unit}};
}

Json FormulasOf(const std::vector<const Effect*>& effects) {
  Json out = Json::array();
  for (const Effect* e : effects)
    out.push_back({{"acts_as", SourceOf(*e)->acts_as}, {"formula", SourceOf(*e)->formula}});
  return out;
}

Json TermRecord(const FoundTerm& found, std::size_t place) {
  Json parameters = Json::array();
  for (const FoundValue& v : found.values) parameters.push_back(ValueRecord(v));
  Json exponent = nullptr;
  if (found.exponent) {
    exponent = ValueRecord(found.exponent->value);
    exponent["taken"] = found.exponent->taken;
    exponent["gain_nats"] = NumberOrNull(found.exponent->gain);
  }
  const Effect& effect = FormulaEffect(found.source);
  return {{"acts_as", found.source.acts_as},
          {"formula", found.source.formula},
          {"mathml", MathMlOf(*effect.formula)},
          {"words", WordsOf(found)},
          {"sizes", SizesOf(found)},
          {"physics", PhysicsOf(found)},
          {"parameters", parameters},
          {"exponent", exponent},
          {"share", NumberOrNull(found.share)},
          {"selected_in", found.selected_in ? Json(*found.selected_in) : Json(nullptr)},
          {"equal", FormulasOf(found.equal)},
          {"free", found.free_curve ? ForceRecord(*found.free_curve) : Json(nullptr)},
          {"file", DiscoveredFile(place)}};
}

Json AlternativesRecord(const Discovery& d) {
  Json out = Json::array();
  for (const FoundTerm& found : d.found) {
    const auto add = [&](const std::vector<const Effect*>& effects, const char* why) {
      for (const Effect* e : effects)
        out.push_back({{"acts_as", SourceOf(*e)->acts_as},
                       {"formula", SourceOf(*e)->formula},
                       {"in_place_of", found.source.formula},
                       {"why", why}});
    };
    add(found.equal, "the data cannot tell them apart");
    add(found.as_good, "does as well");
  }
  return out;
}

Json RmseOf(const FitProblem& problem, const HeldOutErrors& errors) {
  return errors.test.trials > 0 ? ByChannel(problem, errors.test.rmse) : Json(nullptr);
}

// A term over its first variable, the others at their natural sizes.
void AddCurve(const FoundTerm& found, std::size_t place, const NaturalScales& scales,
              CsvText& csv) {
  if (found.term.variables.empty() || found.values.empty()) return;
  const Effect& effect = FormulaEffect(found.source);
  const PlaceInfo& info = InfoOf(effect.formula->place());
  const std::string& name = found.term.variables.front();
  const VariableInfo* variable = FindVariable(info, name);
  if (variable == nullptr) return;
  const Extent over = DrawnOver(*variable, scales);
  constexpr int kPoints = 241;  // some twenty for each period of a vibration
  for (int i = 0; i < kPoints; ++i) {
    const double at = over.least + (over.most - over.least) * i / (kPoints - 1);
    const auto with = [&](double c) { return FormulaAt(effect, name, at, c, scales); };
    const FoundValue& c = found.values.front();
    csv.Cell(DiscoveredFile(place)).Cell(found.source.acts_as).Cell(name).Cell(at);
    csv.Cell(with(c.value));
    csv.Cell(c.ci95 ? with(c.ci95->first) : std::numeric_limits<double>::quiet_NaN());
    csv.Cell(c.ci95 ? with(c.ci95->second) : std::numeric_limits<double>::quiet_NaN()).EndRow();
  }
}

}  // namespace

std::string FailureOf(const Discovery& d) {
  if (d.base.interrupted) return "interrupted before there was a verdict";
  return d.base.refusal;
}

Json DiscoveryPart(const Discovery& d) {
  Json out = Json::object();
  Json discovered = Json::array();
  for (std::size_t i = 0; i < d.found.size(); ++i) discovered.push_back(TermRecord(d.found[i], i));
  const bool decided = FailureOf(d).empty();
  out["discovered"] = discovered;
  out["in_place_of_causes"] = d.in_place_of_causes;
  out["alternatives"] = AlternativesRecord(d);
  const bool measured = !d.base.before.trials.empty();
  out["held_out"] = {
      {"before", measured ? RmseOf(d.base.problem, d.base.before) : Json(nullptr)},
      {"after", d.found.empty() ? Json(nullptr) : RmseOf(d.naming.best.problem, d.after)},
      {"gain", d.found.empty() ? Json(nullptr)
                               : Json{{"nats_per_sample", NumberOrNull(d.gain.nats_per_sample)},
                                      {"ci95", IntervalOf(d.gain.ci95)}}}};
  out["verdict"] = decided ? Json(NameOf(d.verdict)) : Json(nullptr);
  out["reason"] = d.reason;
  out["library"] = d.library;
  out["free_forces"] = ForcesRecord(d.free_forces);
  return out;
}

Json DiscoveryRecord(const Dataset& dataset, const std::string& dataset_argument,
                     const DiagnosisOptions& options, const Discovery& d) {
  RecordHeader header;
  header.command = "discover";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(d.base.problem.law));
  header.reading = dataset.mechanism.reading;
  header.seed = options.fit.seed;
  header.options = OptionsRecord(d.base.problem,
                                 {dataset_argument, &options.problem, &options.fit, options.span});
  Json record = NewRecord(header);
  if (const std::string failure = FailureOf(d); !failure.empty()) SetFailed(record, failure);
  record.update(DiscoveryPart(d));
  record["detection"] = {{"p_value", NumberOrNull(d.base.detection.p_value)}};
  const bool extended = !d.found.empty();
  record["parameters"] =
      extended ? ParametersRecord({&d.naming.best.problem, &d.naming.best.shared, &d.uncertainty})
               : Json::array();
  record["test_before"] =
      d.base.before.trials.empty() ? Json(nullptr) : HeldOutRecord(d.base.problem, d.base.before);
  record["test_after"] = extended ? HeldOutRecord(d.naming.best.problem, d.after) : Json(nullptr);
  record["channels"] = ChannelsRecord(d.base.problem);
  record["trace_faults"] = TraceFaultsRecord(d.base.problem, dataset);
  record["known"] = KnownRecord(d.base.problem);
  record["refits"] = d.naming.refits;
  RecordSpan(d.base.by_hop, d.base.until, record);
  record["notes"] = d.base.notes;
  record["interrupted"] = d.base.interrupted;
  record["tools"] = ToolsRecord();
  return record;
}

std::map<std::string, std::string> DiscoveryFiles(const Discovery& d) {
  std::map<std::string, std::string> files;
  if (!d.base.before.trials.empty())
    files["residuals.csv"] = ResidualsTable(d.base, d.found.empty() ? nullptr : &d.after);
  if (d.found.empty()) return files;
  std::vector<Candidate> terms;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < d.found.size(); ++i) {
    terms.emplace_back(d.found[i].term.effect);
    names.push_back(WrittenSource(d.found[i], i).name);
  }
  files["evidence.csv"] = EvidenceTable(d.base.null, terms, names);
  CsvText curves({"file", "acts_as", "variable", "at", "value", "low", "high"});
  const NaturalScales scales = ScalesOf(d.base.problem);
  for (std::size_t i = 0; i < d.found.size(); ++i) {
    AddCurve(d.found[i], i, scales, curves);
    files[DiscoveredFile(i)] = EffectFileText(
        WrittenSource(d.found[i], i), std::string(NameOf(d.verdict)) + ": " + SizesOf(d.found[i]) +
                                          "; typical is the size found");
  }
  files["discovered.csv"] = curves.text();
  return files;
}

}  // namespace hoplab
