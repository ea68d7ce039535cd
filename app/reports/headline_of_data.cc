#include <fmt/format.h>

#include <cmath>

#include "app/reports/headline_parts.h"
#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

double WidthOf(const Json& parameter, const std::string& key) {
  return NumberAt(parameter, key + "/1") - NumberAt(parameter, key + "/0");
}

// The wider interval, where the model misses more than the noise: trials may differ by more than
// the discrepancy says, and may share an error that does not show between them.
std::string IntervalNote(const Json& record, const Json& parameter) {
  const bool misfit =
      JsonAt(record, "/misfit").is_boolean() && JsonAt(record, "/misfit").get<bool>();
  const bool between = misfit && JsonAt(parameter, "/ci95_between_trials").is_array() &&
                       !(WidthOf(parameter, "/ci95") > WidthOf(parameter, "/ci95_between_trials"));
  const std::string key = between ? "/ci95_between_trials" : "/ci95";
  const double low = NumberAt(parameter, key + "/0"), high = NumberAt(parameter, key + "/1");
  if (std::isnan(low) || std::isnan(high)) return "no interval";
  const ReadableUnit unit =
      ReadableUnitOf(NumberAt(parameter, "/value"), TextAt(parameter, "/unit"));
  const int decimals = DecimalsFor(0.5 * (high - low) * unit.factor);
  return fmt::format("95 %{}: {} to {}", between ? " between trials" : "",
                     FixedOrMore(low * unit.factor, decimals),
                     FixedOrMore(high * unit.factor, decimals));
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

}  // namespace

void FitHeadline(const Json& record, Headline& out) {
  std::vector<std::string> values;
  for (const Json& parameter : JsonAt(record, "/parameters")) {
    if (values.size() < 4) values.push_back(ParameterText(parameter));
  }
  const bool held_out = !WorstChannel(record, "/test/rmse").empty();
  const std::string errors = held_out ? "/test/rmse" : "/train/rmse";
  std::vector<std::string> misses;
  for (const auto& [name, value] : JsonAt(record, errors).items()) {
    if (value.is_number())
      misses.push_back(WithoutUnit(name) + " within " +
                       ErrorText(value.get<double>(), UnitOfChannel(name)));
  }
  out.sentence = Listed(values);
  if (!misses.empty())
    out.sentence +=
        fmt::format(" reproduce{} {} of {}", values.size() == 1 ? "s" : "", Listed(misses),
                    held_out ? "trials that were not fitted" : "the fitted trials");
  const Json& misfit = JsonAt(record, "/misfit");
  if (misfit.is_boolean())
    out.sentence += misfit.get<bool>() ? "; the model misses more than the noise."
                                       : "; what is left looks like noise.";
  const Json& first = JsonAt(record, "/parameters/0");
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
  if (!JsonAt(record, "/extension").is_object()) {
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
      Json{{"channels", JsonAt(record, "/channels")},
           {"rmse",
            {{channel, JsonAt(record, "/extension/test_after/rmse/" + PointerKey(channel))}}}},
      "test error", "/rmse");
  after.pointer = "/extension/test_after/rmse/" + PointerKey(channel);
  const std::string unit = UnitOfChannel(channel);
  after.note =
      ErrorText(NumberAt(record, "/null/test/rmse/" + PointerKey(channel)), unit) + " before";
  out.figures.push_back(after);
  out.figures.push_back(Figure(record, "gained on held-out trials",
                               "/extension/heldout_gain/nats_per_sample", "nats a sample", 3));
  const double low = NumberAt(record, "/extension/heldout_gain/ci95/0");
  const double high = NumberAt(record, "/extension/heldout_gain/ci95/1");
  out.figures.back().note = std::isnan(low)
                                ? "too few hops for an interval"
                                : "95 %: " + Significant(low, 3) + " to " + Significant(high, 3);
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

}  // namespace hoplab
