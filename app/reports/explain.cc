#include "app/reports/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>

#include "app/reports/effect_advice.h"
#include "app/reports/effect_words.h"
#include "app/reports/glossary.h"
#include "base/text.h"

namespace hoplab {
namespace {

// What stands in equations and advice beside a law's own sentence.
struct LawAdvice {
  Law law;
  std::string_view equation, meaning;
};
constexpr std::array kLawAdvice = {
    LawAdvice{
        Law::kLargeDeflection,
        "The chord of length l carries F with l = l0 - F C - F^2 C2 (M9b), C [m/N] the arc's "
        "compliance by Castigliano (M2), C2 [m/N^2] the next term of the elastica (M2b).",
        "Begin with it. It is good to 2 % of the deflection while F C/l0 stays below 0.2, and "
        "says when it does not. Compare with consistent to see what the second term is worth."},
    LawAdvice{
        Law::kElastica,
        "The arc between hip and contact is an inextensible beam between two pins: "
        "l = r dP/df, u/l = (dP/dphi)/f with its energy P(f, phi), f = F r^2/(E I), solved exactly "
        "and tabulated (M61, M62); normal and shear force to first order.",
        "Use it where the leg bends far. It ends a run where the load is beyond what an arc can "
        "carry before its ends close."},
    LawAdvice{
        Law::kConsistent,
        "The chord of length l carries F with l = l0 - F C (M9); the loaded tip turns by "
        "F C'/2 (M10), C [m/N] the arc's compliance (M2), C' [1/N] its slope along the arc.",
        "Use it for small deflections, or to see what large_deflection adds. A modulus fitted "
        "with it comes out too low where the leg bends far."},
    LawAdvice{
        Law::kNoSlip,
        "F = k(phi) (l0 - l) with k = 1/C [N/m] (M6), and the contact moves by the arc laid "
        "down, dx_c/dt = -r dtheta/dt (M8).",
        "For comparison with the published study. It loses energy without a damper (about 6 % "
        "a hop at 25 deg, 2 % at 45), so a fit makes up for that: do not quote its modulus."},
    LawAdvice{
        Law::kThesis,
        "F = k(phi) (l0 - l) with k = 1/C [N/m] (M6), and the contact moves by "
        "dx_c/dt = -r_d sin(theta) dtheta/dt (M7).",
        "For reproducing the published tables (hoplab reproduce). Its energy is not kept, and "
        "it cannot carry every trace to its end; fits then go hop by hop. The effects "
        "rolling_law and tip_rotation turn it into consistent."},
    LawAdvice{Law::kStraightLeg,
              "F = k (l0 - l) - d dl/dt, k [N/m], d [N s/m], contact fixed in stance.",
              "The spring-loaded inverted pendulum of the literature: the mechanism to test a "
              "controller or an analysis on, and a leg of telescopes or coil springs."},
    LawAdvice{
        Law::kRobot,
        "Each leg is an elastic arc clamped to its motor: kappa^2 = 1 + 2 f_x (cos psi_0 - cos "
        "psi) + 2 f_y (sin psi - sin psi_0) along it, kappa in 1/r, f = F r^2/(E I) (M80); "
        "body, motors and feet as M69 to M76.",
        "For machines with several legs and a body that pitches, as RHex. Free E_1, E_2 to "
        "ask which leg is soft; fix leg_damping if the traces are short."},
    LawAdvice{Law::kBall,
              "vy+ = -restitution vy-, vx+ = (1 - tangential_loss) vx- at each bounce; both are "
              "plain numbers.",
              "The smallest hybrid system: everything has a closed form, so sensors, clocks and a "
              "new effect are tried out here first."},
};

// "spectral radius", "Spectral_Radius": as the glossary writes it.
std::string Key(const std::string& text) {
  std::string key(Trim(text));
  for (char& c : key) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (c == ' ' || c == '_') c = '-';
  }
  return key;
}

bool IsCalled(const GlossaryEntry& entry, const std::string& key) {
  std::istringstream also{std::string(entry.also)};
  return std::find(std::istream_iterator<std::string>(also), {}, key) !=
         std::istream_iterator<std::string>();
}

std::string ParameterSentence(const EffectParameter& p) {
  const std::string unit = p.unit == "-" ? "" : " " + std::string(p.unit);
  return fmt::format(" {} [{}]: {} is no effect, {}{} a size to expect, {} to {} possible.", p.name,
                     p.unit, FormatDouble(p.null), FormatDouble(p.typical), unit,
                     FormatDouble(p.lower), FormatDouble(p.upper));
}

Explanation ExplanationOf(const GlossaryEntry& entry) {
  return {Explanation::Kind::kWord, std::string(entry.word), std::string(entry.what),
          std::string(entry.meaning)};
}

std::vector<Explanation> All() {
  std::vector<Explanation> all;
  for (const Law law : AllLaws()) all.push_back(ExplanationOf(law));
  for (const Effect* effect : AllEffects()) all.push_back(ExplanationOf(*effect));
  for (const GlossaryEntry& entry : Glossary()) all.push_back(ExplanationOf(entry));
  return all;
}

// Texts anywhere in a list of texts or of lists.
bool Names(const Json& value, const std::string& name) {
  if (value.is_string()) return value == name;
  return (value.is_array() || value.is_object()) &&
         std::any_of(value.begin(), value.end(), [&](const Json& v) { return Names(v, name); });
}

}  // namespace

std::string_view NameOf(Explanation::Kind kind) {
  switch (kind) {
    case Explanation::Kind::kEffect:
      return "effect";
    case Explanation::Kind::kLaw:
      return "law";
    case Explanation::Kind::kWord:
      return "word";
  }
  return "";
}

Explanation ExplanationOf(const Effect& effect) {
  const EffectInfo& info = effect.info;
  Explanation e{Explanation::Kind::kEffect, std::string(info.name), "", ""};
  e.what = SentenceOf(effect) + " Its term: " + std::string(info.equation) + ".";
  for (const EffectParameter& p : info.parameters) e.what += ParameterSentence(p);
  const EffectAdvice* advice = AdviceOn(info.name);
  if (advice) e.meaning = std::string(advice->check) + " ";
  e.meaning += info.dissipative ? "It only ever takes energy away. "
                                : "It may put energy in or take it away. ";
  if (advice && !advice->look_alikes.empty())
    e.meaning += "In four driven hops the data move nearly as under " +
                 std::string(advice->look_alikes) + ". ";
  if (info.massless_leg_only) e.meaning += "Not with a toe mass. ";
  e.meaning += fmt::format("Fit it: hoplab fit DATASET --with {}.", info.name);
  return e;
}

Explanation ExplanationOf(Law law) {
  const auto* const advice = std::find_if(kLawAdvice.begin(), kLawAdvice.end(),
                                          [law](const LawAdvice& a) { return a.law == law; });
  // Its sentence begins with the mechanism.
  const std::string sentence(SentenceOf(law));
  return {Explanation::Kind::kLaw, std::string(NameOf(law)),
          fmt::format("A law of the mechanism {} {}", sentence, advice->equation),
          std::string(advice->meaning)};
}

std::optional<Explanation> FindExplanation(const std::string& text) {
  const std::string key = Key(text);
  if (key.empty()) return std::nullopt;
  for (Explanation& e : All()) {
    if (Key(e.name) == key) return std::move(e);
  }
  for (const GlossaryEntry& entry : Glossary()) {
    if (IsCalled(entry, key)) return ExplanationOf(entry);
  }
  return std::nullopt;
}

std::vector<std::string> ExplainedWords() {
  std::vector<std::string> words;
  for (const Explanation& e : All()) words.push_back(e.name);
  return words;
}

Json ExplanationsFor(const Json& record) {
  Json out = Json::object();
  for (const Explanation& e : All()) {
    const bool used = e.kind == Explanation::Kind::kWord || record.value("law", Json()) == e.name ||
                      Names(record.value("effects", Json()), e.name) ||
                      Names(record.value("group", Json()), e.name);
    if (used) out[e.name] = {{"kind", NameOf(e.kind)}, {"what", e.what}, {"meaning", e.meaning}};
  }
  return out;
}

}  // namespace hoplab
