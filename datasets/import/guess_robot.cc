#include "datasets/import/guess_robot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "datasets/import/column_numbers.h"
#include "datasets/import/robot_name.h"

namespace hoplab {
namespace {

using Quantity = RobotName::Quantity;

constexpr int kMostLegs = 4;

struct Candidate {
  std::size_t column = 0;
  RobotName name;
};

ColumnTarget TargetOf(Quantity quantity, int leg) {
  switch (quantity) {
    case Quantity::kPitch:
      return Channel::kBodyPitch;
    case Quantity::kAngle:
      return OfLeg(Channel::kLegAngle1, leg);
    case Quantity::kReference:
      return OfMotor(InputKind::kLegAngle1, leg);
    case Quantity::kTorque:
    case Quantity::kToldTorque:  // the channel is what a motor is told
      return OfLeg(Channel::kHipTorque1, leg);
    case Quantity::kContact:
      return OfLeg(Channel::kContact1, leg);
  }
  return std::nullopt;
}

class RobotGuesser {
 public:
  RobotGuesser(const Table& table, const ColumnMap& map)
      : table_(table), times_(Times(table, map)) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const bool used = std::any_of(map.columns.begin(), map.columns.end(),
                                    [&](const MappedColumn& m) { return m.column == i; });
      const SourceColumn& column = table.columns[i];
      const auto name = used ? std::nullopt : ReadRobotName(column.name, column.unit);
      if (name && !(name->quantity == Quantity::kContact && !IsZeroOrOne(i)))
        candidates_.push_back({i, *name});
    }
  }

  Guesses Guess() {
    NumberLegs();
    for (const Candidate& candidate : candidates_) Sort(candidate);
    for (const auto& [target, columns] : columns_) TakeOne(target, columns);
    DropReferencesOfSomeMotors();
    GuessUnits();
    return std::move(guesses_);
  }

 private:
  bool IsZeroOrOne(std::size_t column) const {
    const std::vector<double> values = ColumnNumbers(table_, column);
    return std::all_of(values.begin(), values.end(),
                       [](double v) { return std::isnan(v) || v == 0 || v == 1; });
  }

  // Which leg a number or a place is: the first is the hindmost.
  void NumberLegs() {
    std::set<int> numbers, places;
    for (const Candidate& c : candidates_) {
      if (c.name.number) numbers.insert(*c.name.number);
      if (c.name.place) places.insert(static_cast<int>(*c.name.place));
    }
    first_number_ = numbers.empty() ? 1 : *numbers.begin();
    const int count = static_cast<int>(numbers.size());
    const bool in_row =
        first_number_ <= 1 && (numbers.empty() || *numbers.rbegin() == first_number_ + count - 1);
    numbers_count_ = in_row && count <= kMostLegs;
    if (!numbers_count_) {
      guesses_.unclear_legs =
          std::to_string(count) + " legs by their numbers" +
          (in_row ? "; a robot seen from the side has at most 4. Legs that move together are one"
                  : ", which do not run from 0 or 1 without a gap") +
          ": say which is which, as --map leg_angle_1=COLUMN:deg, hindmost first";
      guesses_.notes.push_back(table_.file + ": " + guesses_.unclear_legs);
    }
    places_.assign(places.begin(), places.end());
    places_count_ = numbers.empty() || !numbers_count_ || places_.size() == numbers.size();
  }

  std::optional<int> LegOf(const RobotName& name) const {
    if (name.quantity == Quantity::kPitch) return 0;
    if (name.number && numbers_count_) return *name.number - first_number_;
    if (!name.place || !places_count_) return std::nullopt;
    return static_cast<int>(
        std::find(places_.begin(), places_.end(), static_cast<int>(*name.place)) - places_.begin());
  }

  void Sort(const Candidate& candidate) {
    if (const std::optional<int> leg = LegOf(candidate.name))
      columns_[TargetOf(candidate.name.quantity, *leg)].push_back(candidate);
  }

  // The format's own name before others, what a motor is told before what it gave.
  void TakeOne(const ColumnTarget& target, const std::vector<Candidate>& columns) {
    std::vector<Candidate> best;
    for (const int rank : {0, 1, 2}) {
      std::copy_if(columns.begin(), columns.end(), std::back_inserter(best),
                   [&](const Candidate& c) {
                     return rank == 2 || (rank == 0 ? IsOwnName(target, c.column)
                                                    : c.name.quantity == Quantity::kToldTorque);
                   });
      if (!best.empty()) break;
    }
    if (best.size() > 1) {
      std::vector<std::string> names;
      for (const Candidate& c : best) names.push_back(table_.columns[c.column].name);
      guesses_.notes.push_back(table_.file + ": " + Printable(Join(names), 200) + " may each be " +
                               TargetName(target) +
                               "; none is taken. Legs that move together are one: say which, as "
                               "--map " +
                               WordOf(target) + "=COLUMN");
      return;
    }
    const Candidate& one = best.front();
    MappedColumn guess{target, one.column};
    guess.guessed = !IsOwnName(target, one.column);
    guess.why = guess.guessed ? Why(one.name, target) : "the format's own name";
    guesses_.columns.push_back(std::move(guess));
  }

  bool IsOwnName(const ColumnTarget& target, std::size_t column) const {
    return table_.columns[column].name == TargetName(target);
  }

  static std::string Why(const RobotName& name, const ColumnTarget& target) {
    if (name.quantity == Quantity::kPitch) return "is called so, if nose up is positive";
    const std::string leg = "leg " + std::to_string(target.Leg() + 1);
    return "is called so; " + leg + (target.Leg() == 0 ? " is the hindmost" : " by its order");
  }

  // Motors follow a log all or none.
  void DropReferencesOfSomeMotors() {
    auto& columns = guesses_.columns;
    int angles = 0, references = 0;
    for (const MappedColumn& c : columns) {
      if (c.target.input)
        ++references;
      else if (TargetDimension(c.target) == Dimension::kAngle && c.target.Leg() >= 0)
        ++angles;
    }
    if (references == 0 || references >= angles) return;
    std::erase_if(columns, [](const MappedColumn& c) { return c.target.input.has_value(); });
    guesses_.notes.push_back(table_.file + ": some motors have a reference and others have none; " +
                             "no reference is taken");
  }

  bool UnitIsOpen(const MappedColumn& c) const {
    return TargetDimension(c.target) == Dimension::kAngle &&
           table_.columns[c.column].unit.empty() && table_.units.count(Dimension::kAngle) == 0;
  }

  // Degrees or radians, one for all angles whose unit stands nowhere. A robot pitched by 1.6 rad
  // has fallen; a leg begins within a turn and turns ten times a second at most.
  void GuessUnits() {
    constexpr double kFallenPitch = 1.6, kTurn = 6.3, kFastest_per_s = 63;
    std::string degrees;
    bool within_a_turn = true;
    for (const MappedColumn& c : guesses_.columns) {
      if (!UnitIsOpen(c)) continue;
      const auto [first, most, rate] = MotionOf(c.column);
      const bool pitch = c.target == Channel::kBodyPitch;
      const std::string& name = table_.columns[c.column].name;
      if (pitch && most > kFallenPitch) degrees = name + " reaches " + Rounded(most);
      if (!pitch && first > kTurn) degrees = name + " begins at " + Rounded(first);
      if (!pitch && rate > kFastest_per_s)
        degrees = name + " turns by " + Rounded(rate) + " a second";
      within_a_turn = within_a_turn && (pitch || most <= kTurn);
    }
    if (degrees.empty() && !within_a_turn) return;
    for (MappedColumn& c : guesses_.columns) {
      if (!UnitIsOpen(c)) continue;
      c.unit = *FindUnit(degrees.empty() ? "rad" : "deg");
      c.guessed = true;
      c.why += degrees.empty() ? "; in rad no leg leaves a turn" : "; in deg, for " + degrees;
    }
  }

  struct Motion {
    double first = 0, most = 0, rate_per_s = 0;  // sizes; the rate over the whole of it
  };
  Motion MotionOf(std::size_t column) const {
    const std::vector<double> values = ColumnNumbers(table_, column);
    Motion motion;
    bool begun = false;
    std::size_t from = 0, to = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) continue;
      if (!begun) motion.first = std::abs(values[from = i]);
      begun = true;
      to = i;
      motion.most = std::max(motion.most, std::abs(values[i]));
    }
    if (to > from && times_.size() == values.size())
      motion.rate_per_s = std::abs((values[to] - values[from]) / (times_[to] - times_[from]));
    return motion;
  }

  const Table& table_;
  std::vector<double> times_;
  std::vector<Candidate> candidates_;
  int first_number_ = 1;
  bool numbers_count_ = true, places_count_ = true;
  std::vector<int> places_;
  std::map<ColumnTarget, std::vector<Candidate>> columns_;
  Guesses guesses_;
};

}  // namespace

Guesses GuessRobot(const Table& table, const ColumnMap& map) {
  return RobotGuesser(table, map).Guess();
}

bool HasUnclearLegs(const Guesses& guesses) {
  const bool pitch = std::any_of(guesses.columns.begin(), guesses.columns.end(),
                                 [](const auto& c) { return c.target == Channel::kBodyPitch; });
  return pitch && !guesses.unclear_legs.empty();
}

bool LooksLikeRobot(const std::vector<MappedColumn>& columns) {
  bool pitch = false, angle = false;
  for (const MappedColumn& column : columns) {
    pitch = pitch || column.target == Channel::kBodyPitch;
    angle = angle || (column.target.channel && column.target.Leg() >= 0 &&
                      TargetDimension(column.target) == Dimension::kAngle);
  }
  return pitch && angle;
}

}  // namespace hoplab
