#include <algorithm>
#include <boost/math/special_functions/binomial.hpp>
#include <cmath>

#include "fitting/diagnosis/name.h"

namespace hoplab {

std::string_view NameOf(CandidateStatus status) {
  switch (status) {
    case CandidateStatus::kSupported:
      return "supported";
    case CandidateStatus::kIndistinguishable:
      return "indistinguishable";
    case CandidateStatus::kExcluded:
      return "excluded";
    case CandidateStatus::kNotNeeded:
      return "not_needed";
    case CandidateStatus::kNotTested:
      return "not_tested";
  }
  return "";
}

double Naming::LogOdds(const Candidate& candidate) const {
  const auto some = static_cast<unsigned>(candidate.only_recordings.size());
  const double of_one = log_odds + candidate.price;
  if (some == 0) return of_one;
  const auto all = static_cast<unsigned>(std::max(recordings, 1));
  // How many, and which.
  const double picking = std::log(boost::math::binomial_coefficient<double>(all, some));
  return of_one + picking + (some > 1 ? std::log(static_cast<double>(all)) : 0.0);
}

std::size_t Naming::MemberOf(int candidate) const {
  return static_cast<std::size_t>(std::find(best_set.begin(), best_set.end(), candidate) -
                                  best_set.begin());
}

}  // namespace hoplab
