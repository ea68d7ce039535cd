#include "datasets/import/guess_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/column_numbers.h"
#include "datasets/import/guess_robot.h"
#include "datasets/suspect_things.h"

namespace hoplab {
namespace {

// ---- the parts of names

// Where a name's last word begins: "pos_up", "hip.z".
std::size_t LastWordAt(const std::string& lower_stem) {
  const std::size_t before = lower_stem.find_last_of("._ :/-");
  return before == lower_stem.npos ? 0 : before + 1;
}

constexpr std::array<std::string_view, 12> kAxisWords = {"px",  "py",     "pz",         "forward",
                                                         "fwd", "ahead",  "horizontal", "horiz",
                                                         "up",  "upward", "vertical",   "vert"};
bool EndsInAxisWord(const std::string& lower_stem) {
  const std::string_view last = std::string_view(lower_stem).substr(LastWordAt(lower_stem));
  return std::find(kAxisWords.begin(), kAxisWords.end(), last) != kAxisWords.end();
}

// Whether a name's last part is an axis or the index of one: "hip.Position.Y", "pos_x", "Z",
// "pelvis_tx", "pos_up", "log.pos(:,2)", "/body/pos[:,1]".
bool IsCoordinate(const std::string& lower_stem) {
  if (lower_stem.empty()) return false;
  if (EndsInAxisWord(lower_stem)) return true;
  const char last = lower_stem.back();
  if (last == ')' || last == ']') return lower_stem.find(":,") != std::string::npos;
  if (last < 'x' || last > 'z') return false;
  const bool alone =
      lower_stem.size() == 1 ||
      std::string_view("._ :/-").find(lower_stem[lower_stem.size() - 2]) != std::string_view::npos;
  const bool translation =
      lower_stem.size() > 3 && lower_stem.substr(lower_stem.size() - 3, 2) == "_t";
  return alone || translation;
}

// A coordinate's name without its axis.
std::string ThingOf(const std::string& lower_stem) {
  const bool indexed = lower_stem.ends_with(')') || lower_stem.ends_with(']');
  return lower_stem.substr(0, indexed ? lower_stem.find_last_of("([") : lower_stem.size() - 1);
}

// "hip_x" and "hip_z", "forward" and "up".
bool AreAxesOfOneThing(const std::string& lower_stem, const std::string& other) {
  const std::size_t at = LastWordAt(lower_stem);
  const bool by_words = EndsInAxisWord(lower_stem) && EndsInAxisWord(other) &&
                        at == LastWordAt(other) && lower_stem.compare(0, at, other, 0, at) == 0;
  return by_words || ThingOf(lower_stem) == ThingOf(other);
}
// "hip ahead" and "hip high".
bool BeginAlike(const std::string& lower_stem, const std::string& other) {
  const std::size_t at = LastWordAt(lower_stem);
  return at > 0 && at == LastWordAt(other) && lower_stem.compare(0, at, other, 0, at) == 0;
}

struct Height {
  std::size_t column = 0;
  LogUnit unit;
  bool negate = false;
  double fall = 0;
};

class ChannelGuesser {
 public:
  ChannelGuesser(const Table& table, const ColumnMap& map)
      : table_(table), times_(Times(table, map)) {
    for (const MappedColumn& mapped : map.columns) used_.push_back(mapped.column);
  }

  // A robot's columns first: what is a leg's is no hopper's. Its x keeps its sign, which goes with
  // that of pitch and legs.
  void TakeRobot(std::vector<MappedColumn> columns) {
    for (const MappedColumn& column : columns) used_.push_back(column.column);
    guesses_ = std::move(columns);
    of_robot_ = true;
  }

  std::vector<MappedColumn> Guess() {
    // Titles that leave no doubt, the format's own among them. Positions are told by how they move.
    for (const Channel channel : RecordedChannels()) GuessNamed(channel);
    const bool has_height = Has(Channel::kBodyY);
    if (!has_height && of_robot_) NameHeight();
    if (!has_height && !height_) GuessHeight();
    if (!Has(Channel::kBodyX) && height_) GuessForward();
    return std::move(guesses_);
  }
  const std::optional<UnitDoubt>& doubt() const { return doubt_; }

 private:
  static std::vector<LogUnit> HeightUnits() {
    return {*FindUnit("m"), *FindUnit("mm"), *FindUnit("cm")};
  }

  bool Has(Channel channel) const {
    return std::any_of(guesses_.begin(), guesses_.end(),
                       [&](const MappedColumn& g) { return g.target == channel; });
  }

  bool Free(std::size_t column) const {
    return std::find(used_.begin(), used_.end(), column) == used_.end();
  }

  // The unit by the file itself, of a column or of its kind; nothing if it is silent or of another
  // kind.
  std::optional<LogUnit> StatedUnit(std::size_t column, Dimension dimension) const {
    std::string text = table_.columns[column].unit;
    const auto general = table_.units.find(dimension);
    if (text.empty() && general != table_.units.end()) text = general->second;
    const std::optional<LogUnit> unit = FindUnit(text);
    return unit && unit->dimension == dimension ? unit : std::nullopt;
  }

  void Take(MappedColumn guess) {
    guess.guessed = true;
    used_.push_back(guess.column);
    guesses_.push_back(std::move(guess));
  }

  void GuessNamed(Channel channel) {
    const auto& titles = InfoOf(channel).titles;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const std::string stem = LowerStem(table_.columns[i].name);
      const bool match =
          !stem.empty() && std::find(titles.begin(), titles.end(), stem) != titles.end();
      if (!match || !Free(i)) continue;
      const Dimension dimension = DimensionOf(channel);
      const bool other_kind = !table_.columns[i].unit.empty() && !StatedUnit(i, dimension) &&
                              dimension != Dimension::kNone;
      if (other_kind) continue;
      // The format's own name with its own unit is no guess.
      const bool exact = table_.columns[i].name == ChannelName(channel);
      used_.push_back(i);
      MappedColumn guess{channel, i};
      guess.guessed = !exact;
      guess.why = exact ? "the format's own name" : "is called so";
      guesses_.push_back(std::move(guess));
      return;
    }
  }

  // Columns that may be a coordinate of the body.
  std::vector<std::size_t> Positions() const {
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const std::string& unit = table_.columns[i].unit;
      const bool other_unit = !unit.empty() && !StatedUnit(i, Dimension::kLength);
      const bool coordinate = IsCoordinate(LowerStem(table_.columns[i].name)) || !unit.empty();
      if (Free(i) && !other_unit && coordinate) positions.push_back(i);
    }
    return positions;
  }

  void GuessHeight() {
    for (const std::size_t i : Positions()) {
      const double per_unit = Fall(table_, i, times_);
      std::vector<LogUnit> units = HeightUnits();
      if (const auto stated = StatedUnit(i, Dimension::kLength)) units = {*stated};
      for (const LogUnit& unit : units) {
        // ApparentGravity looks for what falls; upside down it would rise.
        const double fall = per_unit * SiFactor(unit);
        const double rise = FallUpsideDown(i) * SiFactor(unit);
        if (IsGravity(fall)) Better({i, unit, false, fall});
        if (IsGravity(rise)) Better({i, unit, true, rise});
      }
    }
    if (!height_) return DoubtUnits();
    const bool stated = StatedUnit(height_->column, Dimension::kLength).has_value();
    MappedColumn guess{Channel::kBodyY, height_->column, height_->negate};
    if (!stated) guess.unit = height_->unit;
    guess.why = std::string(height_->negate ? "upside down it " : "") + "falls at " +
                Rounded(height_->fall) + " m/s^2 in flight" +
                (stated ? "" : " if it is in " + height_->unit.name);
    Take(guess);
  }

  // A height whose unit is not what the file says.
  void DoubtUnits() {
    for (const std::size_t i : Positions()) {
      const double per_unit = Fall(table_, i, times_);
      for (const LogUnit& unit : HeightUnits()) {
        const double fall = per_unit * SiFactor(unit);
        if (!IsGravity(fall)) continue;
        doubt_ = {table_.columns[i].name + " falls at " + Rounded(fall) + " m/s^2 if it is in " +
                      unit.name + ", and not as the file says",
                  MapText(table_, {Channel::kBodyY, i, false, unit, false, ""})};
        return;
      }
    }
  }

  // A robot may walk without ever falling, and its legs brake it as if it fell along x. Of two
  // coordinates of one thing, x and another, the other is the height; of three no name tells.
  void NameHeight() {
    std::vector<std::size_t> heights;
    const std::vector<std::size_t> positions = Positions();
    for (const std::size_t i : positions) {
      const std::string stem = LowerStem(table_.columns[i].name);
      if (!IsCoordinate(stem) || (stem.back() != 'y' && stem.back() != 'z')) continue;
      std::string of_thing;  // the axes of the same thing
      for (const std::size_t j : positions) {
        const std::string other = LowerStem(table_.columns[j].name);
        if (IsCoordinate(other) && ThingOf(other) == ThingOf(stem)) of_thing += other.back();
      }
      if (of_thing.size() == 2 && of_thing.find('x') != of_thing.npos) heights.push_back(i);
    }
    if (heights.size() != 1) return;
    height_ = Height{heights[0], {}, false, 0};
    MappedColumn guess{Channel::kBodyY, heights[0]};
    guess.why = "the coordinate beside x";
    Take(guess);
  }

  double FallUpsideDown(std::size_t column) const {
    std::vector<double> values = ColumnNumbers(table_, column);
    if (times_.empty() || values.size() != times_.size()) return std::nan("");
    for (double& v : values) v = -v;
    return ApparentGravity(times_, values);
  }

  void Better(const Height& candidate) {
    const auto off = [](const Height& h) { return FromGravity(h.fall); };
    // Several markers fall alike: a later one must be clearly nearer to take the place.
    if (!height_ || off(candidate) < off(*height_) - 0.05) height_ = candidate;
  }

  // The other coordinate of the same thing that travels furthest; without one, of what has its
  // first words.
  void GuessForward() {
    if (!GuessForward(AreAxesOfOneThing)) GuessForward(BeginAlike);
  }
  bool GuessForward(bool (*belong)(const std::string&, const std::string&)) {
    const std::string& name = table_.columns[height_->column].name;
    double furthest = 0;
    MappedColumn guess{Channel::kBodyX};
    for (const std::size_t i : Positions()) {
      if (!belong(LowerStem(table_.columns[i].name), LowerStem(name))) continue;
      const Travel travel = TravelOf(i);
      if (travel.range <= furthest) continue;
      furthest = travel.range;
      guess.column = i;
      guess.negate = travel.net < 0 && !of_robot_;
    }
    if (furthest == 0) return false;
    guess.why =
        std::string("travels furthest beside ") + name + (guess.negate ? ", against its axis" : "");
    if (!StatedUnit(guess.column, Dimension::kLength)) guess.unit = height_->unit;
    Take(guess);
    return true;
  }

  struct Travel {
    double range = 0, net = 0;  // in the column's unit
  };
  Travel TravelOf(std::size_t column) const {
    const std::vector<double> all = ColumnNumbers(table_, column);
    std::vector<double> values;
    std::copy_if(all.begin(), all.end(), std::back_inserter(values),
                 [](double v) { return std::isfinite(v); });
    if (values.empty()) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*high - *low, values.back() - values.front()};
  }

  const Table& table_;
  std::vector<double> times_;
  std::vector<std::size_t> used_;
  std::vector<MappedColumn> guesses_;
  std::optional<Height> height_;
  bool of_robot_ = false;
  std::optional<UnitDoubt> doubt_;
};

}  // namespace

Guesses GuessChannels(const Table& table, const ColumnMap& map, std::optional<MechanismKind> type) {
  ChannelGuesser guesser(table, map);
  Guesses guesses;
  if (type.value_or(MechanismKind::kRobot) == MechanismKind::kRobot) {
    Guesses robot = GuessRobot(table, map);
    if (!type && HasUnclearLegs(robot))
      throw InputError({table.file, "", "has a pitch and " + robot.unclear_legs,
                        "Or say --type c_leg, if it is a hopper's."});
    if (type || LooksLikeRobot(robot.columns)) {
      guesser.TakeRobot(std::move(robot.columns));
      guesses.notes = std::move(robot.notes);
    }
  }
  guesses.columns = guesser.Guess();
  guesses.doubt = guesser.doubt();
  return guesses;
}

}  // namespace hoplab
