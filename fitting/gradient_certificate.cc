#include "fitting/gradient_certificate.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "fitting/trial_certificate.h"

namespace hoplab {

GradientCertificate CertifyGradients(const FitProblem& problem,
                                     const std::vector<TrialProblem>& trials,
                                     const Eigen::VectorXd& shared,
                                     const std::vector<OwnValues>& initial_states, int jobs,
                                     const JacobianSource& source) {
  std::vector<TrialCertificate> reports(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    reports[i] = CertifyTrial(problem, trials[i], shared, initial_states[i], source);
  });
  GradientCertificate out;
  out.max_relative_error = std::numeric_limits<double>::quiet_NaN();
  out.max_error_without_flags = std::numeric_limits<double>::quiet_NaN();
  for (const TrialCertificate& report : reports) {
    for (const double error : report.errors) {
      if (report.flags.empty() && !std::isnan(error) && !(error <= out.max_error_without_flags))
        out.max_error_without_flags = error;
    }
  }
  const auto take = [&](const CertificateColumn& column) {
    out.columns.push_back(column);
    if (!column.relative_error) return;
    if (!(*column.relative_error <= out.max_relative_error)) {
      out.max_relative_error = *column.relative_error;
      out.worst_parameter = column.name;
    }
  };
  const int n = problem.shared_count();
  for (int k = 0; k < n; ++k) {
    CertificateColumn column{problem.shared[k].name, "", std::nullopt};
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const double error = reports[i].errors[k];
      if (std::isnan(error) || (column.relative_error && error <= *column.relative_error)) continue;
      column.relative_error = error;
      column.trial = trials[i].file;
    }
    take(column);
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (int k = 0; k < trials[i].own_count(); ++k) {
      const double error = reports[i].errors[n + k];
      if (!std::isnan(error))
        take({trials[i].file + "." + trials[i].own[k].name, trials[i].file, error});
    }
    out.flags.insert(out.flags.end(), reports[i].flags.begin(), reports[i].flags.end());
  }
  return out;
}

}  // namespace hoplab
