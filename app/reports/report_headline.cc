#include "app/reports/report_headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "app/records/sweep_record.h"
#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr const char* kNotComputed = "not computed";

// What stands at a pointer of the record; null where it ends before.
const Json& At(const Json& record, const std::string& pointer) {
  static const Json kNull = nullptr;
  const Json::json_pointer path(pointer);
  return record.contains(path) ? record.at(path) : kNull;
}

double NumberAt(const Json& record, const std::string& pointer) {
  const Json& value = At(record, pointer);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string TextAt(const Json& record, const std::string& pointer) {
  const Json& value = At(record, pointer);
  return value.is_string() ? value.get<std::string>() : "";
}

std::size_t SizeAt(const Json& record, const std::string& pointer) {
  const Json& value = At(record, pointer);
  return value.is_structured() ? value.size() : 0;
}

// A key as part of a pointer.
std::string Escaped(const std::string& key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

HeadlineFigure Figure(const Json& record, const std::string& label, const std::string& pointer,
                      const std::string& unit, int digits = 4) {
  HeadlineFigure figure{label, kNotComputed, "", "", pointer};
  const double value = NumberAt(record, pointer);
  if (std::isnan(value)) return figure;
  const ReadableUnit readable = ReadableUnitOf(value, unit);
  const bool whole = At(record, pointer).is_number_integer();
  figure.value = whole ? std::to_string(At(record, pointer).get<long>())
                       : Significant(value * readable.factor, digits);
  figure.unit = readable.unit;
  return figure;
}

HeadlineFigure CountFigure(const std::string& label, const std::string& value,
                           const std::string& pointer) {
  return {label, value, "", "", pointer};
}

// "a", "a and b", "a, b and c".
std::string Listed(const std::vector<std::string>& words) {
  if (words.size() < 2) return Join(words);
  return Join({words.begin(), words.end() - 1}) + " and " + words.back();
}

std::string UnitOfChannel(const std::string& channel) {
  if (channel.ends_with("_m_per_s2")) return "m/s^2";
  if (channel.ends_with("_m_per_s")) return "m/s";
  if (channel.ends_with("_N_m")) return "N m";
  if (channel.ends_with("_rad")) return "rad";
  if (channel.ends_with("_m")) return "m";
  if (channel.ends_with("_N")) return "N";
  return "";
}

// The channel that is furthest off, in units of its noise; empty if no error was computed.
std::string WorstChannel(const Json& record, const std::string& errors) {
  std::string worst;
  double most = -1.0;
  for (const auto& [name, value] : At(record, errors).items()) {
    if (!value.is_number()) continue;
    double sigma = 1.0;
    for (const Json& channel : At(record, "/channels")) {
      const double stated = NumberAt(channel, "/sigma");
      if (TextAt(channel, "/name") == name && stated > 0.0) sigma = stated;
    }
    if (value.get<double>() / sigma > most) {
      most = value.get<double>() / sigma;
      worst = name;
    }
  }
  return worst;
}

HeadlineFigure ErrorFigure(const Json& record, const std::string& what, const std::string& errors,
                           const std::string& worst_in = "") {
  const std::string channel = WorstChannel(record, worst_in.empty() ? errors : worst_in);
  if (channel.empty()) return {what, kNotComputed, "", "", errors};
  HeadlineFigure figure = Figure(record, what + ", " + WithoutUnit(channel),
                                 errors + "/" + Escaped(channel), UnitOfChannel(channel), 3);
  if (UnitOfChannel(channel) == "m") {  // as the tables say it
    const std::string text = ErrorText(NumberAt(record, figure.pointer), "m");
    figure.value = text.substr(0, text.find(' '));
    figure.unit = "mm";
  }
  return figure;
}

// The interval that counts: between trials where the model misses more than the noise.
std::string IntervalNote(const Json& record, const Json& parameter) {
  const bool misfit = At(record, "/misfit").is_boolean() && At(record, "/misfit").get<bool>();
  const bool between = misfit && At(parameter, "/ci95_between_trials").is_array();
  const std::string key = between ? "/ci95_between_trials" : "/ci95";
  const double low = NumberAt(parameter, key + "/0"), high = NumberAt(parameter, key + "/1");
  if (std::isnan(low) || std::isnan(high)) return "no interval";
  const ReadableUnit unit =
      ReadableUnitOf(NumberAt(parameter, "/value"), TextAt(parameter, "/unit"));
  const int decimals = DecimalsFor(0.5 * (high - low) * unit.factor);
  return fmt::format("95 %{}: {} to {}", between ? " between trials" : "",
                     Fixed(low * unit.factor, decimals), Fixed(high * unit.factor, decimals));
}

// "E = 22.98 GPa".
std::string ParameterText(const Json& parameter) {
  const double value = NumberAt(parameter, "/value");
  const std::string name = TextAt(parameter, "/name");
  if (std::isnan(value)) return name + " undetermined";
  const ReadableUnit unit = ReadableUnitOf(value, TextAt(parameter, "/unit"));
  return name + " = " + Significant(value * unit.factor, 4) +
         (unit.unit.empty() ? "" : " " + unit.unit);
}

void FitHeadline(const Json& record, Headline& out) {
  std::vector<std::string> values;
  for (const Json& parameter : At(record, "/parameters")) {
    if (values.size() < 4) values.push_back(ParameterText(parameter));
  }
  const bool held_out = !WorstChannel(record, "/test/rmse").empty();
  const std::string errors = held_out ? "/test/rmse" : "/train/rmse";
  std::vector<std::string> misses;
  for (const auto& [name, value] : At(record, errors).items()) {
    if (value.is_number())
      misses.push_back(WithoutUnit(name) + " within " +
                       ErrorText(value.get<double>(), UnitOfChannel(name)));
  }
  out.sentence = Listed(values);
  if (!misses.empty())
    out.sentence +=
        fmt::format(" reproduce{} {} of {}", values.size() == 1 ? "s" : "", Listed(misses),
                    held_out ? "trials that were not fitted" : "the fitted trials");
  const Json& misfit = At(record, "/misfit");
  if (misfit.is_boolean())
    out.sentence += misfit.get<bool>() ? "; the model misses more than the noise."
                                       : "; what is left looks like noise.";
  const Json& first = At(record, "/parameters/0");
  out.figures.push_back(
      Figure(record, TextAt(first, "/name"), "/parameters/0/value", TextAt(first, "/unit")));
  out.figures.back().note = IntervalNote(record, first);
  out.figures.push_back(ErrorFigure(record, held_out ? "test error" : "train error", errors));
  out.figures.push_back(Figure(record, "chi² per sample", "/chi2_per_dof", "", 3));
  out.figures.back().note = "1 if only noise were left";
}

void CheckHeadline(const Json& record, Headline& out) {
  const std::size_t warnings = SizeAt(record, "/warnings");
  const std::size_t parameters = SizeAt(record, "/parameters");
  const double rank = NumberAt(record, "/identifiability/rank");
  const bool all = rank == static_cast<double>(parameters) &&
                   SizeAt(record, "/identifiability/weak_directions") == 0;
  out.sentence = warnings == 0   ? "Nothing looks odd in these traces"
                 : warnings == 1 ? "One thing looks odd in these traces"
                                 : fmt::format("{} things look odd in these traces", warnings);
  out.sentence += std::isnan(rank) ? "; what they determine was not computed."
                  : all            ? ", and they determine every parameter asked for."
                                   : "; not every parameter asked for is well determined.";
  out.figures.push_back(
      CountFigure("trials", std::to_string(SizeAt(record, "/trials")), "/trials"));
  out.figures.push_back(
      Figure(record, "condition number", "/identifiability/condition_number", "", 3));
  out.figures.push_back(
      Figure(record, "derivatives agree to", "/gradient_check/max_relative_error", "", 3));
}

void DiagnosisHeadline(const Json& record, Headline& out) {
  out.sentence = TextAt(record, "/sentence");
  const std::string verdict = TextAt(record, "/verdict");
  if (out.sentence.empty()) out.sentence = "Verdict: " + verdict + ".";
  const std::size_t tried = SizeAt(record, "/candidates");
  const std::string causes = tried == 1 ? "1 cause tried" : std::to_string(tried) + " causes tried";
  if (!At(record, "/extension").is_object()) {
    out.figures.push_back(Figure(record, "chance of such a misfit", "/detection/p_value", "", 2));
    out.figures.back().note = "under noise alone";
    out.figures.push_back(ErrorFigure(record, "test error", "/null/test/rmse"));
    out.figures.push_back(Figure(record, "chi² per sample", "/null/chi2_per_dof", "", 3));
    out.figures.back().note = causes;
    return;
  }
  const double explained = NumberAt(record, "/extension/explained");
  out.figures.push_back({"of the misfit explained", kNotComputed, "", "", "/extension/explained"});
  if (!std::isnan(explained)) {
    out.figures.back().value = Significant(std::floor(1e3 * explained) / 10.0, 3);  // not up to all
    out.figures.back().unit = "%";
  }
  out.figures.back().note = causes;
  const std::string channel = WorstChannel(record, "/null/test/rmse");
  HeadlineFigure after = ErrorFigure(
      Json{{"channels", At(record, "/channels")},
           {"rmse", {{channel, At(record, "/extension/test_after/rmse/" + Escaped(channel))}}}},
      "test error", "/rmse");
  after.pointer = "/extension/test_after/rmse/" + Escaped(channel);
  const std::string unit = UnitOfChannel(channel);
  after.note = ErrorText(NumberAt(record, "/null/test/rmse/" + Escaped(channel)), unit) + " before";
  out.figures.push_back(after);
  out.figures.push_back(Figure(record, "gained on held-out trials",
                               "/extension/heldout_gain/nats_per_sample", "nats a sample", 3));
  const double low = NumberAt(record, "/extension/heldout_gain/ci95/0");
  const double high = NumberAt(record, "/extension/heldout_gain/ci95/1");
  out.figures.back().note = std::isnan(low)
                                ? "too few hops for an interval"
                                : "95 %: " + Significant(low, 3) + " to " + Significant(high, 3);
}

std::string HowItDecays(double radius, const char* turn) {
  return fmt::format(
      " and is stable: a disturbance keeps {} % of its size from {} to "
      "{}, once the slowest part of it is left.",
      Significant(100.0 * radius, 3), turn, turn);
}

// Of a robot's stride.
void StrideHeadline(const Json& record, Headline& out) {
  const double radius = NumberAt(record, "/spectral_radius");
  const std::string kind = TextAt(record, "/stride/kind");
  if (kind.empty()) {
    out.sentence = "No steady stride was found near the robot's run.";
    return;
  }
  out.sentence = fmt::format("The robot's steady stride is a {} at {} m/s", kind,
                             Significant(NumberAt(record, "/stride/speed_m_per_s"), 3));
  out.sentence += At(record, "/stable") == Json(true) ? HowItDecays(radius, "stride")
                                                      : " and is unstable: a disturbance grows.";
  out.figures.push_back(Figure(record, "spectral radius", "/spectral_radius", ""));
  out.figures.back().note = "stable below 1";
  out.figures.push_back(Figure(record, "speed", "/stride/speed_m_per_s", "m/s"));
  out.figures.push_back(Figure(record, "cost of transport", "/stride/cost_of_transport", ""));
  out.figures.back().note = "work of the motors over weight times way";
}

void GaitHeadline(const Json& record, Headline& out) {
  if (record.contains("stride")) {
    StrideHeadline(record, out);
    return;
  }
  const double speed = NumberAt(record, "/fixed_point/vx_m_per_s");
  const double height = NumberAt(record, "/fixed_point/y_m");
  const double radius = NumberAt(record, "/spectral_radius");
  const bool stable = At(record, "/stable") == Json(true);
  const bool neutral = At(record, "/conserves_energy") == Json(true);
  out.sentence = fmt::format("The steady hop goes {} m/s with its apex at {} m",
                             Significant(speed, 3), Significant(height, 3));
  if (neutral)
    out.sentence += "; energy is conserved, so a change of it stays.";
  else if (stable)
    out.sentence += HowItDecays(radius, "hop");
  else
    out.sentence += " and is unstable: a disturbance grows.";
  out.figures.push_back(Figure(record, "spectral radius", "/spectral_radius", ""));
  out.figures.back().note = neutral ? "1 is the energy's" : "stable below 1";
  out.figures.push_back(Figure(record, "speed at apex", "/fixed_point/vx_m_per_s", "m/s"));
  out.figures.push_back(Figure(record, "hops into 1 % of it", "/predicted_hops", ""));
  out.figures.back().note = "from the scenario's start";
}

// "touchdown_angle = 23.04 deg" of touchdown_angle_deg.
std::string SettingText(const std::string& key, const Json& value) {
  const std::string unit = UnitOfKey(key), name = key.substr(key.rfind('.') + 1);
  const std::string number = value.is_number() ? Significant(value.get<double>(), 4) : kNotComputed;
  if (unit.empty()) return name + " = " + number;
  std::string suffix = "_" + unit;
  std::replace(suffix.begin(), suffix.end(), ' ', '_');
  return (name.ends_with(suffix) ? name.substr(0, name.size() - suffix.size()) : name) + " = " +
         number + " " + unit;
}

void OptimizeHeadline(const Json& record, Headline& out) {
  std::vector<std::string> values;
  for (const auto& [name, value] : At(record, "/best/parameters").items())
    values.push_back(SettingText(name, value));
  const double settle = NumberAt(record, "/best/convergence_time_s");
  const double before = NumberAt(record, "/before/convergence_time_s");
  out.sentence = "Best found: " + Listed(values);
  if (!std::isnan(settle))
    out.sentence += fmt::format(", which settles after {} s (before: {})", Significant(settle, 3),
                                std::isnan(before) ? "not at all" : Significant(before, 3) + " s");
  out.sentence += ".";
  if (!std::isnan(settle))
    out.figures.push_back(Figure(record, "convergence time", "/best/convergence_time_s", "s"));
  else
    out.figures.push_back(Figure(record, "objective", "/best/objective", ""));
  out.figures.push_back(Figure(record, "spectral radius", "/best/spectral_radius", ""));
  const double radius = NumberAt(record, "/before/spectral_radius");
  out.figures.back().note = std::isnan(radius) ? "before: " + std::string(kNotComputed)
                                               : "before: " + Significant(radius, 4);
  out.figures.push_back(Figure(record, "seeds that agree", "/agreeing_seeds", ""));
  out.figures.back().note = "of " + std::to_string(SizeAt(record, "/seeds"));
}

void SweepHeadline(const Json& record, Headline& out) {
  const Json& columns = At(record, "/columns");
  std::size_t outcome = columns.size();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (TextAt(columns[c], "/name") == "outcome") outcome = c;
  }
  std::size_t completed = 0;
  const Json& rows = At(record, "/rows");
  for (const Json& row : rows) {
    // A row without a reason reached its end.
    if (row.is_array() && outcome + 1 < row.size() && row[outcome + 1].is_null()) ++completed;
  }
  out.sentence = fmt::format("{} of {} runs reached their end{}.", completed, rows.size(),
                             completed < rows.size() ? "; the others say why they did not" : "");
  out.figures.push_back(CountFigure("runs", std::to_string(rows.size()), "/rows"));
  out.figures.push_back(CountFigure("reached their end", std::to_string(completed), "/rows"));
  out.figures.push_back(Figure(record, "computed in", "/seconds", "s", 3));
}

void SimulationHeadline(const Json& record, Headline& out) {
  out.sentence =
      fmt::format("The hopper {}: {} hops in {} s.", TextAt(record, "/outcome_sentence"),
                  At(record, "/hops").dump(), Significant(NumberAt(record, "/end_time_s"), 4));
  out.figures.push_back(Figure(record, "hops", "/hops", ""));
  out.figures.push_back(Figure(record, "ended at", "/end_time_s", "s"));
  const std::size_t apexes = SizeAt(record, "/apex_energies");
  if (apexes == 0) return;
  out.figures.push_back(Figure(record, "energy at the last apex",
                               fmt::format("/apex_energies/{}/energy_J", apexes - 1), "J"));
  const double first = NumberAt(record, "/apex_energies/0/energy_J");
  out.figures.back().note = Significant(first, 4) + " J at the start";
}

// How many of a list have the verdict "reproduced", of how many.
HeadlineFigure ReproducedFigure(const Json& record, const std::string& label,
                                const std::string& pointer) {
  std::size_t reproduced = 0;
  for (const Json& part : At(record, pointer))
    reproduced += TextAt(part, "/verdict") == "reproduced" ? 1 : 0;
  return {label, std::to_string(reproduced), "", "of " + std::to_string(SizeAt(record, pointer)),
          pointer};
}

void ReproductionHeadline(const Json& record, Headline& out) {
  const HeadlineFigure claims = ReproducedFigure(record, "claims reproduced", "/claims");
  const HeadlineFigure tables = ReproducedFigure(record, "tables reproduced", "/tables");
  out.sentence = TextAt(record, "/sentence");
  if (out.sentence.empty()) {
    std::vector<std::string> parts;
    if (SizeAt(record, "/claims") > 0)
      parts.push_back(claims.value + " " + claims.note + " claims of the study");
    if (SizeAt(record, "/tables") > 0)
      parts.push_back(tables.value + " " + tables.note + " of its tables");
    out.sentence = parts.empty() ? "The study was run anew."
                                 : Listed(parts) + " are reproduced with its own settings.";
  }
  out.figures = {
      claims, tables,
      CountFigure("figures drawn anew", std::to_string(SizeAt(record, "/figures")), "/figures")};
}

void DesignHeadline(const Json& record, Headline& out) {
  out.sentence = TextAt(record, "/sentence");
  if (TextAt(record, "/task") == "sharpen") {
    const std::string unit = TextAt(record, "/sharpened/unit");
    out.figures.push_back(Figure(record, "half width now", "/sharpened/half_width", unit));
    out.figures.push_back(Figure(record, "expected after it", "/designs/0/half_width", unit));
  } else {
    out.figures.push_back(Figure(record, "doubt now", "/entropy_bits", "bits"));
    out.figures.push_back(
        Figure(record, "expected after it", "/designs/0/entropy_left_bits", "bits"));
  }
  out.figures.push_back(Figure(record, "designs tried", "/designs_tried", ""));
}

void DiscoveryHeadline(const Json& record, Headline& out) {
  const std::string verdict = TextAt(record, "/verdict");
  const std::string words = TextAt(record, "/discovered/0/words");
  out.sentence = verdict == "found"        ? "Found: " + words + "."
                 : verdict == "not_needed" ? "No formula is needed."
                 : verdict.empty()         ? TextAt(record, "/message")
                                           : "No formula is stable.";
  out.figures.push_back(Figure(record, "chance of such a misfit", "/detection/p_value", "", 2));
  out.figures.back().note = "under noise alone";
  out.figures.push_back(ErrorFigure(record, "test error before", "/held_out/before"));
  out.figures.push_back(
      ErrorFigure(record, "test error after", "/held_out/after", "/held_out/before"));
}

void ComparisonHeadline(const Json& record, Headline& out) {
  std::vector<std::string> names;
  for (const Json& run : At(record, "/runs")) names.push_back(TextAt(run, "/name"));
  out.title = "Comparison of " + Listed(names);
  out.sentence = TextAt(record, "/sentence");
  if (names.empty()) return;
  const std::size_t last = names.size() - 1;
  // The value that changed most for its interval; where none has one, the first.
  std::size_t most = 0;
  double size = -1.0;
  for (std::size_t i = 0; i < SizeAt(record, "/values"); ++i) {
    const double z = std::abs(NumberAt(record, fmt::format("/values/{}/runs/{}/z", i, last)));
    if (z > size) {
      size = z;
      most = i;
    }
  }
  const std::string value = fmt::format("/values/{}", most);
  const std::string own = fmt::format("{}/runs/{}", value, last);
  out.figures.push_back(Figure(record, "change of " + TextAt(record, value + "/name"),
                               own + "/difference", TextAt(record, value + "/unit"), 3));
  out.figures.back().note =
      size < 0.0 ? "no interval"
                 : fmt::format("z = {}", Significant(NumberAt(record, own + "/z"), 2));
  out.figures.push_back(Figure(record, "clear changes", "/clear_changes", ""));
  out.figures.back().note = fmt::format("of {} values", SizeAt(record, "/values"));
  const std::string errors = fmt::format("/errors/0/values/{}", last);
  const std::string channel = TextAt(record, "/errors/0/channel");
  const std::string what = TextAt(record, "/errors/0/what"),
                    unit = TextAt(record, "/errors/0/unit");
  HeadlineFigure error =
      Figure(record, what + (channel.empty() ? "" : ", ") + WithoutUnit(channel), errors, unit, 3);
  if (unit == "m") {  // as the tables say it
    const std::string text = ErrorText(NumberAt(record, errors), unit);
    error.value = text.substr(0, text.find(' '));
    error.unit = "mm";
  }
  error.note = "was " + ErrorText(NumberAt(record, "/errors/0/values/0"), unit);
  out.figures.push_back(error);
}

struct Kind {
  const char* command;
  const char* title;
  void (*fill)(const Json&, Headline&);
};
constexpr std::array<Kind, 11> kKinds = {{{"check", "Check", CheckHeadline},
                                          {"fit", "Fit", FitHeadline},
                                          {"diagnose", "Diagnosis", DiagnosisHeadline},
                                          {"discover", "Formula", DiscoveryHeadline},
                                          {"design", "Trial to record next", DesignHeadline},
                                          {"gait", "Gait", GaitHeadline},
                                          {"optimize", "Optimisation", OptimizeHeadline},
                                          {"sweep", "Sweep", SweepHeadline},
                                          {"simulate", "Simulation", SimulationHeadline},
                                          {"report", "Comparison", ComparisonHeadline},
                                          {"reproduce", "Reproduction", ReproductionHeadline}}};

}  // namespace

Headline HeadlineOf(const Json& record) {
  Headline out;
  const std::string command = TextAt(record, "/command");
  std::string subject = TextAt(record, "/dataset");
  if (subject.empty()) subject = TextAt(record, "/scenario");
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [&](const Kind& k) { return command == k.command; });
  const bool known = kind != kKinds.end();
  out.title =
      (known ? kind->title : "hoplab " + command) + (subject.empty() ? "" : " of ") + subject;
  const bool failed = TextAt(record, "/status") == "failed";
  if (known) kind->fill(record, out);
  if (out.sentence.empty()) out.sentence = out.title + ".";
  if (failed) {  // an interrupted run may have a result all the same
    const std::string message = TextAt(record, "/message");
    out.sentence = message.empty() ? "The run failed." : message + ".";
  }
  return out;
}

}  // namespace hoplab
