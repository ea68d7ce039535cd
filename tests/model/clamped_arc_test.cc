#include "model/laws/clamped/clamped_arc.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/elastica.h"

// The clamped leg, M68-M71, M80, M81, against the elastica's differential equation.

namespace hoplab {
namespace {

using namespace testing;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kR = 0.09, kEI = 4.0, kUnit = kEI / (kR * kR);

// The arc from the contact to the hip, by the elastica's equation: a force on the contact bends
// what lies before it, chi'' = Fx sin(chi) - Fy cos(chi), in units of r and E I/r^2.
struct Shape {
  double x, y;       // of the hip from the contact
  double base;       // psi = -chi there
  double curvature;  // dpsi/dsigma there
};
Shape ShapeOf(double fx, double fy, double tip, double length) {
  using State = std::array<double, 4>;  // x, y, chi, dchi/dsigma
  State z = {0.0, 0.0, -tip, -1.0};
  const auto rate = [&](const State& s, State& d, double) {
    d = {-std::cos(s[2]), -std::sin(s[2]), s[3], fx * std::sin(s[2]) - fy * std::cos(s[2])};
  };
  namespace ode = boost::numeric::odeint;
  ode::integrate_adaptive(ode::make_controlled(1e-13, 1e-13, ode::runge_kutta_fehlberg78<State>()),
                          rate, z, 0.0, length, 0.01);
  return {z[0], z[1], -z[2], -z[3]};
}

// A leg under a load, random; on its toe or rolling.
struct Case {
  Footing foot;
  double fx, fy, tip, arc;
  Shape shape;
  ClampedPlace<double> place;
};
Case RandomCase(std::mt19937& random, bool rolling, double load = 0.15) {
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Case c;
  c.foot = {rolling, 0};
  c.fy = in(0.0, load);
  c.fx = in(-0.7, 0.7) * c.fy;
  c.tip = rolling ? 0.0 : in(0.05, 0.7);
  c.arc = rolling ? in(0.6, 3.1) : std::numbers::pi;
  c.shape = ShapeOf(c.fx, c.fy, c.tip, c.arc);
  const double u = -c.shape.x;
  c.place = {kR * (rolling ? u - c.arc : u),
             kR * c.shape.y,
             c.shape.base,
             in(-1.0, 1.0),
             in(-1.0, 1.0),
             in(-5.0, 5.0)};
  return c;
}
ClampedArc<double> Leg(double tau = 0.0, double mu = kInf) { return {kR, kEI, tau, mu}; }

TEST(ClampedArc, LoadIsThatOfTheElasticasEquation) {
  std::mt19937 random(3);
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Case c = RandomCase(random, i % 2 == 0);
    ClampedArc<double> leg = Leg();
    leg.StartAt(c.tip);
    const ClampedLoad<double> load = leg.At(c.foot, c.place);
    for (double miss : {load.fx / kUnit - c.fx, load.fy / kUnit - c.fy, load.arc - c.arc,
                        load.tip - c.tip, load.moment / (kR * kUnit) - (c.shape.curvature - 1.0)})
      worst = std::max(worst, std::abs(miss));
    // Moments about the hip: the ground's force at the contact is all that acts on the leg.
    const double u = -c.shape.x * kR, y = c.shape.y * kR;
    EXPECT_NEAR(load.moment, u * load.fy + y * load.fx, 1e-9 * kR * kUnit);
  }
  std::printf("clamped arc against its equation: load, arc and moment %.1e\n", worst);
  EXPECT_LT(worst, 1e-10);
}

TEST(ClampedArc, WithoutMomentAtTheHipItIsThePinnedLeg) {
  for (double arc : {1.5, 2.0, 2.6, 3.0}) {
    for (double f : {0.02, 0.1, 0.3}) {
      const PressedArc pinned = SolvePressedArc(arc, kR, kEI, f * kUnit);
      const double angle = pinned.end_angle;
      ClampedArc<double> leg = Leg();
      leg.StartAt(0.0);
      const ClampedLoad<double> load =
          leg.At({true, 0}, {pinned.chord * std::cos(angle) - kR * arc,
                             pinned.chord * std::sin(angle), 2.0 * angle, 0.0, 0.0, 0.0});
      EXPECT_NEAR(load.moment, 0.0, 1e-10 * kR * kUnit);
      EXPECT_NEAR(std::hypot(load.fx, load.fy), f * kUnit, 1e-9 * kUnit);
      EXPECT_NEAR(load.arc, arc, 1e-10);
    }
  }
}

TEST(ClampedArc, ForceAndMomentAreTheSlopesOfItsEnergy) {
  std::mt19937 random(5);
  const double h = 1e-4;
  for (int i = 0; i < 60; ++i) {
    const Case c = RandomCase(random, i % 2 == 0);
    ClampedArc<double> leg = Leg();
    leg.StartAt(c.tip);
    const ClampedLoad<double> load = leg.At(c.foot, c.place);
    const auto slope = [&](double ClampedPlace<double>::*field, double size) {
      const auto energy = [&](double step) {
        ClampedPlace<double> moved = c.place;
        moved.*field += step * size;
        return leg.StrainEnergy(c.foot, moved);
      };
      const double wide = (energy(2 * h) - energy(-2 * h)) / (4 * h * size);
      return (4 * (energy(h) - energy(-h)) / (2 * h * size) - wide) / 3;
    };
    EXPECT_NEAR(slope(&ClampedPlace<double>::lead, kR), load.fx, 1e-7 * kUnit);
    EXPECT_NEAR(slope(&ClampedPlace<double>::height, kR), -load.fy, 1e-7 * kUnit);
    EXPECT_NEAR(slope(&ClampedPlace<double>::base, 1.0), load.moment, 1e-7 * kR * kUnit);
  }
}

// The power the damper takes is tau E I times the integral of the squared rate of the curvature,
// the place in the material held: by differences of the shape.
TEST(ClampedArc, DampingTakesWhatTheMaterialDissipates) {
  std::mt19937 random(11);
  const double tau = 4e-4;
  for (int i = 0; i < 30; ++i) {
    const bool rolling = i % 2 == 0;
    const Case c = RandomCase(random, rolling);
    ClampedArc<double> leg = Leg(tau);
    leg.StartAt(c.tip);
    const ClampedLoad<double> load = leg.At(c.foot, c.place);
    const double power = load.damped_x * c.place.vx + load.damped_y * c.place.vy -
                         load.damped_moment * c.place.base_rate;
    // Curvature at distance s from the hip at a time dt from now; behind the contact that of rest.
    const int points = 2000;
    const double dt = 1e-6;
    const auto curvature = [&](double time) {
      ClampedPlace<double> moved = c.place;
      moved.lead -= time * c.place.vx;
      moved.height += time * c.place.vy;
      moved.base += time * c.place.base_rate;
      ClampedArc<double> own = Leg();
      own.StartAt(c.tip);
      const ClampedLoad<double> at = own.At(c.foot, moved);
      using State = std::array<double, 2>;
      State z = {-moved.base, -(at.moment / (kR * kUnit) + 1.0)};
      // From the hip on: chi grows with s, psi falls.
      std::vector<double> out;
      boost::numeric::odeint::runge_kutta4<State> stepper;
      const double ds = std::numbers::pi / points;
      const double fx = at.fx / kUnit, fy = at.fy / kUnit;
      const auto rate = [&](const State& s, State& d, double) {
        d = {-s[1], -(fx * std::sin(s[0]) - fy * std::cos(s[0]))};
      };
      for (int k = 0; k <= points; ++k) {
        out.push_back(k * ds < at.arc ? -z[1] : 1.0);
        stepper.do_step(rate, z, 0.0, ds);
      }
      return out;
    };
    const std::vector<double> before = curvature(-dt), after = curvature(dt);
    double sum = 0.0;
    for (int k = 0; k < points; ++k) {
      const double a = (after[k] - before[k]) / (2 * dt);
      sum += a * a * std::numbers::pi / points;
    }
    EXPECT_NEAR(-power, tau * kEI / kR * sum, 5e-3 * tau * kEI / kR * sum) << "case " << i;
  }
}

TEST(ClampedArc, DerivativesAreThoseOfDifferences) {
  using J = Jet<kWidestJet>;
  std::mt19937 random(23);
  const double h = 7e-5;
  for (int i = 0; i < 60; ++i) {
    Case c = RandomCase(random, i % 2 == 0, 0.1);
    const int slides = i % 3 == 0 ? (i % 2 ? 1 : -1) : 0;
    c.foot.slides = slides;
    const double mu = slides ? 0.4 : kInf, tau = 3e-4;
    const double compliance = i % 4 < 2 ? 0.0 : 8e-5;
    // Directions: lead, height, base, vx, vy, base_rate, E I, r, the ground's compliance.
    const auto run = [&](const auto& one, const std::function<double(int)>& step) {
      using S = std::decay_t<decltype(one)>;
      const auto put = [&](double value, int k) {
        if constexpr (kJetWidth < S >> 0)
          return Seeded<S>(value, k, 1.0);
        else
          return value + step(k);
      };
      ClampedArc<S> leg(put(kR, 7), put(kEI, 6), S(tau), S(mu), S(0.0), put(compliance, 8));
      leg.StartAt(c.tip);
      return leg.At(c.foot,
                    {put(c.place.lead, 0), put(c.place.height, 1), put(c.place.base, 2),
                     put(c.place.vx, 3), put(c.place.vy, 4), put(c.place.base_rate, 5)},
                    true, true);
    };
    const double sizes[] = {kR, kR, 1.0, 1.0, 1.0, 10.0, kEI, kR, 1e-3};
    const auto exact = run(J(1.0), {});
    const auto numbers = [](const auto& l) {
      return std::array{l.fx,       l.fy,       l.moment,        l.arc, l.tip,
                        l.damped_x, l.damped_y, l.damped_moment, l.slip};
    };
    const auto at = numbers(exact);
    for (int k = 0; k < 9; ++k) {
      const auto moved = [&](double factor) {
        return numbers(run(1.0, [&](int j) { return j == k ? factor * h * sizes[k] : 0.0; }));
      };
      const auto a = moved(1), b = moved(-1), aa = moved(2), bb = moved(-2);
      for (std::size_t n = 0; n < at.size(); ++n) {
        const double wide = (aa[n] - bb[n]) / (4 * h), near = (a[n] - b[n]) / (2 * h);
        const double oracle = (4 * near - wide) / 3;
        EXPECT_NEAR(at[n].v[k] * sizes[k], oracle,
                    1e-7 * (kUnit * 0.3 + std::abs(oracle)) + 1e-2 * std::abs(near - wide))
            << "case " << i << " number " << n << " direction " << k;
      }
    }
  }
}

// Ground that gives way is a spring in series: the leg stands on it as a higher one stands on hard
// ground, its material at the rates of that one, and the two store what the force does.
TEST(ClampedArc, OnGroundThatGivesIsAsOneThatStandsHigher) {
  std::mt19937 random(17);
  const double compliance = 8e-5, tau = 4e-4, inf = kInf;
  double least = inf;
  for (int i = 0; i < 120; ++i) {
    const bool slides = i % 3 == 0;
    Case c = RandomCase(random, i % 2 == 0);
    if (slides) c.foot.slides = i % 4 < 2 ? 1.0 : -1.0;
    const double mu = slides ? 0.4 : inf;
    ClampedArc<double> hard(kR, kEI, tau, mu), soft(kR, kEI, tau, mu, 0.0, compliance);
    hard.StartAt(c.tip);
    soft.StartAt(c.tip);
    const ClampedLoad<double> load = soft.At(c.foot, c.place, true, true);
    ASSERT_TRUE(std::isfinite(load.fy));
    ClampedPlace<double> higher = c.place;
    higher.height += compliance * load.fy;
    // How fast the ground sinks, by differences.
    const auto force_after = [&](double t) {
      ClampedPlace<double> then = c.place;
      then.lead -= c.place.vx * t;
      then.height += c.place.vy * t;
      then.base += c.place.base_rate * t;
      return soft.At(c.foot, then).fy;
    };
    const double h = 1e-6;
    higher.vy += compliance * (force_after(h) - force_after(-h)) / (2.0 * h);
    const ClampedLoad<double> alone = hard.At(c.foot, higher, true, true);
    EXPECT_NEAR(load.fx, alone.fx, 1e-9 * kUnit);
    EXPECT_NEAR(load.fy, alone.fy, 1e-9 * kUnit);
    EXPECT_NEAR(load.moment, alone.moment, 1e-9 * kR * kUnit);
    EXPECT_NEAR(load.arc, alone.arc, 1e-9);
    EXPECT_NEAR(load.lead, alone.lead, 1e-9);
    if (slides) {
      EXPECT_NEAR(load.slip, alone.slip, 1e-6);
    }
    EXPECT_NEAR(soft.StrainEnergy(c.foot, c.place),
                hard.StrainEnergy(c.foot, higher) + 0.5 * compliance * load.fy * load.fy, 1e-9);
    if (slides) continue;  // friction takes its part
    const auto taken = [](const ClampedLoad<double>& on, const ClampedPlace<double>& at) {
      return on.damped_x * at.vx + on.damped_y * at.vy - on.damped_moment * at.base_rate;
    };
    EXPECT_NEAR(taken(load, c.place), taken(alone, higher), 1e-6);
    least = std::min(least, -taken(load, c.place));
  }
  EXPECT_GT(least, 0.0);
}

// Where the arc is bent nearly straight the rule of sixteen nodes is at its worst.
TEST(ClampedArc, SaysHowGoodItsIntegralsAre) {
  std::printf("least kappa   error of the length\n");
  for (double push : {0.05, 0.15, 0.19, 0.205}) {
    const auto sum = clamped::IntegralsOf({0.0, std::numbers::pi}, -push, 0.1);
    double length = 0.0, least = 1.0;
    const int cells = 200000;
    for (int k = 0; k < cells; ++k) {
      const double psi = std::numbers::pi * (k + 0.5) / cells;
      const double kappa =
          std::sqrt(1.0 - 2.0 * push * (1.0 - std::cos(psi)) + 0.2 * std::sin(psi));
      least = std::min(least, kappa);
      length += std::numbers::pi / cells / kappa;
    }
    std::printf("%8.2f      %.0e\n", least, std::abs(sum.one - length));
    EXPECT_NEAR(sum.one, length, 1e-7);
  }
  EXPECT_TRUE(std::isnan(clamped::IntegralsOf({0.0, std::numbers::pi}, -0.25, 0.1).one));
}

// ---- where a search begins ---------------------------------------------------------------------

// A rolling leg under a load, as its hip stands then (M80).
clamped::Stand StandUnder(double fx, double fy, double base) {
  const clamped::Integrals sum = clamped::IntegralsOf(clamped::Tangents(0.0, base), fx, fy);
  return {{.rolling = true, .slides = 0.0}, sum.c - sum.one, sum.s, base, 1.0, std::numbers::pi};
}

TEST(SolveStand, FindsTheLoadWhateverTheLastRootWas) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> load(-0.02, 0.05), angle(1.5, 3.1), far(-30.0, 30.0);
  for (int i = 0; i < 200; ++i) {
    const double fx = load(random), fy = load(random), base = angle(random);
    clamped::Roots roots;
    roots.last.Each([&](double& number) { number = far(random); });
    roots.last.tip = 0.0;
    const clamped::Solution found = SolveStand(StandUnder(fx, fy, base), 1e-12, roots);
    EXPECT_NEAR(found.fx, fx, 1e-12) << i;
    EXPECT_NEAR(found.fy, fy, 1e-12) << i;
  }
}

// Where the hip goes on as before the search begins a hundred times nearer than by slopes alone. It
// ends with its first guess where its steps may be large.
TEST(SolveStand, BeginsWhereTheLastTwoRootsLead) {
  const auto stand_at = [](double t) {
    return StandUnder(0.01 + 0.02 * std::sin(t), 0.03 + 0.02 * std::cos(t), 2.5 + 0.3 * t);
  };
  const auto guess_off = [&](double step, bool forgets) {
    clamped::Roots roots;
    SolveStand(stand_at(0.0), 1e-13, roots);
    SolveStand(stand_at(step), 1e-13, roots);
    if (forgets) roots.before.a = std::numeric_limits<double>::quiet_NaN();
    const clamped::Solution guess = SolveStand(stand_at(2.0 * step), 1.0, roots);
    return std::hypot(guess.fx - (0.01 + 0.02 * std::sin(2.0 * step)),
                      guess.fy - (0.03 + 0.02 * std::cos(2.0 * step)));
  };
  std::printf("first guess off by %.1e, by slopes alone %.1e\n", guess_off(0.02, false),
              guess_off(0.02, true));
  EXPECT_LT(guess_off(0.02, false), 0.01 * guess_off(0.02, true));
  // Of third order where the way curves, that by slopes of second.
  EXPECT_NEAR(guess_off(0.02, false) / guess_off(0.01, false), 8.0, 0.5);
  EXPECT_NEAR(guess_off(0.02, true) / guess_off(0.01, true), 4.0, 0.5);
}

}  // namespace
}  // namespace hoplab
