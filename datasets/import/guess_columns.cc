#include "datasets/import/guess_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/text_rows.h"
#include "datasets/suspect_things.h"

namespace hoplab {
namespace {

constexpr double kGravity_m_per_s2 = 9.81;
constexpr double kFallTolerance =
    0.25;  // of gravity: noise, friction, windows that see some stance

std::vector<double> Numbers(const Table& table, std::size_t column) {
  std::vector<double> values;
  values.reserve(table.columns[column].cells.size());
  for (const std::string_view cell : table.columns[column].cells)
    values.push_back(ParseDouble(cell).value_or(std::nan("")));
  return values;
}

double Factor(const LogUnit& unit) { return unit.factor * std::pow(10.0, unit.power_of_ten); }

std::string Rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string LowerStem(const std::string& name) {
  std::string stem = SplitTitle(name).stem;
  std::transform(stem.begin(), stem.end(), stem.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return stem;
}

bool Increases(const Table& table, std::size_t column) {
  const std::vector<double> values = Numbers(table, column);
  if (values.size() < 2) return false;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1])) return false;
  return true;
}

// Times in seconds by the map, or by sample number where a rate stands in for them.
std::vector<double> Times(const Table& table, const ColumnMap& map) {
  for (const MappedColumn& mapped : map.columns) {
    if (mapped.channel) continue;
    std::vector<double> times = Numbers(table, mapped.column);
    for (double& t : times) t *= Factor(mapped.unit);
    return times;
  }
  return {};
}

// How a column falls in free flight [m/s^2] if it is in metres; NaN if it cannot be told.
double Fall(const Table& table, std::size_t column, const std::vector<double>& times) {
  const std::vector<double> values = Numbers(table, column);
  if (times.empty() || values.size() != times.size()) return std::nan("");
  return ApparentGravity(times, values);
}

bool IsGravity(double fall) { return std::abs(fall / kGravity_m_per_s2 - 1) < kFallTolerance; }

// ---- the parts of names

// Whether a name's last part is an axis or the index of one: "hip.Position.Y", "pos_x", "Z",
// "pelvis_tx", "log.pos(:,2)", "/body/pos[:,1]".
bool IsCoordinate(const std::string& lower_stem) {
  if (lower_stem.empty()) return false;
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

  std::vector<MappedColumn> Guess() {
    // Titles that leave no doubt, the format's own among them. Positions are told by how they move.
    for (const Channel channel : RecordedChannels()) GuessNamed(channel);
    const bool has_height = Has(Channel::kBodyY);
    if (!has_height) GuessHeight();
    if (!Has(Channel::kBodyX) && height_) GuessForward();
    return std::move(guesses_);
  }

 private:
  bool Has(Channel channel) const {
    return std::any_of(guesses_.begin(), guesses_.end(),
                       [&](const MappedColumn& g) { return g.channel == channel; });
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
      std::vector<LogUnit> units;
      if (const auto stated = StatedUnit(i, Dimension::kLength)) {
        units = {*stated};
      } else {
        for (const char* name : {"m", "mm", "cm"}) units.push_back(*FindUnit(name));
      }
      for (const LogUnit& unit : units) {
        // ApparentGravity looks for what falls; upside down it would rise.
        const double fall = per_unit * Factor(unit);
        const double rise = FallUpsideDown(i) * Factor(unit);
        if (IsGravity(fall)) Better({i, unit, false, fall});
        if (IsGravity(rise)) Better({i, unit, true, rise});
      }
    }
    if (!height_) return;
    const bool stated = StatedUnit(height_->column, Dimension::kLength).has_value();
    MappedColumn guess{Channel::kBodyY, height_->column, height_->negate};
    if (!stated) guess.unit = height_->unit;
    guess.why = std::string(height_->negate ? "upside down it " : "") + "falls at " +
                Rounded(height_->fall) + " m/s^2 in flight" +
                (stated ? "" : " if it is in " + height_->unit.name);
    Take(guess);
  }

  double FallUpsideDown(std::size_t column) const {
    std::vector<double> values = Numbers(table_, column);
    if (times_.empty() || values.size() != times_.size()) return std::nan("");
    for (double& v : values) v = -v;
    return ApparentGravity(times_, values);
  }

  void Better(const Height& candidate) {
    const auto off = [](const Height& h) { return std::abs(h.fall / kGravity_m_per_s2 - 1); };
    // Several markers fall alike: a later one must be clearly nearer to take the place.
    if (!height_ || off(candidate) < off(*height_) - 0.05) height_ = candidate;
  }

  // The other coordinate of the same thing that travels furthest.
  void GuessForward() {
    const std::string& name = table_.columns[height_->column].name;
    const std::string thing = ThingOf(LowerStem(name));
    double furthest = 0;
    MappedColumn guess{Channel::kBodyX};
    for (const std::size_t i : Positions()) {
      if (ThingOf(LowerStem(table_.columns[i].name)) != thing) continue;
      const Travel travel = TravelOf(i);
      if (travel.range <= furthest) continue;
      furthest = travel.range;
      guess.column = i;
      guess.negate = travel.net < 0;
    }
    if (furthest == 0) return;
    guess.why =
        std::string("travels furthest beside ") + name + (guess.negate ? ", against its axis" : "");
    if (!StatedUnit(guess.column, Dimension::kLength)) guess.unit = height_->unit;
    Take(guess);
  }

  struct Travel {
    double range = 0, net = 0;  // in the column's unit
  };
  Travel TravelOf(std::size_t column) const {
    const std::vector<double> all = Numbers(table_, column);
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
};

}  // namespace

MappedColumn GuessTime(const Table& table) {
  static constexpr std::array<std::string_view, 8> kNames = {
      "time_s", "time", "t", "timestamp", "zeit", "seconds", "elapsed", "sim_time"};
  for (const std::string_view wanted : kNames) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const std::string& name = table.columns[i].name;
      std::string stem = LowerStem(name);
      const std::size_t parent = stem.find_last_of("/.");  // log.t, /body/t
      if (parent != stem.npos) stem.erase(0, parent + 1);
      if (stem != wanted) continue;
      MappedColumn time{std::nullopt, i};
      time.guessed = name != "time_s" && table.units.count(Dimension::kTime) == 0;
      time.why = time.guessed ? "is called so" : "the format's own name";
      return time;
    }
  }
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string stem = LowerStem(table.columns[i].name);
    if (stem.starts_with("frame") || stem.starts_with("index") || !Increases(table, i)) continue;
    const std::string& unit = table.columns[i].unit;
    if (!unit.empty() && (!FindUnit(unit) || FindUnit(unit)->dimension != Dimension::kTime))
      continue;
    MappedColumn time{std::nullopt, i};
    time.guessed = true;
    time.why = "the first column that increases throughout";
    return time;
  }
  throw InputError({table.file, "", "no column could be told to be the time",
                    "Name it, as --map t=COLUMN:ms, or give the sample rate, as --rate 500."});
}

std::vector<MappedColumn> GuessChannels(const Table& table, const ColumnMap& map) {
  return ChannelGuesser(table, map).Guess();
}

std::optional<GuessedUnit> GuessUnit(const Table& table, const ColumnMap& map,
                                     const MappedColumn& mapped) {
  if (!mapped.channel) {
    std::vector<double> times = Numbers(table, mapped.column);
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    if (steps.empty()) return std::nullopt;
    std::nth_element(steps.begin(), steps.begin() + static_cast<long>(steps.size() / 2),
                     steps.end());
    const double step = steps[steps.size() / 2];
    // A hop lasts some tenths of a second and is sampled a hundred to some thousand times a second.
    const std::string why = "a sample every " + Rounded(step);
    if (step >= 5e-5 && step < 0.1) return GuessedUnit{*FindUnit("s"), why};
    if (step >= 0.1 && step < 50) return GuessedUnit{*FindUnit("ms"), why};
    if (step >= 50 && step < 50'000) return GuessedUnit{*FindUnit("us"), why};
    if (step >= 50'000) return GuessedUnit{*FindUnit("ns"), why};
    return std::nullopt;
  }
  if (TargetDimension(mapped.channel) != Dimension::kLength) return std::nullopt;
  if (mapped.channel == Channel::kBodyY) {
    const double per_unit = Fall(table, mapped.column, Times(table, map));
    for (const char* name : {"m", "mm", "cm"}) {
      const LogUnit unit = *FindUnit(name);
      const double fall = per_unit * Factor(unit);
      if (IsGravity(fall))
        return GuessedUnit{
            unit, "falls at " + Rounded(fall) + " m/s^2 in flight if it is in " + unit.name};
    }
  }
  for (const MappedColumn& other : map.columns)
    if (TargetDimension(other.channel) == Dimension::kLength)
      return GuessedUnit{other.unit, "as " + table.columns[other.column].name};
  return std::nullopt;
}

}  // namespace hoplab
