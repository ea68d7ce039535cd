#include "fitting/diagnosis/localise.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <map>
#include <tuple>

namespace hoplab {
namespace {

constexpr std::array kPhases = {"early", "middle", "late"};

double TailOf(double chi2, double expected) {
  if (!(expected > 0.0)) return 1.0;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(expected), chi2));
}

struct Sum {
  long rows = 0;
  double chi2 = 0.0, expected = 0.0;
  void Add(double r, double of_noise) {
    ++rows;
    chi2 += r * r;
    expected += of_noise;
  }
};

// Shares of the excess over noise, among parts that have any.
template <class Parts>
void SetShares(Parts& parts) {
  double excess = 0.0;
  for (const auto& p : parts) excess += std::max(p.chi2 - p.expected, 0.0);
  for (auto& p : parts) {
    p.p_value = TailOf(p.chi2, p.expected);
    p.share = excess > 0.0 ? std::max(p.chi2 - p.expected, 0.0) / excess : 0.0;
  }
}

std::vector<MisfitPart> PartsOf(const std::map<int, Sum>& sums) {
  std::vector<MisfitPart> parts;
  for (const auto& [index, sum] : sums)
    parts.push_back({index, sum.rows, sum.chi2, sum.expected, 1.0, 0.0});
  SetShares(parts);
  return parts;
}

}  // namespace

Localisation Localise(const Linearisation& at, const std::vector<double>& noise_squares) {
  std::map<std::tuple<Mode, int, int>, Sum> cells;
  std::map<int, Sum> hops, trials;
  Localisation out;
  for (int row = 0; row < at.rows(); ++row) {
    const RowLabel& label = at.labels[static_cast<std::size_t>(row)];
    if (label.of == RowLabel::Of::kPrior) continue;
    const bool alike = label.channel >= 0 && !noise_squares.empty();
    const double square = alike ? noise_squares[static_cast<std::size_t>(label.channel)] : 1.0;
    const double of_noise = std::max(square - at.leverage[row], 0.0);
    const int phase = std::min(static_cast<int>(label.phase * kPhases.size()), 2);
    for (Sum* sum :
         {&cells[{label.mode, phase, label.channel}], &hops[label.hop], &trials[label.trial]})
      sum->Add(at.r[row], of_noise);
    out.chi2 += at.r[row] * at.r[row];
    out.expected += of_noise;
  }
  for (const auto& [key, sum] : cells) {
    MisfitCell cell;
    cell.mode = std::get<0>(key);
    cell.phase = kPhases[static_cast<std::size_t>(std::get<1>(key))];
    cell.channel = std::get<2>(key);
    cell.rows = sum.rows;
    cell.chi2 = sum.chi2;
    cell.expected = sum.expected;
    out.cells.push_back(cell);
  }
  SetShares(out.cells);
  std::stable_sort(out.cells.begin(), out.cells.end(),
                   [](const MisfitCell& a, const MisfitCell& b) { return a.share > b.share; });
  out.hops = PartsOf(hops);
  out.trials = PartsOf(trials);
  return out;
}

Eigen::VectorXd RunningEvidence(const Linearisation& at, int column) {
  const Eigen::VectorXd s = at.columns.col(column);
  const double V = s.squaredNorm();
  if (!(V > 0.0)) return Eigen::VectorXd::Zero(at.rows());
  const double weight = s.dot(at.r) / V;
  return weight * s.cwiseProduct(at.r);
}

}  // namespace hoplab
