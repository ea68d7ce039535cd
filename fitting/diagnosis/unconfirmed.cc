#include "fitting/diagnosis/unconfirmed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fitting/diagnosis/believe.h"

namespace hoplab {
namespace {

// Of robots with one thing wrong (docs/statistics/robot.md) no cause that acts differs by both.
constexpr double kPlainErrors = 3.0, kPlainShare = 0.25;

double ErrorOf(const ParameterUncertainty& u) {
  return std::max(u.std_error.value_or(0.0), u.std_error_between_trials.value_or(0.0));
}

}  // namespace

bool SizeChange::IsPlain() const { return std_errors > kPlainErrors && share > kPlainShare; }

SizeChange ChangeOfSize(const CauseReport& cause, const Diagnosis& diagnosis,
                        const CarriedOn& whole) {
  const Naming& naming = diagnosis.naming;
  const int member = static_cast<int>(naming.MemberOf(cause.candidate));
  const int place = naming.best.PlaceOf(member);
  const auto typical = [&](int k) { return std::abs(cause.cause.Parameter(k).typical); };
  double size = 0.0;
  for (int k = 0; k < cause.cause.parameter_count(); ++k)
    size = std::max(size, std::abs(naming.best.shared[place + k]) / typical(k));
  SizeChange most;
  bool is_known = true;
  for (int k = 0; k < cause.cause.parameter_count(); ++k) {
    const int i = place + k;
    const auto at = static_cast<std::size_t>(i);
    const double first = ErrorOf(diagnosis.extension->uncertainty.parameters[at]);
    const double all = ErrorOf(whole.uncertainty.parameters[at]);
    const double error = std::sqrt(std::max(first * first - all * all, 0.25 * first * first));
    const double by = std::abs(whole.model.shared[i] - naming.best.shared[i]);
    const SizeChange change{.std_errors = error > 0.0 ? by / error : 0.0,
                            .share = size > 0.0 ? by / (size * typical(k)) : 0.0};
    is_known = is_known && first > 0.0 && all > 0.0;
    if (std::pair(change.IsPlain(), change.std_errors) > std::pair(most.IsPlain(), most.std_errors))
      most = change;
  }
  most.is_known = is_known;
  return most;
}

std::vector<SetAside> Unconfirmed(const Diagnosis& diagnosis, const CarriedOn& whole) {
  std::vector<SetAside> unconfirmed;
  bool some_is_confirmed = false;
  for (const CauseReport& c : diagnosis.extension->causes) {
    const SizeChange change = ChangeOfSize(c, diagnosis, whole);
    if (!change.is_known) continue;
    some_is_confirmed |= !change.IsPlain() && c.main && c.group_probability >= kLikely;
    if (!change.IsPlain() || diagnosis.naming.GroupOf(c.candidate).size() > 1) continue;
    SetAside out = AsSetAside(c, *diagnosis.extension, diagnosis.naming);
    out.by_whole_trials =
        whole.model.ValuesOf(static_cast<int>(diagnosis.naming.MemberOf(c.candidate)));
    unconfirmed.push_back(std::move(out));
  }
  return some_is_confirmed ? unconfirmed : std::vector<SetAside>();
}

}  // namespace hoplab
