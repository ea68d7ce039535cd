#include "app/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/console.h"
#include "app/quantity.h"
#include "app/report_text.h"
#include "app/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

// A loading below this is not worth a reader's time.
constexpr double kSmallLoading = 0.1;

struct Interval {
  double low, high;
  double half_width() const { return 0.5 * (high - low); }
};
std::optional<Interval> IntervalOf(const std::optional<std::pair<double, double>>& pair) {
  if (!pair) return std::nullopt;
  return Interval{pair->first, pair->second};
}

std::string IntervalText(const std::optional<Interval>& interval, double factor, int decimals) {
  if (!interval) return "";
  return Fixed(interval->low * factor, decimals) + " .. " +
         Fixed(interval->high * factor, decimals);
}

std::string Headline(const FitRun& run) {
  long train = 0, test = 0, samples = 0;
  for (const TrialProblem& t : run.problem.trials) {
    ++(t.role == TrialRole::kTrain ? train : test);
    if (t.role == TrialRole::kTrain) samples += t.sample_count;
  }
  return fmt::format("  law {}, {}{} train and {}, {}", NameOf(run.problem.law),
                     run.by_hop ? "fitted hop by hop, " : "", train,
                     Plural(test, run.by_hop ? "test hop" : "test trial"),
                     Plural(samples, "train sample"));
}

// One line a shared parameter.
std::vector<std::string> ParameterLines(const FitRun& run) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kLeft, kLeft, kLeft, kRight, kLeft});
  const bool misfit = run.uncertainty->misfit;
  table.AddRow({"", "value", "95 % interval",
                !misfit      ? ""
                : run.by_hop ? "between hops"
                             : "between trials",
                "unit", "start", ""});
  for (int i = 0; i < run.problem.shared_count(); ++i) {
    const SharedParameter& s = run.problem.shared[i];
    const ParameterUncertainty& u = run.uncertainty->parameters[i];
    const double value = run.fit.shared[i];
    const ReadableUnit unit = ReadableUnitOf(run.Undetermined(i) ? s.initial : value, s.unit);
    const std::string start = Significant(s.initial * unit.factor, 4);
    if (run.Undetermined(i)) {
      table.AddRow({s.name, "-", "not determined", "", unit.unit, start, ""});
      continue;
    }
    const std::optional<Interval> noise = IntervalOf(u.ci95);
    const std::optional<Interval> between =
        misfit ? IntervalOf(u.ci95_between_trials) : std::nullopt;
    // Two digits of the interval that counts, at least one of the other.
    const int decimals =
        std::max(noise ? DecimalsFor(noise->half_width() * unit.factor) - (between ? 1 : 0) : 0,
                 between ? DecimalsFor(between->half_width() * unit.factor) : 0);
    table.AddRow(
        {s.name, noise ? Fixed(value * unit.factor, decimals) : Significant(value * unit.factor, 4),
         noise ? IntervalText(noise, unit.factor, decimals) : "none",
         IntervalText(between, unit.factor, decimals), unit.unit, start,
         u.at_bound ? "at bound" : ""});
  }
  return table.Lines();
}

std::string ErrorLine(const FitRun& run, const RoleErrors& errors) {
  if (errors.trials == 0) return "no such trials";
  if (errors.incomplete > 0) {
    return fmt::format("not computed: {} of {} simulations ended before their data",
                       errors.incomplete, errors.trials);
  }
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < run.problem.channels.size(); ++c) {
    const std::string name(NameOf(run.problem.channels[c].channel));
    const std::string unit = ChannelUnit(*ChannelFromName(name));
    parts.push_back(WithoutUnit(name) + " " + ErrorText(errors.rmse[c], unit));
  }
  return parts.empty() ? "contact times only" : Join(parts);
}

std::string LoadingsText(const FitProblem& problem, const WeakDirection& weak) {
  std::vector<std::string> parts;
  std::string only;
  for (int i = 0; i < problem.shared_count(); ++i) {
    if (std::abs(weak.loadings[i]) < kSmallLoading) continue;
    only = problem.shared[i].name;
    parts.push_back(fmt::format("{:+.2f} {}", weak.loadings[i], only));
  }
  if (parts.size() == 1) return only;
  return Join(parts, " ");
}

}  // namespace

std::string MisfitLine(const FitProblem& problem, const Uncertainty& u) {
  if (!problem.noise.IsWhite()) {
    return fmt::format(
        "the model misses more than the noise (chi2 {} per sample, 1 expected): a smooth error of "
        "{} "
        "is left, which the intervals allow for",
        Significant(u.chi2_per_dof, 3), LeftText(problem));
  }
  const bool between = std::any_of(u.parameters.begin(), u.parameters.end(),
                                   [](const auto& p) { return p.ci95_between_trials.has_value(); });
  return fmt::format(
      "the model misses more than the noise (chi2 {} per sample, 1 expected): the interval from "
      "noise alone is too narrow{}",
      Significant(u.chi2_per_dof, 3), between ? ", go by the one beside it" : "");
}

std::vector<std::string> TrialRemarks(const FitRun& run) {
  std::vector<std::string> remarks;
  for (const TrialErrors& t : run.trials) {
    if (!t.complete) {
      remarks.push_back(
          IsComplete(t.outcome)
              ? t.file + ": the simulation makes other contacts than the trace; no error computed"
              : fmt::format("{}: the simulation {} at {} s; no error computed", t.file,
                            SentenceOf(t.outcome), Fixed(t.end_time, 3)));
    }
    if (run.problem.law == Law::kLargeDeflection && t.max_flexure > kMaxFlexure) {
      remarks.push_back(
          fmt::format("{}: the leg bends to F C/l0 = {}; beyond {} the law large_deflection is not "
                      "to be trusted",
                      t.file, Significant(t.max_flexure, 2), kMaxFlexure));
    }
  }
  return remarks;
}

std::string DeterminedLine(const FitProblem& problem, const Uncertainty& uncertainty,
                           const std::string& at) {
  const Identifiability& id = uncertainty.identifiability;
  std::vector<std::string> unseen, weak, bound;
  for (const WeakDirection& direction : id.weak_directions) {
    const std::string loadings = LoadingsText(problem, direction);
    if (direction.eigenvalue == 0.0) {
      unseen.push_back(loadings);
    } else {
      weak.push_back(fmt::format("{} (to {} of its size)", loadings,
                                 Significant(1.0 / std::sqrt(direction.eigenvalue), 2)));
    }
  }
  for (int i = 0; i < problem.shared_count(); ++i) {
    if (uncertainty.parameters[i].at_bound) bound.push_back(problem.shared[i].name);
  }
  std::vector<std::string> parts;
  if (!unseen.empty()) parts.push_back("the data say nothing about " + Join(unseen, "; "));
  if (!weak.empty()) parts.push_back("weakly: " + Join(weak, "; "));
  if (!bound.empty()) parts.push_back("taken as given, being at a bound: " + Join(bound));
  if (unseen.empty() && weak.empty()) {
    parts.insert(parts.begin(),
                 bound.size() == problem.shared.size()
                     ? "nothing"
                     : fmt::format("{}, nothing weakly{} (condition number {})",
                                   bound.empty() ? "every parameter" : "every other parameter", at,
                                   Significant(id.condition_number, 2)));
  } else {
    parts.back() += at;
  }
  return Join(parts, "; ");
}

std::string CertificateLine(const std::optional<GradientCertificate>& certificate) {
  if (!certificate || !std::isfinite(certificate->max_relative_error)) return "not computed";
  std::string text = fmt::format("analytic and Richardson differences agree to {:.1e} (worst: {})",
                                 certificate->max_relative_error, certificate->worst_parameter);
  if (!certificate->flags.empty()) {
    const CertificateFlag& first = certificate->flags.front();
    text +=
        fmt::format("; {}, as {}: {}", Plural(static_cast<long>(certificate->flags.size()), "flag"),
                    first.trial, first.text);
  }
  return text;
}

std::string FitReport(const Dataset& dataset, const FitRun& run, bool colours) {
  std::string text = Styled(Printable(dataset.name, 100), Emphasis::kBold, colours);
  if (!dataset.title.empty()) text += "  " + Printable(dataset.title, 100);
  text += "\n" + Headline(run) + "\n";
  if (!run.has_result) return text + Labelled("no result", run.Failure(), colours);
  if (!run.faults.empty()) {
    text += "\n";
    for (const std::string& fault : run.faults) text += Labelled("stuck", fault, colours);
    std::vector<std::string> stops;
    for (int i = 0; i < run.problem.shared_count(); ++i) {
      const SharedParameter& s = run.problem.shared[i];
      const ReadableUnit unit = ReadableUnitOf(run.fit.shared[i], s.unit);
      stops.push_back(fmt::format("{} {} {}", s.name,
                                  Significant(run.fit.shared[i] * unit.factor, 3), unit.unit));
    }
    text += Labelled(
        "no result",
        "the search stopped at " + Join(stops) + ", which is no minimum and no estimate", colours);
    if (!run.note.empty()) text += Labelled("note", run.note, colours);
    for (const std::string& remark : TrialRemarks(run)) text += Labelled("note", remark, colours);
    return text;
  }
  if (const std::string caveat = run.Caveat(); !caveat.empty())
    text += Labelled("not whole", caveat, colours);
  text += "\n";
  text += WithHeader(ParameterLines(run), colours) + "\n";

  const Uncertainty& u = *run.uncertainty;
  if (u.misfit) text += Labelled("misfit", MisfitLine(run.problem, u), colours);
  text += Labelled("determined", DeterminedLine(run.problem, u, ""), colours);
  for (const TrialRole role : {TrialRole::kTrain, TrialRole::kTest}) {
    text += Labelled(role == TrialRole::kTrain ? "train error" : "test error",
                     ErrorLine(run, Summarise(run.problem, run.trials, role)), colours);
  }
  text += Labelled("gradients", CertificateLine(run.certificate), colours);
  for (const Profile& p : run.profiles) {
    const SharedParameter& s = run.problem.shared[p.parameter];
    const ReadableUnit unit = ReadableUnitOf(run.fit.shared[p.parameter], s.unit);
    const double width = p.lower95 && p.upper95 ? 0.5 * (*p.upper95 - *p.lower95) : 0.0;
    const int decimals = DecimalsFor(width * unit.factor);
    const auto side = [&](const std::optional<double>& v) {
      return v ? Fixed(*v * unit.factor, decimals) : std::string("open");
    };
    text += Labelled(
        "profile",
        fmt::format("{}: {} .. {} {}", s.name, side(p.lower95), side(p.upper95), unit.unit),
        colours);
  }
  if (const std::string known = run.problem.known.Text(); !known.empty())
    text += Labelled("known", known, colours);
  if (!run.note.empty()) text += Labelled("note", run.note, colours);
  for (const std::string& remark : TrialRemarks(run)) text += Labelled("note", remark, colours);
  return text;
}

}  // namespace hoplab
