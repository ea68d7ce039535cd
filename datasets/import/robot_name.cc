#include "datasets/import/robot_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

namespace hoplab {
namespace {

using Quantity = RobotName::Quantity;
using Place = RobotName::Place;

// What a word of a title says. A title with any other word is nobody's: "knee", "dot", "filtered".
enum class Word {
  kPitch,     // alone or of the body
  kTheta,     // a leg's angle with a number, else the pitch
  kAngle,     // enough beside a number
  kPosition,  // an angle beside a leg or motor
  kTorque,
  kContact,
  kReference,  // told, not measured
  kLeg,        // or what turns it
  kBody,
  kNothing,  // changes nothing
  kRear,
  kMiddle,
  kFront,
  kSide
};

struct Row {
  Word word;
  std::vector<std::string_view> texts;
};

const std::vector<Row>& Rows() {
  static const std::vector<Row> kRows = {
      {Word::kPitch, {"pitch"}},
      {Word::kTheta, {"theta"}},
      {Word::kAngle, {"angle", "angles", "phi", "q", "qpos"}},
      {Word::kPosition, {"pos", "position", "rot", "rotation", "encoder", "enc"}},
      {Word::kTorque, {"torque", "torques", "tau", "trq", "tq"}},
      {Word::kContact, {"contact", "contacts", "stance"}},
      {Word::kReference,
       {"ref", "reference", "cmd", "command", "commanded", "des", "desired", "setpoint", "target",
        "told"}},
      {Word::kLeg,
       {"leg", "legs", "motor", "motors", "mot", "m", "hip", "hips", "joint", "joints", "foot",
        "feet", "actuator"}},
      {Word::kBody, {"body", "trunk", "torso", "base", "chassis", "imu"}},
      {Word::kNothing,
       {"robot", "log", "data", "in", "meas", "measured", "actual", "act", "state"}},
      {Word::kRear, {"rear", "hind", "back", "aft"}},
      {Word::kMiddle, {"middle", "mid"}},
      {Word::kFront, {"front", "fore"}},
      {Word::kSide, {"left", "right"}},
  };
  return kRows;
}

// "leg", "angle", "1" of "legAngle1", "LEG_ANGLE-1" or "log.legs.angle(:,1)".
std::vector<std::string> WordsOf(std::string_view stem) {
  std::vector<std::string> words;
  char before = ' ';
  for (const char c : stem) {
    const auto is = [](int (*kind)(int), char x) {
      return kind(static_cast<unsigned char>(x)) != 0;
    };
    if (is(std::isalnum, c)) {
      const bool begins = !is(std::isalnum, before) ||
                          is(std::isdigit, c) != is(std::isdigit, before) ||
                          (is(std::isupper, c) && is(std::islower, before));
      if (begins) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    before = c;
  }
  return words;
}

// "lf", "fr", "rr": place and side, in either order; of r and r the one is right, the other rear.
std::optional<Place> PlaceOfPair(const std::string& word) {
  if (word.size() != 2) return std::nullopt;
  static constexpr std::array<std::string_view, 3> kLetters = {"rh", "m", "f"};
  for (const int side : {0, 1}) {
    const char s = word[static_cast<std::size_t>(side)];
    const char p = word[static_cast<std::size_t>(1 - side)];
    if (s != 'l' && s != 'r') continue;
    for (std::size_t place = 0; place < kLetters.size(); ++place)
      if (kLetters[place].find(p) != std::string_view::npos) return static_cast<Place>(place);
  }
  return std::nullopt;
}

class NameReader {
 public:
  // Whether every word is known.
  bool Read(const std::vector<std::string>& words) {
    return !words.empty() &&
           std::all_of(words.begin(), words.end(), [&](const auto& word) { return Take(word); });
  }

  std::optional<RobotName> Name(Dimension unit) {
    const bool is_leg = name_.number.has_value() || name_.place.has_value();
    const std::optional<Quantity> quantity = is_leg ? OfLeg(unit) : OfBody();
    if (!quantity) return std::nullopt;
    name_.quantity = *quantity;
    return name_;
  }

 private:
  bool Take(const std::string& word) {
    if (word.find_first_not_of("0123456789") == std::string::npos) {
      if (name_.number || word.size() > 2) return false;
      name_.number = std::stoi(word);
      return true;
    }
    if (const auto place = PlaceOfPair(word)) {
      name_.has_side = true;
      return SetPlace(*place);
    }
    for (const Row& row : Rows()) {
      if (std::find(row.texts.begin(), row.texts.end(), word) == row.texts.end()) continue;
      has_[static_cast<std::size_t>(row.word)] = true;
      if (row.word == Word::kSide) name_.has_side = true;
      if (row.word < Word::kRear || row.word > Word::kFront) return true;
      return SetPlace(
          static_cast<Place>(static_cast<int>(row.word) - static_cast<int>(Word::kRear)));
    }
    return false;
  }

  bool SetPlace(Place place) {
    if (name_.place) return false;
    name_.place = place;
    return true;
  }

  bool Has(Word word) const { return has_[static_cast<std::size_t>(word)]; }

  std::optional<Quantity> OfBody() const {
    for (const Word other : {Word::kLeg, Word::kTorque, Word::kContact, Word::kReference,
                             Word::kPosition, Word::kSide})
      if (Has(other)) return std::nullopt;
    if (Has(Word::kPitch) || Has(Word::kTheta)) return Quantity::kPitch;
    return std::nullopt;
  }

  std::optional<Quantity> OfLeg(Dimension unit) const {
    if (Has(Word::kPitch) || Has(Word::kBody) || (name_.number && name_.place)) return std::nullopt;
    const bool told = Has(Word::kReference);
    const bool angle = Has(Word::kAngle) || Has(Word::kTheta);
    if (Has(Word::kContact))
      return angle || told ? std::nullopt : std::optional(Quantity::kContact);
    const bool leg = Has(Word::kLeg);
    if (Has(Word::kTorque) || (leg && !angle && unit == Dimension::kTorque)) {
      if (angle) return std::nullopt;
      return told ? Quantity::kToldTorque : Quantity::kTorque;
    }
    if (angle || (leg && (Has(Word::kPosition) || unit == Dimension::kAngle)))
      return told ? Quantity::kReference : Quantity::kAngle;
    return std::nullopt;
  }

  RobotName name_;
  std::array<bool, 16> has_ = {};
};

}  // namespace

std::optional<RobotName> ReadRobotName(const std::string& title, const std::string& unit) {
  const std::optional<LogUnit> stated = FindUnit(unit);
  if (!unit.empty() && !stated) return std::nullopt;
  NameReader reader;
  if (!reader.Read(WordsOf(SplitTitle(title).stem))) return std::nullopt;
  const std::optional<RobotName> name = reader.Name(stated ? stated->dimension : Dimension::kNone);
  const bool other_kind = name && stated && stated->dimension != DimensionOf(name->quantity);
  return other_kind ? std::nullopt : name;
}

Dimension DimensionOf(RobotName::Quantity quantity) {
  switch (quantity) {
    case Quantity::kPitch:
    case Quantity::kAngle:
    case Quantity::kReference:
      return Dimension::kAngle;
    case Quantity::kTorque:
    case Quantity::kToldTorque:
      return Dimension::kTorque;
    case Quantity::kContact:
      return Dimension::kNone;
  }
  return Dimension::kNone;
}

}  // namespace hoplab
