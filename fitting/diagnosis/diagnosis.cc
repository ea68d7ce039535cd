#include "fitting/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "fitting/diagnosis/believe.h"
#include "fitting/diagnosis/each_trial.h"
#include "fitting/diagnosis/heterogeneity.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/movements.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/diagnosis/own_sizes.h"
#include "fitting/diagnosis/sizes.h"
#include "fitting/diagnosis/unseen_filters.h"
#include "fitting/diagnosis/verdict.h"
#include "fitting/stop_check.h"

namespace hoplab {
namespace {

class Pipeline {
 public:
  Pipeline(const DiagnosisOptions& options, const Beforehand& beforehand)
      : options_(options), beforehand_(beforehand) {}

  Diagnosis Run(DatasetFit null) {
    BeginWith(std::move(null), options_, d_, train_);
    if (!d_.refusal.empty() || Stopped()) return Finish();
    std::vector<Candidate> candidates = CandidatesOf(d_.problem, options_.candidates);
    Look(candidates);
    if (Stopped()) return Finish();
    if (d_.detection.p_value <= kDetectionLevel) {
      Name(candidates);
      NameUnseenFilters(candidates);
    }
    if (!Stopped() && LeavesMuch()) NameOfEachTrial(candidates);
    if (Stopped()) return Finish();
    RestateUnseen(train_, options_.fit.jobs, d_.naming.best);
    Stage("measuring on held-out trials");
    d_.before = MeasureHeldOut(d_.null, options_.fit.jobs);
    if (!d_.naming.best.members.empty()) Extended(candidates);
    if (Stopped()) return Finish();
    return Judged();
  }

  Diagnosis RunWithout(Diagnosis diagnosis, std::vector<SetAside> members) {
    d_ = std::move(diagnosis);
    train_ = TrialsOf(d_.problem, TrialRole::kTrain);
    basis_ = ProbesOf(d_.problem.law);
    if (!TakeOut(members, d_.plain.problem, Settings(), d_.naming)) return Finish();
    std::move(members.begin(), members.end(), std::back_inserter(d_.set_aside));
    const std::vector<Candidate> candidates = CandidatesOf(d_.problem, options_.candidates);
    Accept(Retold(*d_.extension, candidates, d_.set_aside));
    d_.free_forces.reset();
    std::erase(d_.notes, std::exchange(d_.own_sizes, {}));
    return Judged();
  }

 private:
  bool Stopped() const { return options_.fit.IsStopped(); }
  void Stage(std::string_view text) const {
    if (options_.stage) options_.stage(text);
  }
  Diagnosis Judged() {
    Judge(d_, options_.material);
    DescribeWhatIsMissing();
    return Finish();
  }
  Diagnosis Finish() {
    d_.interrupted = Stopped();
    return std::move(d_);
  }

  RefitSettings Settings() const { return SettingsOf(options_, train_); }

  // ---- detect, localise
  void Look(const std::vector<Candidate>& candidates) {
    Stage("looking for what the simulation gets wrong");
    basis_ = ProbesOf(d_.problem.law);
    std::vector<Candidate> all = candidates;
    all.insert(all.end(), basis_.probes.begin(), basis_.probes.end());
    // Whether anything is there is asked of white noise: a discrepancy is one of the answers.
    const Linearisation at = LinearisedAt(d_.plain, all);
    NoteFailed(at);
    d_.detection = Detect(at, candidates, basis_, options_.Seed(Draws::kDetection));
    d_.localisation =
        Localise(Linearise(d_.plain.problem, d_.plain.problem.shared_count(), train_,
                           d_.plain.shared, d_.plain.initial_states, options_.fit.jobs),
                 d_.noise_squares);
    d_.uncertainty = AssessUncertainty(d_.problem, train_, d_.null.shared, d_.null.initial_states,
                                       options_.fit.loss, options_.fit.jobs);
    if (d_.detection.p_value > kDetectionLevel) {
      // Nothing to name; what each candidate could have shown is still told.
      NamingOptions none;
      none.max_effects = 0;
      d_.naming = NameCauses({&d_.plain, &d_.null}, candidates, NullAt(candidates), train_, none);
    }
  }
  Linearisation NullAt(const std::vector<Candidate>& candidates) const {
    return LinearisedAt(d_.null, candidates);
  }
  Linearisation LinearisedAt(const FittedModel& model, std::span<const Candidate> tested) const {
    Linearisation at = LineariseAt(model, tested, train_, options_.fit.jobs);
    at.alike_rows = AlikeRows(train_, d_.noise_squares);
    return at;
  }

  void NoteFailed(const Linearisation& at) {
    std::string names;
    for (const std::string& name : at.failed) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty())
      d_.notes.push_back("not tested, since no simulation could be differentiated by it: " + names);
  }

  // ---- name
  NamingOptions HowToName() const {
    NamingOptions naming;
    naming.max_effects = options_.max_effects;
    naming.begin = beforehand_.begin;
    naming.slow_ones_only_beside = beforehand_.slow_ones_only_beside;
    naming.singles_by_promise = beforehand_.nothing_seen;
    naming.discrepancy = options_.fit.discrepancy;
    naming.jobs = options_.fit.jobs;
    naming.stop = options_.fit.stop;
    if (options_.step) {
      naming.progress = [&](int refits, int of, std::string_view what) {
        options_.step("refit " + std::to_string(refits) + " of " + std::to_string(of) + ": " +
                          std::string(what),
                      refits, of);
      };
    }
    return naming;
  }
  void Name(const std::vector<Candidate>& candidates) {
    Stage("refitting with every candidate cause");
    d_.naming =
        NameCauses({&d_.plain, &d_.null}, candidates, NullAt(candidates), train_, HowToName());
  }

  // Noise that came in after a filter does not tell of it: such a one is sought where what was
  // found leaves something smooth. (The legs of a robot land one by one, and no filter has been
  // seen.)
  void NameUnseenFilters(std::vector<Candidate>& candidates) {
    const bool leaves = d_.naming.best.evidence.discrepancy_probability() > 0.5;
    if (!leaves || d_.problem.robot_legs().count > 0 || Stopped()) return;
    const std::vector<Candidate> filters = UnseenFilters(d_.problem, options_.candidates);
    if (filters.empty()) return;
    Stage("refitting with filters of which the noise does not tell");
    const auto null_at = [&](std::span<const Candidate> all) { return LinearisedAt(d_.null, all); };
    std::optional<Naming> found = NameWithFilters(
        {{&d_.plain, &d_.null}, candidates, filters, &d_.naming, &train_, HowToName(), null_at});
    if (!found || LeavesMore(found->best) || LeavesSeen(d_.detection, found->best)) return;
    d_.naming = *std::move(found);
    candidates.insert(candidates.end(), filters.begin(), filters.end());
  }

  // What was found, each cause of one size for all trials, is not enough, or is pieced together.
  bool LeavesMuch() const {
    if (d_.detection.p_value > kDetectionLevel || MisfitOverNoise(d_.detection) < kSlight)
      return false;
    const FittedModel& best = d_.naming.best;
    int in_one_trial = 0;
    bool at_bound = !AtWall(best.problem, best.shared).empty();
    for (int i = 0; i < static_cast<int>(best.members.size()); ++i) {
      at_bound |= best.AtPhysicalBound(i);
      in_one_trial += best.members[static_cast<std::size_t>(i)].only_recordings.size() == 1;
    }
    return LeavesMore(best) || at_bound || in_one_trial > 1;
  }
  // Than noise and details.
  bool LeavesMore(const FittedModel& best) const {
    const double share = LeftShare(d_.detection, 2.0 * best.cost, best.parameter_count());
    return best.evidence.discrepancy_probability() > 0.5 && share > options_.material;
  }

  // A cause whose size is each trial's own, where that explains the data better, and all of them:
  // sizes that are free in each trial take up much of what they are not. (Hops of a trial are no
  // trials; a robot's first stances are looked at trial by trial anyway.)
  void NameOfEachTrial(const std::vector<Candidate>& candidates) {
    if (d_.by_hop || d_.problem.robot_legs().count > 0 || options_.max_effects < 1) return;
    const std::vector<OwnSizes> promising =
        PromisingOwnSizes(d_, candidates, train_, options_.fit.jobs);
    if (promising.empty()) return;
    Stage("refitting with a cause of each trial's own size");
    EachTrialRequest request;
    request.null = {&d_.plain, &d_.null};
    request.candidates = candidates;
    request.promising = promising;
    request.with_one_size = &d_.naming;
    request.noise_squares = &d_.noise_squares;
    request.naming = HowToName();
    std::optional<EachTrialFound> found = NameEachTrial(request, Settings());
    if (!found || LeavesMore(found->naming.best)) return;
    d_.naming = std::move(found->naming);
    train_ = std::move(found->train);
    own_sizes_ = std::move(found->value);
  }

  // ---- extend, measure
  void Extended(const std::vector<Candidate>& candidates) {
    ExtensionReport report = ReportOf(candidates, {});
    FindStandIns(report.causes);
    d_.nothing_seen_before = beforehand_.nothing_seen;
    // What shows late alone may be the model's own error, which grows: even odds are not enough.
    const double likely = beforehand_.nothing_seen ? kProbable : kLikely;
    if (IsSlight(d_.detection, report, likely)) return SetAllAside(report, candidates);
    std::vector<SetAside> doubtful = DoubtfulCorrections(report, d_.naming);
    if (!doubtful.empty() && !Stopped()) {
      Stage("taking out corrections that are most likely not what they say");
      if (TakeOut(doubtful, d_.plain.problem, Settings(), d_.naming)) {
        report = Retold(report, candidates, doubtful);
        d_.set_aside = std::move(doubtful);
      }
    }
    Accept(std::move(report));
  }

  void Accept(ExtensionReport report) {
    d_.extension = std::move(report);
    MeasureSizes(*d_.extension, d_, options_.material, options_.Seed(Draws::kBootstrap),
                 Settings());
    for (const CauseReport* c : d_.extension->ToldCauses()) {
      const int member = static_cast<int>(d_.naming.MemberOf(c->candidate));
      d_.extension->at_bound |= d_.naming.best.AtPhysicalBound(member);
    }
    const std::vector<std::string> at_wall = AtWall(d_.naming.best.problem, d_.naming.best.shared);
    for (const SharedParameter& plain : d_.null.problem.shared)
      if (std::find(at_wall.begin(), at_wall.end(), plain.name) != at_wall.end())
        d_.extension->at_wall.push_back(plain.name);
  }

  // Nothing is told: the model as it is, with intervals that hold what the evidence wanted.
  void SetAllAside(const ExtensionReport& report, const std::vector<Candidate>& candidates) {
    d_.set_aside = AllCorrections(report, d_.naming);
    const auto larger = LargerModelOf(d_.null, d_.naming.best, d_.naming.best_set.front(),
                                      ProbabilityOf(d_.set_aside));
    TakeAllOut(d_.set_aside, d_.null, d_.naming);
    std::vector<OtherModel> others = OtherModelsOf(d_.naming, NullAt(candidates), candidates);
    Doubt(d_.set_aside, others);
    if (larger) others.push_back(*larger);
    HoldOtherModels(others, d_.null, d_.uncertainty);
  }

  // What the best extension is worth, without the sizes trial by trial.
  ExtensionReport ReportOf(const std::vector<Candidate>& candidates,
                           const std::vector<SetAside>& set_aside) {
    const FittedModel& best = d_.naming.best;
    ExtensionReport report;
    report.uncertainty = AssessUncertainty(best.problem, train_, best.shared, best.initial_states,
                                           options_.fit.loss, options_.fit.jobs);
    report.after = MeasureHeldOut(best, options_.fit.jobs);
    report.gain = CompareHeldOut(d_.null, d_.before, report.after, options_.Seed(Draws::kBootstrap),
                                 &report.left_out);
    report.movements = MovementsOf(d_.null, d_.uncertainty, best);
    const std::vector<Candidate> others = CandidatesBeside(best, candidates);
    std::vector<Candidate> all = others;
    all.insert(all.end(), basis_.probes.begin(), basis_.probes.end());
    const Linearisation at = LinearisedAt(best, all);
    report.remainder = Detect(at, others, basis_, options_.Seed(Draws::kRemainder));
    report.other_models = OtherModelsOf(d_.naming, at, others);
    Doubt(set_aside, report.other_models);
    HoldOtherModels(report.other_models, best, report.uncertainty);
    report.white_square = 2.0 * best.cost;
    report.explained = 1.0 - LeftShare(d_.detection, report.white_square, best.parameter_count());
    report.causes = TakeApart(d_.naming,
                              {.plain_square = 2.0 * d_.plain.cost,
                               .extended_square = report.white_square,
                               .after = &report.after,
                               .material = options_.material,
                               .seed = options_.Seed(Draws::kBootstrap)},
                              Settings());
    std::vector<Heterogeneity> sizes = HeterogeneityOf(best, train_, options_.fit.jobs);
    if (own_sizes_) {
      const int place = own_sizes_->place;
      sizes[static_cast<std::size_t>(place)] =
          HeterogeneityAt(best, train_, place, options_.fit.jobs);
    }
    Believe(report, d_, sizes);
    for (CauseReport& c : report.causes)
      if (c.cause.each_trial) c.refitted = {own_sizes_};
    return report;
  }

  // The extension without what is set aside. How sure its names are was judged with that, as in the
  // cases it was learnt from.
  ExtensionReport Retold(const ExtensionReport& with, const std::vector<Candidate>& candidates,
                         const std::vector<SetAside>& set_aside) {
    ExtensionReport report = ReportOf(candidates, set_aside);
    for (CauseReport& c : report.causes) {
      const auto before =
          std::find_if(with.causes.begin(), with.causes.end(),
                       [&](const CauseReport& b) { return b.candidate == c.candidate; });
      c.features = before->features;
      c.probability = before->probability;
      c.group_probability = before->group_probability;
    }
    FindStandIns(report.causes);
    return report;
  }

  // As free forces, what no cause explains.
  void DescribeWhatIsMissing() {
    const bool left = NamesSomething(d_) && d_.left.material;
    if (d_.verdict != Verdict::kUnexplained && !left) return;
    const FittedModel& model = d_.extension ? d_.naming.best : d_.plain;
    const Linearisation at = LinearisedAt(model, basis_.probes);
    d_.free_forces = Reconstruct(at, basis_, options_.Seed(Draws::kForces));
    NoteOwnSizes();
  }

  // What is there in every trial, of another size in each, and is not named.
  void NoteOwnSizes() {
    if (own_sizes_) return;
    const std::vector<OwnSizes> own = PromisingOwnSizes(
        d_, CandidatesOf(d_.problem, options_.candidates), train_, options_.fit.jobs);
    if (own.empty() || (d_.extension && d_.extension->explained >= own.front().explained)) return;
    d_.own_sizes = TextOf(own.front(), train_);
    d_.notes.push_back(d_.own_sizes);
  }

  const DiagnosisOptions& options_;
  const Beforehand& beforehand_;
  Diagnosis d_;
  ProbeBasis basis_;
  std::vector<TrialProblem> train_;
  std::optional<VaryingValue> own_sizes_;  // of the told cause that has one in each trial
};

}  // namespace

Diagnosis DiagnoseFitted(DatasetFit null, const DiagnosisOptions& options,
                         const Beforehand& beforehand) {
  return Pipeline(options, beforehand).Run(std::move(null));
}

Diagnosis DiagnosedWithout(Diagnosis diagnosis, const std::vector<SetAside>& members,
                           const DiagnosisOptions& options) {
  const Beforehand nothing;
  return Pipeline(options, nothing).RunWithout(std::move(diagnosis), members);
}

}  // namespace hoplab
