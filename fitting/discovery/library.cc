#include "fitting/discovery/library.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/check.h"
#include "base/text.h"
#include "fitting/discovery/factor.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// Part of a natural size that a missing term is expected to have.
constexpr double kExpected = 0.05;

class Library {
 public:
  Library(const FitProblem& problem, const NaturalScales& scales)
      : problem_(problem), s_(scales), has_stance_(TraitsOf(problem.law).has_stance) {}

  std::vector<Term> Build() {
    BodyForces();
    if (!has_stance_) {
      Impacts();
    } else {
      ChordForces();
      HipTorques();
      Landings();
    }
    Readings();
    Limits();
    Vibrations();
    return std::move(terms_);
  }

 private:
  bool IsDriven() const {
    return std::any_of(problem_.trials.begin(), problem_.trials.end(), [](const TrialProblem& t) {
      return t.parameters.kp > 0.0 || !t.inputs.empty();
    });
  }

  struct Phase {
    std::string text, words;
  };

  void Add(const std::string& place, double expected, const Factor& a, const Phase& phase = {},
           const Factor& b = kOne) {
    const double size = expected / (a.size * b.size);
    const Unit unit =
        *ParseUnit(FindPlace(place)->unit) / (*ParseUnit(a.unit) * *ParseUnit(b.unit));
    std::string text = "c";
    for (const std::string& factor : {a.text, b.text, phase.text})
      if (!factor.empty() && factor != "1") text += " * " + factor;
    if (!seen_.insert(place + text).second) return;
    FormulaSource source;
    source.name = "term_" + std::to_string(terms_.size() + 1);
    source.acts_as = place;
    source.formula = text;
    source.parameters = {{"c", TextOf(unit) == "-" ? "1" : TextOf(unit), 0.0, std::nullopt,
                          -kCoefficientBound * size, kCoefficientBound * size, size}};
    Term term;
    term.words = a.words.empty() && b.words.empty() ? "" : Words(a, b);
    term.phase = phase.words;
    for (const Factor* f : {&a, &b})
      if (!f->variable.empty() && std::find(term.variables.begin(), term.variables.end(),
                                            f->variable) == term.variables.end())
        term.variables.push_back(f->variable);
    source.sentence =
        term.words.empty() ? "a term that is always there" : "a term with " + term.words;
    if (a.power && b.text == "1") {
      term.power = a.power;
      if (!phase.text.empty())
        term.power->rest += (term.power->rest.empty() ? "" : " * ") + phase.text;
    }
    term.effect = &FormulaEffect(source);
    terms_.push_back(std::move(term));
  }
  static std::string Words(const Factor& a, const Factor& b) {
    if (a.words.empty()) return b.words;
    return b.words.empty() ? a.words : a.words + " times " + b.words;
  }

  // ---- places -------------------------------------------------------------------------------

  std::vector<Phase> FlightAndStance() const {
    if (!has_stance_) return {{}};
    return {{}, {"(1 - in_stance)", "in flight"}, {"in_stance", "in stance"}};
  }

  void BodyForces() {
    const double force = kExpected * s_.force;
    const bool guide = std::any_of(problem_.trials.begin(), problem_.trials.end(),
                                   [](const TrialProblem& t) { return t.parameters.on_guide; });
    std::vector<Factor> vx, vy, speed, x, y, t;
    AddSigned(vx, "vx", "m/s", s_.speed, "the speed forward");
    AddSigned(vy, "vy", "m/s", s_.speed, "the speed upward");
    AddPositive(speed, "speed", "m/s", s_.speed, "the speed");
    AddPlain(x, "x", "m", s_.length, "the place");
    AddPlain(y, "y", "m", s_.length, "the height");
    AddPlain(t, "t", "s", s_.time, "time");
    for (const Phase& phase : FlightAndStance()) {
      for (const std::string place : {"body_force_x", "body_force_y"}) {
        const bool forward = place == "body_force_x";
        if (forward && guide) continue;
        Add(place, force, kOne, phase);
        for (const Factor& f : forward ? vx : vy) Add(place, force, f, phase);
        for (const Factor& f : forward ? x : y) Add(place, force, f, phase);
        Add(place, force, forward ? vy[1] : vx[1], phase);
        Add(place, force, t[0], phase);
        // What a wind does.
        Add(place, force, speed[0], phase);
        Add(place, force, speed[0], phase, forward ? vx[1] : vy[1]);
        // Products of place and speed.
        Add(place, force, forward ? x[0] : y[0], phase, forward ? vx[1] : vy[1]);
      }
      Add("body_force_along", force, kOne, phase);
      for (const Factor& f : speed) Add("body_force_along", force, f, phase);
      Add("body_force_along", force, speed[0], phase, y[0]);
      for (const Factor& f : speed) Add("body_force_across", force, f, phase);
    }
  }

  void ChordForces() {
    const double force = kExpected * 2.0 * s_.force;
    constexpr double kCompression = 0.1;
    std::vector<Factor> s, rate, t;
    AddPositive(s, "s", "1", kCompression, "the compression");
    AddSigned(rate, "rate", "m/s", s_.speed, "the rate of the chord");
    AddPlain(t, "t", "s", s_.time, "time");
    const Factor elastic{"elastic", "N", 2.0 * s_.force, "the elastic force", "elastic", {}};
    const Factor stiffness{
        "stiffness",     "N/m",       force / (kExpected * kCompression * s_.length),
        "the stiffness", "stiffness", {}};
    const std::vector<Phase> phases = {
        {}, {"loading", "while the leg is loaded"}, {"(1 - loading)", "while the leg is unloaded"}};
    for (const Phase& phase : phases) {
      Add("chord_force", force, kOne, phase);
      for (const Factor& f : s) Add("chord_force", force, f, phase);
      Add("chord_force", force, elastic, phase);
      Add("chord_force", force, elastic, phase, s[0]);
    }
    for (const Factor& f : rate) {
      Add("chord_force", force, f);
      Add("chord_force", force, f, {}, s[0]);
    }
    Add("chord_force", force, rate[0], {}, elastic);
    Add("chord_force", force, rate[1], {}, elastic);
    Add("chord_force", force, rate[1], {}, s[1]);
    Add("chord_force", force, rate[1], {}, stiffness);
    Add("chord_force", force, elastic, {}, t[0]);
    Add("chord_force", force, s[0], {}, t[0]);
  }

  void HipTorques() {
    const double torque = kExpected * s_.force * s_.length;
    std::vector<Factor> rate, vx, t, angle;
    const double turn = s_.speed / s_.length;
    AddSigned(rate, "rate", "1/s", turn, "the rate of the leg's angle");
    AddSigned(vx, "vx", "m/s", s_.speed, "the speed forward");
    AddPlain(t, "t", "s", s_.time, "time");
    AddPlain(angle, "angle", "1", 1.0, "the leg's angle");
    Add("hip_torque", torque, kOne);
    for (const Factor& f : rate) Add("hip_torque", torque, f);
    for (const Factor& f : vx) Add("hip_torque", torque, f);
    for (const Factor& f : angle) Add("hip_torque", torque, f);
    Add("hip_torque", torque, t[0]);
    if (!IsDriven()) return;
    const Factor motor{"motor", "N m", s_.force * s_.length, "the motor's torque", "motor", {}};
    const Factor sign{"sign(motor)", "1", 1.0, "the direction of the motor's torque", "motor", {}};
    Add("hip_torque", torque, motor);
    Add("hip_torque", torque, sign);
    Add("hip_torque", torque, motor, {}, t[0]);
  }

  void Landings() {
    const double speed = 0.4 * kExpected * s_.speed;
    std::vector<Factor> along, across, vx, hop;
    AddSigned(along, "along", "m/s", s_.speed, "the speed along the chord");
    AddSigned(across, "across", "m/s", s_.speed, "the speed across the chord");
    AddSigned(vx, "vx", "m/s", s_.speed, "the speed forward");
    AddPlain(hop, "hop", "1", 3.0, "the number of the hop");
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
      Add("landing_velocity_along", speed, along[i]);
      Add("landing_velocity_across", speed, across[i]);
    }
    Add("landing_velocity_along", speed, across[1]);
    Add("landing_velocity_across", speed, along[1]);
    constexpr double kAngle = 0.02;
    Add("touchdown_angle", kAngle, kOne);
    Add("touchdown_angle", kAngle, vx[1]);
    Add("touchdown_angle", kAngle, vx[3]);
    Add("touchdown_angle", kAngle, hop[0]);
  }

  void Impacts() {
    std::vector<Factor> speed;
    AddPositive(speed, "speed", "m/s", s_.speed, "the speed of the impact");
    for (const Factor& f : speed) Add("restitution", 0.4 * kExpected, f);
  }

  void Readings() {
    const double length = kExpected * s_.length;
    std::vector<Factor> x, y, vx, vy, t;
    AddPlain(x, "x", "m", s_.length, "the place");
    AddPlain(y, "y", "m", s_.length, "the height");
    AddSigned(vx, "vx", "m/s", s_.speed, "the speed forward");
    AddSigned(vy, "vy", "m/s", s_.speed, "the speed upward");
    AddPlain(t, "t", "s", s_.time, "time");
    for (const std::string place : {"reading_x", "reading_y"}) {
      const bool forward = place == "reading_x";
      if (!Measures(forward ? Channel::kBodyX : Channel::kBodyY)) continue;
      const std::vector<Factor>&own = forward ? x : y, &other = forward ? y : x;
      Add(place, length, kOne);
      Add(place, length, own[0]);
      Add(place, length, own[1]);
      Add(place, length, other[0]);
      // A picture that is not square, and one whose rows are taken one after the other.
      Add(place, length, own[0], {}, other[0]);
      Add(place, length, y[0], {}, forward ? vx[1] : vy[1]);
      Add(place, length, forward ? vx[1] : vy[1]);
      Add(place, length, t[0]);
      Add(place, length, t[1]);
    }
  }

  // ---- with a shape ----------------------------------------------------------------------------

  struct Held {
    std::string name, unit;
    double value, lower, upper, step;
  };
  void AddShaped(const std::string& place, double size, const std::string& unit,
                 const std::string& inside, const std::vector<Held>& held, const std::string& words,
                 const std::string& variable) {
    FormulaSource source;
    source.name = "term_" + std::to_string(terms_.size() + 1);
    source.acts_as = place;
    source.formula = "c * " + inside;
    source.parameters = {
        {"c", unit, 0.0, std::nullopt, -kCoefficientBound * size, kCoefficientBound * size, size}};
    Term term;
    term.shape = TermShape{place + " " + inside, {}};
    for (const Held& h : held) {
      source.parameters.push_back(
          {h.name, h.unit, std::nullopt, h.value, h.lower, h.upper, std::nullopt});
      term.shape->steps.push_back(h.step);
    }
    source.sentence = "a term with " + words;
    term.words = words;
    term.variables = {variable};
    term.effect = &FormulaEffect(source);
    terms_.push_back(std::move(term));
  }

  // A force that begins where something is beyond a limit: a cable, a stop, a wall.
  void Limits() {
    constexpr int kPlaces = 4;
    const auto add = [&](const std::string& place, const std::string& variable, double force,
                         const Extent& range, const std::string& words) {
      if (range.empty()) return;
      const double width = range.most - range.least, step = width / (kPlaces + 1);
      const std::string unit = variable == "s" ? "N" : "N/m";
      for (int k = 1; k <= kPlaces; ++k) {
        const Held limit{"limit",
                         variable == "s" ? "1" : "m",
                         range.least + k * step,
                         range.least + 0.5 * step,
                         range.most - 0.5 * step,
                         step};
        AddShaped(place, force / step, unit, "max(" + variable + " - limit, 0)", {limit},
                  "how far " + words + " is beyond a limit", variable);
        if (variable != "s")
          AddShaped(place, force / step, unit, "max(limit - " + variable + ", 0)", {limit},
                    "how far " + words + " is short of a limit", variable);
      }
    };
    const double force = kExpected * s_.force;
    const bool on_guide = std::any_of(problem_.trials.begin(), problem_.trials.end(),
                                      [](const TrialProblem& t) { return t.parameters.on_guide; });
    if (!on_guide) add("body_force_x", "x", force, s_.x, "the place");
    add("body_force_y", "y", force, s_.y, "the height");
    if (has_stance_) add("chord_force", "s", 2.0 * force, {0.0, 0.2}, "the compression");
  }

  // Something shakes the body or the camera, in step with the start of each trial.
  void Vibrations() {
    if (!has_stance_) return;
    constexpr int kMostPeriods = 12;  // in a trial
    std::vector<double> lengths;
    for (const TrialProblem& t : problem_.trials)
      if (!t.row_times.empty()) lengths.push_back(t.row_times.back());
    if (lengths.empty()) return;
    std::nth_element(lengths.begin(),
                     lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                     lengths.end());
    const double step = 0.5 / RoundedToOneDigit(lengths[lengths.size() / 2]);
    struct Shaken {
      std::string place, unit;
      double size;
    };
    std::vector<Shaken> shaken;
    for (const std::string along : {"x", "y"}) {
      shaken.push_back({"body_force_" + along, "N", kExpected * s_.force});
      if (Measures(along == "x" ? Channel::kBodyX : Channel::kBodyY))
        shaken.push_back({"reading_" + along, "m", 0.1 * kExpected * s_.length});
    }
    for (const auto& [place, unit, size] : shaken) {
      for (int k = 2; k <= 2 * kMostPeriods; ++k) {
        for (const double phase : {0.0, 0.5 * std::numbers::pi}) {
          AddShaped(place, size, unit, "sin(2 * pi * frequency * t + phase)",
                    {{"frequency", "Hz", k * step, 0.5 * step, (2 * kMostPeriods + 2) * step, step},
                     {"phase", "1", phase, -2.0 * std::numbers::pi, 2.0 * std::numbers::pi,
                      2.0 * std::numbers::pi}},
                    "a sine of time", "t");
        }
      }
    }
  }

  bool Measures(Channel channel) const {
    return std::any_of(problem_.channels.begin(), problem_.channels.end(),
                       [&](const ChannelProblem& c) { return c.channel == channel; });
  }

  const FitProblem& problem_;
  const NaturalScales& s_;
  bool has_stance_;
  std::set<std::string> seen_;
  std::vector<Term> terms_;
};

}  // namespace

std::vector<Term> TermLibrary(const FitProblem& problem, const NaturalScales& scales) {
  return Library(problem, scales).Build();
}

}  // namespace hoplab
