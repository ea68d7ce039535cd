#include "fitting/trial_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

// Differences need simulations whose own error is far below the step's effect.
IntegratorOptions Tight(const IntegratorOptions& options) {
  IntegratorOptions tight = options;
  tight.relative_tolerance = std::min(options.relative_tolerance, 1e-12);
  tight.absolute_tolerance = std::min(options.absolute_tolerance, 1e-13);
  return tight;
}

// Step of the widest difference as a share of the size of the value: its h^4 remainder after
// extrapolation and the simulations' 1e-12 over it balance near 1e-3 for hop traces.
constexpr double kStep = 1e-3;
// Below this guard rate [1/s] an event is close to grazing: a start half a hop earlier would meet
// it at more than 1 in every hop trace seen.
constexpr double kNearGrazing = 1e-2;
constexpr double kNearMiss = 1e-3;

// A prior may pin a start component to 1e-9: differences need more room than that.
constexpr double kLeastStartStep = 1e-5;

// A shared value may have moved far below its nominal size (but zero is no size).
double Size(const SharedParameter& s, double value) {
  return std::clamp(std::abs(value), 0.01 * s.scale, s.scale);
}

// Differences are taken over a step this much shorter where the events of a shifted simulation come
// in another order, or where half the step gives another slope by this share, and how often:
// beyond, the simulations' own error is what is left of them. What is left of the share after
// extrapolation is about its square.
constexpr double kShorter = 0.25;
constexpr double kBends = 1e-3;
constexpr int kMostShorter = 4;

// Central differences that are off by more are of a corner, if those to one side are not.
constexpr double kCorner = 1e-5;
// What the tolerance of the runs leaves of a slope that is zero, over the tolerance times the
// sample over the step.
constexpr double kLeftBySlopes = 100.0;

// Events that act on the motion.
std::vector<Event> ActingEvents(const Trajectory& trajectory) {
  std::vector<Event> events;
  for (const Event& e : trajectory.events) {
    if (e.kind != EventKind::kApex) events.push_back(e);
  }
  return events;
}

// Whether the same things happen in the same order, as far as both runs tell.
bool InOneOrder(const std::vector<Event>& a, const std::vector<Event>& b) {
  const auto n = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return std::equal(a.begin(), a.begin() + n, b.begin(), [](const Event& x, const Event& y) {
    return x.kind == y.kind && x.leg == y.leg;
  });
}

void Flag(const TrialProblem& trial, const Trajectory& trajectory,
          std::vector<CertificateFlag>& flags) {
  if (trajectory.least_crossing_rate < kNearGrazing)
    flags.push_back({trial.file, "an event is met almost tangentially (grazing)"});
  if (trajectory.has_simultaneous_events)
    flags.push_back({trial.file, "two events at one instant: derivatives are one-sided"});
  if (trajectory.nearest_miss < kNearMiss)
    flags.push_back({trial.file, "another event sequence is very near (a guard almost crossed)"});
}

// The samples differentiated by one value, by differences.
struct Differences {
  std::vector<double> slopes;
  double step = 0.0;
  // Of the first event that a shifted run has and the run itself not: an event beyond the last row
  // comes before it where a value is shifted.
  double first_new = std::numeric_limits<double>::infinity();
};

class TrialCheck {
 public:
  TrialCheck(const FitProblem& problem, const TrialProblem& trial, const Eigen::VectorXd& shared,
             const OwnValues& start)
      : problem_(problem),
        trial_(trial),
        shared_(shared),
        start_(start),
        tight_(Tight(problem.integrator)),
        evaluator_(problem, trial) {}

  TrialCertificate Report(const JacobianSource& source) {
    const int n = problem_.shared_count(), width = evaluator_.column_count();
    TrialCertificate report;
    if (source)
      source(evaluator_, {shared_, start_, true}, analytic_);
    else
      evaluator_.Simulate({shared_, start_, true}, problem_.integrator, analytic_);
    Flag(trial_, analytic_, report.flags);
    events_ = ActingEvents(analytic_);
    report.errors.assign(width, std::numeric_limits<double>::quiet_NaN());
    for (int k = 0; k < width; ++k) {
      if (k >= n && !trial_.own[k - n].free) continue;
      const std::optional<Differences> differences = DifferencesBy(k, report.flags);
      if (!differences) continue;
      report.errors[k] = ErrorOf(k, *differences);
      if (report.errors[k] > kCorner) LookToOneSide(k, report);
    }
    return report;
  }

 private:
  // A run with value k shifted.
  struct Shifted {
    std::vector<double> samples;
    std::vector<Event> events;
  };
  Shifted Simulate(int k, double offset) {
    const int n = problem_.shared_count();
    Eigen::VectorXd p = shared_;
    OwnValues z = start_;
    (k < n ? p[k] : z[k - n]) += offset;
    evaluator_.Simulate({p, z, false}, tight_, shifted_);
    return {shifted_.samples, ActingEvents(shifted_)};
  }
  // Half of the runs differences take: shifted by h and h/2 to one side.
  struct Side {
    Shifted whole, half;
    bool in_order = false;
  };
  Side SideOf(int k, double h) {
    Side side{Simulate(k, h), Simulate(k, 0.5 * h)};
    side.in_order = InOneOrder(side.whole.events, events_) && InOneOrder(side.half.events, events_);
    return side;
  }
  void NoteNew(const Side& side, Differences& to) const {
    for (const Shifted* run : {&side.whole, &side.half}) {
      if (run->events.size() > events_.size())
        to.first_new = std::min(to.first_new, run->events[events_.size()].time);
    }
  }

  // By central differences over the widest step within which events keep their order; where no step
  // has such a neighbourhood, by those of the side that has it. None: neither has.
  std::optional<Differences> DifferencesBy(int k, std::vector<CertificateFlag>& flags) {
    double h = WidestStep(k);
    Side plus = SideOf(k, h), minus = SideOf(k, -h);
    for (int i = 0; i < kMostShorter; ++i) {
      if (plus.in_order && minus.in_order && !Bends(k, plus, minus, h)) break;
      h *= kShorter;
      plus = SideOf(k, h);
      minus = SideOf(k, -h);
    }
    Differences out;
    out.step = h;
    const std::string& name = NameOfValue(k);
    if (plus.in_order && minus.in_order) {
      if (Bends(k, plus, minus, h))
        flags.push_back(
            {trial_.file, "an event is met so close to grazing that its derivative by " + name +
                              " changes within the shortest difference"});
      NoteNew(plus, out);
      NoteNew(minus, out);
      out.slopes = Central(plus, minus, h);
      return out;
    }
    flags.push_back(
        {trial_.file, "another event sequence begins right beside this " + name +
                          (plus.in_order || minus.in_order
                               ? ": its derivative is held against differences to one side"
                               : ", on both sides: its derivative could not be checked")});
    if (!plus.in_order && !minus.in_order) return std::nullopt;
    const Side& side = plus.in_order ? plus : minus;
    NoteNew(side, out);
    out.slopes = OneSided(Simulate(k, 0.0).samples, side, plus.in_order ? h : -h);
    return out;
  }
  double WidestStep(int k) const {
    const int n = problem_.shared_count();
    return k < n ? kStep * Size(problem_.shared[k], shared_[k])
                 : std::max(kStep * trial_.own[k - n].scale, kLeastStartStep);
  }
  const std::string& NameOfValue(int k) const {
    const int n = problem_.shared_count();
    return k < n ? problem_.shared[k].name : trial_.own[k - n].name;
  }
  // An event at the very instant at which a held input jumps has another slope on either side.
  // Where a search has ended in such a corner, the derivative is that of one side.
  void LookToOneSide(int k, TrialCertificate& report) {
    const std::vector<double> at = Simulate(k, 0.0).samples;
    double h = WidestStep(k), least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kMostShorter && !(least < kCorner); ++i, h *= kShorter) {
      for (const double step : {h, -h}) {
        const Side side = SideOf(k, step);
        if (!side.in_order) continue;
        Differences to_side;
        to_side.step = h;
        NoteNew(side, to_side);
        to_side.slopes = OneSided(at, side, step);
        least = std::fmin(least, ErrorOf(k, to_side));
      }
    }
    if (!(least < kCorner)) return;
    report.errors[k] = least;
    report.flags.push_back({trial_.file, "the slope by this " + NameOfValue(k) +
                                             " is another one on either side of it: its derivative "
                                             "is held against differences to one side"});
  }

  // Whether the slope over the step and that over half of it differ by more than kBends.
  bool Bends(int k, const Side& plus, const Side& minus, double h) const {
    Differences of;
    NoteNew(plus, of);
    NoteNew(minus, of);
    const std::size_t columns = problem_.channels.size();
    double difference = 0.0, norm = 0.0;
    for (std::size_t row = 0; row < trial_.row_times.size(); ++row) {
      const double time = trial_.row_times[row];
      if (time >= of.first_new || IsNearEvent(time, k, h)) continue;
      for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t cell = row * columns + c;
        const double wide = (plus.whole.samples[cell] - minus.whole.samples[cell]) / (2.0 * h);
        const double narrow = (plus.half.samples[cell] - minus.half.samples[cell]) / h;
        if (!std::isfinite(wide) || !std::isfinite(narrow)) continue;
        const double weight = 1.0 / problem_.channels[c].sigma;
        difference += std::pow((wide - narrow) * weight, 2);
        norm += std::pow(narrow * weight, 2);
      }
    }
    return difference > kBends * kBends * norm;
  }
  static std::vector<double> Central(const Side& plus, const Side& minus, double h) {
    std::vector<double> slopes(plus.whole.samples.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const double wide = (plus.whole.samples[i] - minus.whole.samples[i]) / (2.0 * h);
      const double narrow = (plus.half.samples[i] - minus.half.samples[i]) / h;
      slopes[i] = (4.0 * narrow - wide) / 3.0;
    }
    return slopes;
  }
  static std::vector<double> OneSided(const std::vector<double>& at, const Side& side, double h) {
    std::vector<double> slopes(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double wide = (side.whole.samples[i] - at[i]) / h;
      const double narrow = (side.half.samples[i] - at[i]) / (0.5 * h);
      slopes[i] = 2.0 * narrow - wide;
    }
    return slopes;
  }

  // An event moves by about h dt_e/dp: velocities jump or kink there.
  bool IsNearEvent(double time, int k, double h) const {
    const auto width = static_cast<std::size_t>(evaluator_.column_count());
    for (std::size_t e = 0; e < analytic_.events.size(); ++e) {
      if (analytic_.events[e].kind == EventKind::kApex) continue;
      const double reach =
          2.0 * h * std::abs(analytic_.event_time_sensitivities[e * width + k]) + 1e-9;
      if (std::abs(time - analytic_.events[e].time) < reach) return true;
    }
    return false;
  }

  // Of the analytic column, all rows that can be compared; NaN: the column is zero, as far as runs
  // of this tolerance tell.
  double ErrorOf(int k, const Differences& differences) const {
    const std::size_t columns = problem_.channels.size();
    const auto width = static_cast<std::size_t>(evaluator_.column_count());
    double difference = 0.0, norm = 0.0, rounding = 0.0;
    for (std::size_t row = 0; row < trial_.row_times.size(); ++row) {
      const double time = trial_.row_times[row];
      if (time >= differences.first_new || IsNearEvent(time, k, differences.step)) continue;
      for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t cell = row * columns + c;
        const double slope = differences.slopes[cell];
        const double value = analytic_.sensitivities[cell * width + k];
        if (!std::isfinite(slope) || !std::isfinite(value)) continue;
        const double weight = 1.0 / problem_.channels[c].sigma;
        difference += std::pow((value - slope) * weight, 2);
        norm += std::pow(value * weight, 2);
        const double sample = tight_.absolute_tolerance +
                              tight_.relative_tolerance * std::abs(analytic_.samples[cell]);
        rounding += std::pow(kLeftBySlopes * sample / differences.step * weight, 2);
      }
    }
    if (std::max(norm, difference) <= rounding) return std::numeric_limits<double>::quiet_NaN();
    return norm > 0.0 ? std::sqrt(difference / norm) : std::numeric_limits<double>::infinity();
  }

  const FitProblem& problem_;
  const TrialProblem& trial_;
  const Eigen::VectorXd& shared_;
  const OwnValues& start_;
  IntegratorOptions tight_;
  TrialEvaluator evaluator_;
  Trajectory analytic_, shifted_;
  std::vector<Event> events_;  // of the run as it is
};

}  // namespace

TrialCertificate CertifyTrial(const FitProblem& problem, const TrialProblem& trial,
                              const Eigen::VectorXd& shared, const OwnValues& start,
                              const JacobianSource& source) {
  return TrialCheck(problem, trial, shared, start).Report(source);
}

}  // namespace hoplab
