#include "model/leg_compliance.h"

#include <array>

namespace hoplab {
namespace {

// Below these angles the closed forms lose more digits to cancellation than the series does to
// truncation (tests/model/leg_compliance_test.cc measures both against quadrature).
constexpr double kBendingSeriesBelow = 1.0;
constexpr double kSecondOrderSeriesBelow = 1.5;

// f = sum over k >= 2 of (-1)^k (2k - 2)/(2k + 1)! phi^(2k+1).
constexpr std::array<double, 10> kBendingSeries = {0.016666666666666666,   -0.00079365079365079365,
                                                   1.6534391534391536e-05, -2.0041686708353376e-07,
                                                   1.6059043836821615e-09, -9.1765964781837793e-12,
                                                   3.936040156083729e-14,  -1.3153016394598927e-16,
                                                   3.5231293914104271e-19, -7.7363403412613678e-22};

// g = sum over k >= 3 of c_k phi^(2k+1), c_k rational (first ones 17/13440, -47/322560,
// 1871/283852800), from the product of the sine and cosine series of phi/2 and 3 phi/2.
constexpr std::array<double, 13> kSecondOrderSeries = {
    0.0012648809523809524,   -0.00014570932539682539, 6.5914445797258295e-06,
    -1.6799139927395137e-07, 2.8044931209749382e-09,  -3.335565875935417e-11,
    2.9841497505851529e-13,  -2.0867895457481717e-15, 1.1739186031497388e-17,
    -5.4332172633142731e-20, 2.10665655434656e-22,    -6.9458557220986959e-25,
    1.9719405461205777e-27};

// sum over i of c_i phi^(lowest + 2 i) with its first two derivatives, by Horner in phi^2.
template <std::size_t kTerms>
ShapeValue OddSeries(const std::array<double, kTerms>& c, int lowest, double phi) {
  const double q = phi * phi;
  double s0 = 0.0, s1 = 0.0, s2 = 0.0;
  for (int i = static_cast<int>(kTerms) - 1; i >= 0; --i) {
    const double n = lowest + 2.0 * i;
    s0 = s0 * q + c[i];
    s1 = s1 * q + n * c[i];
    s2 = s2 * q + n * (n - 1.0) * c[i];
  }
  const double low2 = std::pow(phi, lowest - 2);
  return {s0 * low2 * q, s1 * low2 * phi, s2 * low2};
}

}  // namespace

ShapeValue BendingShape(const HalfAngle& a) {
  const double phi = 2.0 * a.h;
  if (phi < kBendingSeriesBelow) return OddSeries(kBendingSeries, 5, phi);
  const double sin_phi = 2.0 * a.sin * a.cos;
  const double cos_phi = 1.0 - 2.0 * a.sin * a.sin;
  return {2.0 * phi - 3.0 * sin_phi + phi * cos_phi, 2.0 - 2.0 * cos_phi - phi * sin_phi,
          sin_phi - phi * cos_phi};
}

ShapeValue AxialShape(const HalfAngle& a) {
  const double sin_phi = 2.0 * a.sin * a.cos;
  const double cos_phi = 1.0 - 2.0 * a.sin * a.sin;
  return {3.0 * sin_phi - 2.0 * a.h, 3.0 * cos_phi - 1.0, -3.0 * sin_phi};
}

ShapeValue ShearShape(const HalfAngle& a) {
  const double phi = 2.0 * a.h;
  const double sin_phi = 2.0 * a.sin * a.cos;
  const double d1 = 2.0 * a.sin * a.sin;
  if (phi < 0.1) {  // phi - sin phi cancels; three terms leave 1e-16 relative below 0.1
    const double q = phi * phi;
    return {phi * q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0))), d1, sin_phi};
  }
  return {phi - sin_phi, d1, sin_phi};
}

ShapeValue SecondOrderShape(const HalfAngle& a) {
  const double phi = 2.0 * a.h;
  if (phi < kSecondOrderSeriesBelow) return OddSeries(kSecondOrderSeries, 7, phi);
  const double h = a.h, S = a.sin, K = a.cos;
  const double S2 = S * S, K2 = K * K;
  const double g = 3.0 * h * h * S * K2 + 9.0 * h * K2 * K - 1.5 * h * K - 8.5 * S * K2 + S;
  // Derivatives with respect to h, then d/dphi = (1/2) d/dh.
  const double g1 =
      h * h * K * (3.0 * K2 - 6.0 * S2) - 21.0 * h * S * K2 + 1.5 * h * S + 16.5 * S2 * K;
  const double g2 = h * h * S * (6.0 * S2 - 21.0 * K2) + h * K * (30.0 * S2 - 15.0 * K2 + 1.5) +
                    12.0 * S * K2 + 1.5 * S - 16.5 * S2 * S;
  return {g, 0.5 * g1, 0.25 * g2};
}

}  // namespace hoplab
