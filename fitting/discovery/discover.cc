#include "fitting/discovery/discover.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "datasets/suspect_things.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/discovery/free_curve.h"
#include "fitting/discovery/freed.h"
#include "fitting/discovery/judge.h"
#include "fitting/discovery/promising.h"
#include "fitting/discovery/stability.h"

namespace hoplab {
namespace {

// Streams of the seed.
constexpr std::uint64_t kDetectionStream = 21, kResampleStream = 22, kBootstrapStream = 23,
                        kForcesStream = 24;
// Shapes within this many steps of the grid are one.
constexpr double kSameShape = 0.3;
// Terms of the library this near in shape say the same in a resample.
constexpr double kNearShape = 1.5;
// Nats the exponent must gain to be told as another number than the whole one.
constexpr double kExponentPays = 3.0;

class FormulaSearch {
 public:
  FormulaSearch(const DiagnosisOptions& options, Discovery& out) : options_(options), out_(out) {}

  void Run(const std::vector<TrialProblem>& train) {
    train_ = &train;
    Stage("laying out the terms");
    const std::vector<Term> library = TermLibrary(out_.base.problem, ScalesOf(out_.base.problem));
    out_.library = library.size();
    if (!SomethingIsMissing(library)) return;
    Stage("refitting with the terms that promise most");
    Fit(library);
    if (Stopped()) return;
    Stage("measuring on held-out trials");
    out_.base.before = MeasureHeldOut(out_.base.null, options_.fit.jobs);
    if (!out_.naming.best.members.empty()) Describe(library);
    Judge(out_);
    const ProbeBasis basis = ProbesOf(out_.base.problem.law);
    out_.free_forces =
        Reconstruct(LineariseAt(out_.base.plain, basis.probes, train, options_.fit.jobs), basis,
                    Seed(kForcesStream));
  }

 private:
  bool Stopped() const { return options_.fit.IsStopped(); }
  void Stage(std::string_view text) const {
    if (options_.stage) options_.stage(text);
  }
  std::uint64_t Seed(std::uint64_t stream) const { return options_.fit.seed * 64 + stream; }
  static std::vector<Candidate> CandidatesOf(const std::vector<Term>& terms) {
    std::vector<Candidate> candidates;
    for (const Term& t : terms) candidates.emplace_back(t.effect);
    return candidates;
  }
  // What a further term must gain to be picked by the linear model: its prior odds.
  double LeastGain() const { return std::log(static_cast<double>(out_.library)); }

  bool SomethingIsMissing(const std::vector<Term>& library) {
    const std::vector<Candidate> all = CandidatesOf(library);
    const ProbeBasis basis = ProbesOf(out_.base.problem.law);
    std::vector<Candidate> tested = all;
    tested.insert(tested.end(), basis.probes.begin(), basis.probes.end());
    Linearisation at = LineariseAt(out_.base.plain, tested, *train_, options_.fit.jobs);
    at.alike_rows = AlikeRows(*train_, out_.base.noise_squares);
    out_.base.detection = Detect(at, all, basis, Seed(kDetectionStream));
    if (out_.base.detection.p_value <= kDetectionLevel) return true;
    out_.verdict = DiscoveryVerdict::kNotNeeded;
    out_.reason = "nothing is missing that these data could show (p = " +
                  FormatDouble(std::round(1e4 * out_.base.detection.p_value) / 1e4) + ")";
    return false;
  }

  // ---- search

  void Fit(const std::vector<Term>& library) {
    const std::vector<Candidate> all = CandidatesOf(library);
    const Linearisation white = LineariseAt(out_.base.plain, all, *train_, options_.fit.jobs);
    const Linearisation colored = LineariseAt(out_.base.null, all, *train_, options_.fit.jobs);
    groups_ = EqualColumns(white);
    std::vector<int> leaders;
    for (const std::vector<int>& group : groups_) leaders.push_back(group.front());
    const std::vector<int> promising = Promising(library, leaders, white, colored);
    std::vector<Candidate> tried;
    NamingOptions naming;
    for (const int i : promising) {
      Term term = library[static_cast<std::size_t>(i)];
      if (term.shape) term = Shaped(term, ColumnSize(colored, i));
      const bool again = std::any_of(out_.terms.begin(), out_.terms.end(), [&](const Term& t) {
        return AreNeighbours(t, term, kSameShape);
      });
      if (again) continue;
      tried.emplace_back(term.effect);
      tried.back().price = PriceOf(term, library);
      out_.terms.push_back(std::move(term));
      places_.push_back(i);
    }
    leaders_ = leaders;
    naming.max_effects = kMostTerms;
    naming.in_some_trials = false;
    naming.picked_from = static_cast<int>(leaders.size());
    naming.discrepancy = options_.fit.discrepancy;
    naming.jobs = options_.fit.jobs;
    naming.stop = options_.fit.stop;
    if (options_.step)
      naming.progress = [this](int refits, int of, std::string_view) {
        options_.step("refit " + std::to_string(refits) + " of " + std::to_string(of), refits, of);
      };
    Linearisation null_at = LineariseAt(out_.base.null, tried, *train_, options_.fit.jobs);
    null_at.alike_rows = AlikeRows(*train_, out_.base.noise_squares);
    out_.naming = NameCauses({&out_.base.plain, &out_.base.null}, tried, null_at, *train_, naming);
  }

  // The term with the shape that fits best, from the one it has; itself where that cannot be told.
  Term Shaped(const Term& term, double size) const {
    const Candidate freed(&FormulaEffect(WithFreeShape(term)));
    Eigen::VectorXd sizes = Eigen::VectorXd::Zero(freed.parameter_count());
    sizes[0] = size;
    FittedModel base = out_.base.plain;
    base.cost = std::numeric_limits<double>::infinity();
    const FittedModel with =
        Refit(base, std::span(&freed, 1), sizes, SettingsOf(options_, *train_));
    if (!with.ok()) return term;
    const Eigen::VectorXd values = with.ValuesOf(0);
    return AtShape(term, {values.data() + 1, static_cast<std::size_t>(values.size() - 1)});
  }

  // ---- what was found

  void Describe(const std::vector<Term>& library) {
    const FittedModel& best = out_.naming.best;
    out_.uncertainty = AssessUncertainty(best.problem, *train_, best.shared, best.initial_states,
                                         options_.fit.loss, options_.fit.jobs);
    out_.after = MeasureHeldOut(best, options_.fit.jobs);
    out_.gain = CompareHeldOut(out_.base.null, out_.base.before, out_.after, Seed(kBootstrapStream),
                               &out_.left_out);
    std::vector<std::vector<int>> wanted;
    int place = best.problem.shared_count() - best.parameter_count();
    for (std::size_t m = 0; m < best.members.size(); ++m) {
      const int i = out_.naming.best_set[m];
      FoundTerm found;
      found.term = out_.terms[static_cast<std::size_t>(i)];
      for (int k = 0; k < best.members[m].parameter_count(); ++k, ++place)
        found.values.push_back(ValueAt(best, out_.uncertainty, place));
      const int column = places_[static_cast<std::size_t>(i)];
      wanted.push_back({});
      for (const std::vector<int>& group : groups_) {
        if (group.front() != column) continue;
        wanted.back() = group;
        for (const int j : group)
          if (j != column) found.equal.push_back(library[static_cast<std::size_t>(j)].effect);
      }
      for (int j = 0; j < static_cast<int>(library.size()); ++j)
        if (AreNeighbours(found.term, library[static_cast<std::size_t>(j)], kNearShape))
          wanted.back().push_back(j);
      for (const int rival : out_.naming.groups[m]) {
        if (rival == i) continue;
        found.as_good.push_back(out_.terms[static_cast<std::size_t>(rival)].effect);
        wanted.back().push_back(places_[static_cast<std::size_t>(rival)]);
      }
      found.share = ShareOf(m);
      found.source = WithTypical(*SourceOf(*found.term.effect), found.values);
      out_.found.push_back(std::move(found));
    }
    Resample(library, wanted);
    for (std::size_t m = 0; m < out_.found.size(); ++m) {
      if (out_.found[m].term.power) FreeExponent(m);
      if (out_.found[m].term.shape) FreeShape(m);
    }
    DrawFree();
    std::stable_sort(out_.found.begin(), out_.found.end(),
                     [](const FoundTerm& a, const FoundTerm& b) { return a.share > b.share; });
  }

  void DrawFree() {
    const NaturalScales scales = ScalesOf(out_.base.problem);
    for (FoundTerm& found : out_.found) {
      if (Stopped()) return;
      found.free_curve = FreeCurve(found.term, out_.naming.best, *train_, scales, options_.fit.jobs,
                                   Seed(kForcesStream));
    }
  }

  static FoundValue ValueAt(const FittedModel& e, const Uncertainty& u, int place) {
    const SharedParameter& s = e.problem.shared[static_cast<std::size_t>(place)];
    const ParameterUncertainty& known = u.parameters[static_cast<std::size_t>(place)];
    const bool between = u.misfit && known.ci95_between_trials;
    return {s.name.substr(s.name.rfind('.') + 1), s.unit, e.shared[place],
            between ? known.ci95_between_trials : known.ci95};
  }
  // Of the plain model's squared misfit beyond noise, what goes when the term leaves the model.
  double ShareOf(std::size_t member) const {
    const double excess = 2.0 * out_.base.plain.cost - out_.base.detection.degrees_of_freedom;
    if (!(excess > 0.0) || member >= out_.naming.without.size()) return 0.0;
    const FittedModel& without = out_.naming.without[member];
    if (!without.ok()) return 0.0;
    return std::clamp(2.0 * (without.cost - out_.naming.best.cost) / excess, 0.0, 1.0);
  }
  static FormulaSource WithTypical(FormulaSource source, const std::vector<FoundValue>& values) {
    for (FormulaParameter& p : source.parameters) {
      for (const FoundValue& v : values)
        if (v.name == p.name && v.value != 0.0 && p.null && *p.null == 0.0) p.typical = v.value;
    }
    return source;
  }

  // How often the terms are picked when trials are drawn anew, under the noise of the model that
  // has them: where they are missing they would be part of the noise.
  void Resample(const std::vector<Term>& library, const std::vector<std::vector<int>>& wanted) {
    FittedModel base = out_.base.plain;
    base.problem.noise = out_.naming.best.problem.noise;
    // With the shapes that were found.
    std::vector<Term> terms = library;
    for (std::size_t i = 0; i < out_.terms.size(); ++i)
      terms[static_cast<std::size_t>(places_[i])] = out_.terms[i];
    const Linearisation at = LineariseAt(base, CandidatesOf(terms), *train_, options_.fit.jobs);
    const std::vector<double> share = ShareOfResamples(
        at, leaders_, wanted, static_cast<int>(wanted.size()), LeastGain(), Seed(kResampleStream));
    for (std::size_t m = 0; m < share.size(); ++m) out_.found[m].selected_in = share[m];
  }

  // The best model with one term replaced by a freer one, which with the coefficient `c` is the
  // term.
  FittedModel WithFreed(std::size_t m, const Candidate& freed, double c) const {
    return Freed(out_.naming.best, m, freed, c, out_.base.plain.problem,
                 SettingsOf(options_, *train_));
  }
  Uncertainty UncertaintyOf(const FittedModel& with) const {
    return AssessUncertainty(with.problem, *train_, with.shared, with.initial_states,
                             options_.fit.loss, options_.fit.jobs);
  }

  // A limit or a frequency has an interval, as the coefficient beside it has.
  void FreeShape(std::size_t m) {
    if (Stopped()) return;
    FoundTerm& found = out_.found[m];
    const Candidate freed(&FormulaEffect(WithFreeShape(found.term)));
    const FittedModel with = WithFreed(m, freed, found.values.front().value);
    if (!with.ok()) return;
    const Uncertainty u = UncertaintyOf(with);
    FormulaSource source = found.source;
    found.values.clear();
    const int first = with.problem.shared_count() - freed.parameter_count();
    for (int k = 0; k < freed.parameter_count(); ++k) {
      const FoundValue value = ValueAt(with, u, first + k);
      FormulaParameter& p = source.parameters[static_cast<std::size_t>(k)];
      (k == 0 ? p.typical : p.value) = value.value;
      found.values.push_back(value);
    }
    found.source = source;
  }

  // The model with the exponent of one term free.
  void FreeExponent(std::size_t m) {
    if (Stopped()) return;
    FoundTerm& found = out_.found[m];
    const FittedModel& best = out_.naming.best;
    const Candidate freed(&FormulaEffect(WithFreeExponent(found.term)));
    const TermPower& power = *found.term.power;
    const FittedModel with =
        WithFreed(m, freed, found.values.front().value * std::pow(power.scale, power.exponent));
    if (!with.ok()) return;
    const Uncertainty u = UncertaintyOf(with);
    FreedExponent exponent;
    exponent.taken = power.exponent;
    exponent.value = ValueAt(with, u, with.problem.shared_count() - 1);
    exponent.gain = best.cost - with.cost;
    const bool other = exponent.gain > kExponentPays && exponent.value.ci95 &&
                       (exponent.value.ci95->first > power.exponent ||
                        exponent.value.ci95->second < power.exponent);
    if (other) {
      FormulaSource source = *SourceOf(*freed.effect);
      source.parameters[0].typical = with.shared[with.problem.shared_count() - 2];
      source.parameters[1].null.reset();
      source.parameters[1].value = exponent.value.value;
      source.parameters[1].typical.reset();
      found.source = source;
      found.values = {ValueAt(with, u, with.problem.shared_count() - 2), exponent.value};
    }
    found.exponent = exponent;
  }

  const DiagnosisOptions& options_;
  Discovery& out_;
  const std::vector<TrialProblem>* train_ = nullptr;
  std::vector<std::vector<int>> groups_;  // of equal columns of the library
  std::vector<int> leaders_;              // the first of each
  std::vector<int> places_;               // of out_.terms in the library
};

}  // namespace

Discovery DiscoverFrom(const Diagnosis& base, const DiagnosisOptions& options) {
  const auto stopped = [&] { return options.fit.IsStopped(); };
  Discovery out;
  out.base = base;
  if (base.refusal.empty() && !stopped())
    FormulaSearch(options, out).Run(TrialsOf(base.problem, TrialRole::kTrain));
  out.base.interrupted = stopped();
  return out;
}

Discovery Discover(const Dataset& dataset, const DiagnosisOptions& options) {
  FitProblem problem = MakeProblem(dataset, WithLegsAlike(options.problem));
  Diagnosis base;
  base.refusal = UnreadableTimes(dataset);
  std::vector<TrialProblem> train;
  if (base.refusal.empty())
    FitNull(std::move(problem), options, base, train);
  else
    base.problem = std::move(problem);
  return DiscoverFrom(base, options);
}

}  // namespace hoplab
