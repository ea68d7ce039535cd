#include "model/laws/clamped/clamped_rod.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>

// The straight clamped leg by itself, M97.

namespace hoplab {
namespace {

constexpr double kHolds = std::numeric_limits<double>::infinity();
constexpr double kLength = 0.18, kAlong = 4000.0, kAcross = 2e4;

ClampedRod<double> Rod(double tau = 0.0, double mu = kHolds) {
  return {kLength, kAlong, kAcross, tau, mu};
}

class RandomRods {
 public:
  explicit RandomRods(unsigned seed) : engine_(seed) {}
  double In(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  // A leg that is pressed by up to a fifth, bent by up to 2 cm, and moves.
  ClampedPlace<double> Place() {
    const double beta = In(-0.7, 0.7), a = kLength * In(0.8, 1.0), b = In(-0.02, 0.02);
    const double s = std::sin(beta), c = std::cos(beta);
    return {a * s + b * c, a * c - b * s, std::numbers::pi - beta,
            In(-1.0, 1.0), In(-1.0, 1.0), In(-5.0, 5.0)};
  }

 private:
  std::mt19937 engine_;
};

// Where a foot that holds is seen from the hip a while later.
ClampedPlace<double> After(ClampedPlace<double> place, double time) {
  place.lead -= place.vx * time;
  place.height += place.vy * time;
  place.base += place.base_rate * time;
  return place;
}

// Along the leg and across it.
struct RodShape {
  double a, b;
};
RodShape RodShapeAt(const ClampedPlace<double>& place, double lead) {
  const double s = std::sin(place.base), c = -std::cos(place.base);
  return {lead * s + place.height * c, lead * c - place.height * s};
}

TEST(ClampedRod, ForceAndMomentAreTheSlopesOfItsEnergy) {
  RandomRods random(1);
  double worst = 0.0;
  for (int n = 0; n < 200; ++n) {
    const ClampedPlace<double> place = random.Place();
    const ClampedLoad<double> load = Rod().At({false, 0}, place);
    const auto slope = [&](double ClampedPlace<double>::*by) {
      const auto at = [&](double step) {
        ClampedPlace<double> moved = place;
        moved.*by += step;
        return Rod().StrainEnergy({false, 0}, moved);
      };
      const double h = 1e-3;  // quadratic in places: no error but rounding
      const auto wide = (at(h) - at(-h)) / (2 * h), half = (at(h / 2) - at(-h / 2)) / h;
      return (4.0 * half - wide) / 3.0;
    };
    // The hip moves forward as the lead falls; Psi falls as beta grows.
    const double scale = 200.0;
    worst = std::max({worst, std::abs(load.fx - slope(&ClampedPlace<double>::lead)) / scale,
                      std::abs(load.fy + slope(&ClampedPlace<double>::height)) / scale,
                      std::abs(load.moment - slope(&ClampedPlace<double>::base)) / scale});
    // The moment of the ground's force about the hip.
    EXPECT_NEAR(load.moment, place.lead * load.fy + place.height * load.fx, 1e-11 * scale);
    EXPECT_TRUE(std::isnan(load.arc));
  }
  std::printf("a rod's force and moment against its energy: %.1e\n", worst);
  EXPECT_LT(worst, 1e-8);
}

// A foot that slides: on the edge of its cone, its velocity the rate of where it is.
TEST(ClampedRod, SlidesOnTheEdgeOfItsCone) {
  RandomRods random(2);
  for (int n = 0; n < 200; ++n) {
    const double mu = random.In(0.2, 1.0), way = n % 2 == 0 ? 1.0 : -1.0;
    const ClampedRod<double> rod = Rod(0.0, mu);
    const ClampedPlace<double> place = random.Place();
    const Footing foot{false, way};
    if (!rod.CanSlide(way, foot, place)) continue;
    const ClampedLoad<double> load = rod.At(foot, place, false, true);
    EXPECT_NEAR(load.fx, -way * mu * load.fy, 1e-10);
    const double h = 1e-6;
    const double rate =
        (rod.At(foot, After(place, h)).lead - rod.At(foot, After(place, -h)).lead) / (2 * h);
    EXPECT_NEAR(load.slip, place.vx + rate, 1e-7);
    // The same place, held.
    ClampedPlace<double> held = place;
    held.lead = load.lead;
    EXPECT_NEAR(rod.At({false, 0}, held).fy, load.fy, 1e-10);
  }
}

// What the damping takes is twice Rayleigh's function, of a foot that holds and of one that slides.
TEST(ClampedRod, DampingTakesWhatTheMaterialDissipates) {
  RandomRods random(3);
  const double tau = 4e-4;
  for (int n = 0; n < 200; ++n) {
    const double mu = random.In(0.2, 0.8), way = n % 3 - 1.0;
    const ClampedRod<double> rod = Rod(tau, mu);
    const ClampedPlace<double> place = random.Place();
    const Footing foot{false, way};
    if (way != 0.0 && !rod.CanSlide(way, foot, place)) continue;
    const ClampedLoad<double> load = rod.At(foot, place);
    const double h = 1e-6;
    const auto shape = [&](double time) {
      const ClampedPlace<double> at = After(place, time);
      return RodShapeAt(at, rod.At(foot, at).lead);
    };
    const RodShape up = shape(h), down = shape(-h);
    const double da = (up.a - down.a) / (2 * h), db = (up.b - down.b) / (2 * h);
    const double taken =
        -load.damped_x * place.vx - load.damped_y * place.vy + load.damped_moment * place.base_rate;
    EXPECT_NEAR(taken, tau * (kAlong * da * da + kAcross * db * db), 1e-6 * (1.0 + taken)) << n;
    if (way != 0.0) {
      EXPECT_EQ(load.damped_x, 0.0);
    } else {
      EXPECT_NEAR(load.damped_moment, place.lead * load.damped_y + place.height * load.damped_x,
                  1e-11);
    }
  }
}

// Mass and inertia are those of points along it, and it reaches as far as it is long.
TEST(ClampedRod, IsAUniformRod) {
  const double beta = 0.4, mass = 0.03;
  const int points = 2000;
  double x = 0.0, y = 0.0, inertia = 0.0;
  for (int i = 0; i < points; ++i) {
    const double at = kLength * (i + 0.5) / points;
    x += at * std::sin(beta) / points;
    y -= at * std::cos(beta) / points;
    inertia += mass * at * at / points;
  }
  const double length = Rod().unit_length();
  EXPECT_NEAR(length * Rod().Centre(beta).x, x, 1e-12);
  EXPECT_NEAR(length * Rod().Centre(beta).y, y, 1e-12);
  EXPECT_NEAR(mass * length * length * Rod().kInertia, inertia, 1e-10);
  EXPECT_DOUBLE_EQ(Rod().Reach(beta), kLength * std::cos(beta));
  EXPECT_LT(Rod().Reach(2.0), 0.0);  // one that points up does not reach
}

// A foot that lands sliding goes the way it is told, and is pressed; one that holds is in its cone.
TEST(ClampedRod, LandsTheWayItGoesOn) {
  RandomRods random(4);
  int held = 0, forward = 0, backward = 0;
  for (int n = 0; n < 3000; ++n) {
    const double mu = random.In(0.1, 2.0), beta = random.In(-1.3, 1.3);
    const ClampedRod<double> rod = Rod(0.0, mu);
    const double vx = random.In(-2.0, 2.0), vy = -random.In(0.01, 2.0);
    const double base = std::numbers::pi - beta;
    const double way = rod.SlidesAtLanding(0.0, base, vx, vy);
    // Just after, the base at rest: the hip moves as the point of contact.
    const double dt = 1e-7;
    ClampedPlace<double> place =
        After({kLength * std::sin(beta), kLength * std::cos(beta), base, vx, vy, 0.0}, dt);
    const ClampedLoad<double> load = rod.At({false, way}, place, false, way != 0.0);
    if (way == 0.0) {
      ++held;
      EXPECT_LE(std::abs(load.fx), mu * load.fy * (1 + 1e-6)) << beta;
    } else {
      ++(way > 0.0 ? forward : backward);
      EXPECT_GT(way * load.slip, 0.0) << beta << " " << vx << " " << vy << " " << mu;
    }
    EXPECT_GT(load.fy, 0.0);
  }
  std::printf("landings of a rod: %d hold, %d slide forward, %d backward\n", held, forward,
              backward);
  EXPECT_GT(std::min({held, forward, backward}), 300);
}

}  // namespace
}  // namespace hoplab
