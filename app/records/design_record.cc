#include "app/records/design_record.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "app/records/csv.h"
#include "app/records/record_parts.h"
#include "app/terminal/quantity.h"
#include "base/nan.h"
#include "fitting/diagnosis/name.h"

namespace hoplab {
namespace {

double Bits(double nats) { return nats / std::numbers::ln2; }

double Shown(const TrialDesign& design, DesignSetting setting) {
  return ValueOf(design, setting) / InfoOf(setting).si;
}

Json SettingsRecord(const TrialDesign& design) {
  Json record = {{"like", design.like},
                 {"touchdown_angle_rad", NumberOrNull(design.touchdown_angle)},
                 {"height_m", NumberOrNull(design.height)},
                 {"speed_m_per_s", NumberOrNull(design.speed)},
                 {"kp_N_s", NumberOrNull(design.kp)},
                 {"added_mass_kg", NumberOrNull(design.added_mass)},
                 {"throw_m_per_s", NumberOrNull(design.throw_speed)}};
  if (std::isnan(design.pitch)) return record;
  record["pitch_rad"] = design.pitch;
  for (std::size_t leg = 0; leg < design.leg_angle.size(); ++leg)
    if (!std::isnan(design.leg_angle[leg]))
      record["leg_angle_" + std::to_string(leg + 1) + "_rad"] = design.leg_angle[leg];
  return record;
}

Json TriedRecord(const DesignRun& run, const DesignTried& tried) {
  Json record = {{"description", Describe(tried.design)},
                 {"settings", SettingsRecord(tried.design)},
                 {"fragile", tried.fragile},
                 {"by", tried.refitted ? "refits" : "linear forecast"}};
  if (run.separates) {
    record["worth_bits"] = NumberOrNull(Bits(tried.worth));
    record["entropy_left_bits"] = NumberOrNull(Bits(std::exp(tried.log_left)));
    record["expected_nats"] = NumberOrNull(tried.pair_nats);
    record["hardest_pair"] = {{"true", tried.pair_truth}, {"other", tried.pair_other}};
    record["separates"] = tried.pair_nats >= kIndistinguishable;
  } else {
    record["worth"] = NumberOrNull(tried.worth);
    record["half_width"] = NumberOrNull(tried.half_width);
  }
  return record;
}

Json SpaceRecord(const DesignRun& run) {
  Json out = Json::array();
  for (const DesignRange& range : run.space.ranges) {
    const DesignSettingInfo& info = InfoOf(range.setting);
    out.push_back({{"name", info.name},
                   {"column", info.column},
                   {"unit", info.unit},
                   {"low", range.low / info.si},
                   {"high", range.high / info.si}});
  }
  return out;
}

Json RivalsRecord(const DesignRun& run) {
  Json out = Json::array();
  for (std::size_t i = 0; i < run.rivals.size(); ++i) {
    const FittedModel& rival = run.rivals[i];
    Json values = Json::object();
    for (int k = 0; k < rival.problem.shared_count(); ++k)
      values[rival.problem.shared[static_cast<std::size_t>(k)].name] =
          NumberOrNull(rival.shared[k]);
    out.push_back({{"name", RivalName(rival)},
                   {"probability", NumberOrNull(run.probabilities[i])},
                   {"parameters", values}});
  }
  return out;
}

Json SharpenedRecord(const DesignRun& run) {
  const SharedParameter& s = run.Sharpened();
  return {{"name", s.name},
          {"unit", s.unit},
          {"value", NumberOrNull(run.model.shared[run.parameter])},
          {"half_width", NumberOrNull(run.search.before)}};
}

std::string OutcomeName(const DesignTried& tried) {
  return tried.failure ? tried.failure->Name() : "simulated";
}

Json OutcomesRecord(const DesignRun& run) {
  std::map<std::string, int> outcomes;
  for (const DesignTried& tried : run.search.tried) ++outcomes[OutcomeName(tried)];
  Json out = Json::object();
  for (const auto& [outcome, count] : outcomes) out[outcome] = count;
  return out;
}

void AddCells(const DesignRun& run, const DesignTried& tried, CsvText& csv) {
  if (run.separates) {
    const bool there = !tried.failure;
    csv.Cell(Bits(tried.worth)).Cell(there ? Bits(std::exp(tried.log_left)) : kNaN);
    csv.Cell(tried.pair_nats).Cell(tried.pair_truth).Cell(tried.pair_other);
  } else {
    csv.Cell(tried.worth).Cell(tried.half_width);
  }
  csv.Cell(OutcomeName(tried));
}

void AddHeader(const DesignRun& run, std::vector<std::string>& header) {
  if (run.separates)
    header.insert(header.end(), {"worth_bits", "entropy_left_bits", "expected_nats", "hardest_true",
                                 "hardest_other"});
  else
    header.insert(header.end(), {"worth", "half_width"});
  header.emplace_back("outcome");
}

std::string DesignsTable(const DesignRun& run) {
  std::vector<std::string> header;
  for (const DesignRange& range : run.space.ranges)
    header.emplace_back(InfoOf(range.setting).column);
  header.emplace_back("by");
  AddHeader(run, header);
  CsvText csv(header);
  const auto add = [&](const DesignTried& tried) {
    for (const DesignRange& range : run.space.ranges) csv.Cell(Shown(tried.design, range.setting));
    csv.Cell(tried.refitted ? "refits" : "linear");
    AddCells(run, tried, csv);
    csv.EndRow();
  };
  for (const DesignTried& tried : run.search.tried) add(tried);
  for (const DesignTried& tried : run.search.best) {
    if (tried.refitted) add(tried);
  }
  return csv.text();
}

std::string DesignMapTable(const DesignRun& run) {
  if (run.search.map.empty()) return "";
  std::vector<std::string> header = {"across", "up", "across_value", "up_value"};
  AddHeader(run, header);
  CsvText csv(header);
  for (const DesignMapPoint& point : run.search.map) {
    csv.Cell(InfoOf(point.across).column).Cell(InfoOf(point.up).column);
    csv.Cell(Shown(point.tried.design, point.across)).Cell(Shown(point.tried.design, point.up));
    AddCells(run, point.tried, csv);
    csv.EndRow();
  }
  return csv.text();
}

}  // namespace

std::string BitsText(double log_nats) {
  const double bits = Bits(std::exp(log_nats));
  return bits < 1e-3 ? "below 0.001 bits" : Significant(bits, 2) + " bits";
}

std::string DesignSentence(const DesignRun& run) {
  if (run.search.best.empty()) return "";
  const DesignTried& best = run.search.best.front();
  const std::string what = Describe(best.design);
  if (!run.separates) {
    const SharedParameter& s = run.Sharpened();
    const ReadableUnit unit = ReadableUnitOf(run.model.shared[run.parameter], s.unit);
    if (!std::isfinite(best.half_width))
      return fmt::format("No trial of this space determines {}.", s.name);
    return fmt::format(
        "Record a {}: the 95 % interval of {} is expected to shrink by {:.0f} %, to "
        "-+ {}{}.",
        what, s.name, std::floor(100.0 * best.worth), Significant(best.half_width * unit.factor, 2),
        unit.unit.empty() ? "" : " " + unit.unit);
  }
  const std::string doubt = fmt::format("from {} to {}", Significant(Bits(run.search.before), 2),
                                        BitsText(best.log_left));
  if (best.pair_nats < kIndistinguishable)
    return fmt::format(
        "No trial of this space would settle {}: the best, a {}, takes the doubt {}.",
        run.RivalNames(), what, doubt);
  return fmt::format("Record a {}: it is expected to take the doubt between {} {}.", what,
                     run.RivalNames(), doubt);
}

Json DesignRecord(const Dataset& dataset, const std::string& dataset_argument,
                  const DesignRunOptions& options, const DesignRun& run) {
  RecordHeader header;
  header.command = "design";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(run.problem.law));
  header.reading = dataset.mechanism.reading;
  header.seed = options.fit.seed;
  header.options =
      OptionsRecord(run.problem, {dataset_argument, &options.problem, &options.fit, options.span});
  header.options["cause"] = options.causes;
  header.options["sharpen"] = options.sharpen.empty() ? Json(nullptr) : Json(options.sharpen);
  header.options["budget"] = options.budget;
  header.options["map"] = options.map_size;
  Json record = NewRecord(header);
  if (!run.failure.empty()) SetFailed(record, run.failure);
  if (run.interrupted) SetFailed(record, "interrupted; the designs are the best of those tried");
  const std::string sentence = DesignSentence(run);
  record["sentence"] = sentence.empty() ? Json(nullptr) : Json(sentence);
  record["task"] = run.separates ? "separate" : "sharpen";
  record["decision"] = run.decision.empty() ? Json(nullptr) : Json(run.decision);
  record["rivals"] = RivalsRecord(run);
  const bool searched = !run.search.tried.empty();
  record["entropy_bits"] =
      run.separates && searched ? NumberOrNull(Bits(run.search.before)) : Json(nullptr);
  record["even_odds"] = run.separates ? Json(run.even_odds) : Json(nullptr);
  record["sharpened"] = !run.separates && searched ? SharpenedRecord(run) : Json(nullptr);
  record["space"] = SpaceRecord(run);
  const std::vector<double>& rows = run.space.like.row_times;
  record["like"] = run.space.like.file;
  record["duration_s"] = rows.empty() ? Json(nullptr) : NumberOrNull(rows.back());
  Json designs = Json::array();
  for (const DesignTried& tried : run.search.best) designs.push_back(TriedRecord(run, tried));
  record["designs"] = designs;
  record["designs_tried"] = run.search.tried.size();
  record["outcomes"] = OutcomesRecord(run);
  record["left"] = LeftRecord(run.separates && !run.rivals.empty() ? run.rivals.front().problem
                                                                   : run.model.problem);
  record["notes"] = run.notes;
  record["interrupted"] = run.interrupted;
  record["tools"] = ToolsRecord();
  return record;
}

std::map<std::string, std::string> DesignTables(const DesignRun& run) {
  std::map<std::string, std::string> tables;
  if (!run.search.tried.empty()) tables["designs.csv"] = DesignsTable(run);
  if (!run.search.map.empty()) tables["map.csv"] = DesignMapTable(run);
  return tables;
}

}  // namespace hoplab
