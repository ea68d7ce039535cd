// What MATLAB keeps of a table: properties data, varnames, nrows, props (with VariableUnits); of a
// timetable: one property, any, a struct with data, varNames, varUnits, numRows, dimNames and
// rowTimes, an object or the struct of a sample rate or step. A duration has millis; a datetime has
// data, complex: milliseconds since 1970 and what these are rounded by.

#include "datasets/import/mat_tables.h"

#include <cmath>

#include "base/input_error.h"
#include "datasets/import/limits.h"
#include "datasets/import/number_block.h"

namespace hoplab {
namespace {

// Where a table keeps what, in either form.
struct Parts {
  const MatValue* data = nullptr;
  std::vector<std::string> names, units;
  double rows = std::nan("");
  const MatValue* times = nullptr;  // of a timetable
  std::string time_name;
};

class TableReader {
 public:
  TableReader(const MatObjects& objects, const MatReference& reference, Table* table)
      : objects_(objects), reference_(reference), table_(table) {}

  std::string Read() {
    const std::optional<MatObject> object = objects_.Find(reference_.value);
    if (!object) return "an array of tables";
    const std::optional<Parts> parts = PartsOf(*object);
    if (!parts)
      return "a form of " + reference_.class_name +
             " that is not known; save table2struct(T, 'ToScalar', true)";
    if (parts->data->cells.size() != parts->names.size())
      Damaged("", "has " + std::to_string(parts->data->cells.size()) + " columns and " +
                      std::to_string(parts->names.size()) + " names");
    if (!(parts->rows >= 0 && parts->rows <= kMostNumbers)) Damaged("", "has no number of rows");
    rows_ = static_cast<std::size_t>(parts->rows);
    if (rows_ < 2) return "fewer than two rows";
    if (parts->times != nullptr) AddTimes(*parts);
    for (std::size_t i = 0; i < parts->names.size(); ++i)
      AddColumns(parts->data->cells[i], parts->names[i],
                 i < parts->units.size() ? parts->units[i] : "");
    return "";
  }

 private:
  [[noreturn]] void Damaged(const std::string& column, const std::string& rule) const {
    throw InputError({table_->file, reference_.name + (column.empty() ? "" : "." + column), rule,
                      "The file is damaged: copy or save it again."});
  }

  void Skip(const std::string& column, const std::string& why) {
    table_->notes.push_back(reference_.name + "." + column + " is not read: " + why);
  }

  static std::optional<Parts> PartsOf(const MatObject& object) {
    Parts parts;
    const MatValue *names = nullptr, *units = nullptr, *rows = nullptr;
    if (const MatValue* any = object.Find("any"); any != nullptr) {
      parts.data = FieldOf(*any, "data");
      names = Long(*any, "useVarNames2048", "varNames2048", FieldOf(*any, "varNames"));
      units = FieldOf(*any, "varUnits");
      rows = FieldOf(*any, "numRows");
      parts.times = FieldOf(*any, "rowTimes");
      const MatValue* kinds =
          Long(*any, "useDimNames2048", "dimNames2048", FieldOf(*any, "dimNames"));
      const std::vector<std::string> words =
          kinds == nullptr ? std::vector<std::string>() : TextsIn(*kinds);
      parts.time_name = words.empty() || words.front().empty() ? "Time" : words.front();
      if (parts.times == nullptr) return std::nullopt;
    } else {
      parts.data = object.Find("data");
      names = object.Find("varnames");
      rows = object.Find("nrows");
      if (const MatValue* props = object.Find("props"); props != nullptr) {
        names = Long(*props, "useVariableNames2048", "VariableNames2048", names);
        units = FieldOf(*props, "VariableUnits");
      }
    }
    if (parts.data == nullptr || parts.data->kind != MatValue::Kind::kCells || names == nullptr ||
        names->kind != MatValue::Kind::kCells || rows == nullptr)
      return std::nullopt;
    parts.names = TextsIn(*names);
    if (units != nullptr) parts.units = TextsIn(*units);
    parts.rows = FirstNumber(*rows);
    return parts;
  }

  // Names of more than 63 letters lie in a field of their own.
  static const MatValue* Long(const MatValue& value, const char* flag, const char* field,
                              const MatValue* otherwise) {
    const MatValue* is_long = FieldOf(value, flag);
    const MatValue* found = FieldOf(value, field);
    return is_long != nullptr && FirstNumber(*is_long) > 0 && found != nullptr ? found : otherwise;
  }

  // Milliseconds that an object of class duration holds; null for another value.
  const MatValue* MillisOf(const MatValue& value) const {
    const std::optional<MatObject> object = objects_.Find(value);
    const MatValue* millis =
        object && object->class_name == "duration" ? object->Find("millis") : nullptr;
    return millis != nullptr && millis->kind == MatValue::Kind::kNumbers ? millis : nullptr;
  }

  void AddTimes(const Parts& parts) {
    const std::string& name = parts.time_name;
    if (parts.times->kind != MatValue::Kind::kStruct) return AddColumns(*parts.times, name, "");
    const MatValue* origin = FieldOf(*parts.times, "origin");
    const MatValue* millis = origin == nullptr ? nullptr : MillisOf(*origin);
    // From a date on: the first row is the beginning.
    const double begin = millis == nullptr ? 0 : FirstNumber(*millis);
    const MatValue* by_rate = FieldOf(*parts.times, "specifiedAsRate");
    const MatValue* rate = FieldOf(*parts.times, "sampleRate");
    const MatValue* step = FieldOf(*parts.times, "stepSize");
    if (by_rate != nullptr && rate != nullptr && FirstNumber(*by_rate) > 0) {
      const double hz = FirstNumber(*rate);
      if (!(hz > 0) || !std::isfinite(hz)) Damaged(name, "has a sample rate that is not above 0");
      return AddOne(name, "s", rows_,
                    [&](std::size_t i) { return begin / 1e3 + static_cast<double>(i) / hz; });
    }
    const MatValue* step_millis = step == nullptr ? nullptr : MillisOf(*step);
    if (step_millis == nullptr) return Skip(name, "times in steps that are no durations");
    const double each = FirstNumber(*step_millis);
    AddOne(name, "ms", rows_, [&](std::size_t i) { return begin + static_cast<double>(i) * each; });
  }

  void AddColumns(const MatValue& value, const std::string& name, const std::string& unit) {
    if (!RefersToObject(value)) {
      if (value.kind != MatValue::Kind::kNumbers) return Skip(name, "no numbers");
      if (!value.imaginary.empty()) return Skip(name, "complex numbers");
      return AddMatrix(value, name, unit);
    }
    if (const MatValue* millis = MillisOf(value); millis != nullptr)
      return AddMatrix(*millis, name, "ms");
    const std::optional<MatObject> object = objects_.Find(value);
    if (!object) return Skip(name, "several objects");
    const MatValue* moments = object->class_name == "datetime" ? object->Find("data") : nullptr;
    if (moments != nullptr) return AddMoments(*moments, name);
    Skip(name, "objects of class " + object->class_name);
  }

  // Dates as the time since the first row, to the nanosecond.
  void AddMoments(const MatValue& value, const std::string& name) {
    const auto* millis = std::get_if<std::vector<double>>(&value.numbers);
    if (value.kind != MatValue::Kind::kNumbers || millis == nullptr ||
        CountOf(value.size) != rows_ || millis->size() != rows_)
      return Skip(name, "dates that are no column");
    const std::vector<double>& rest = value.imaginary;
    const auto part = [&](std::size_t i) { return i < rest.size() ? rest[i] : 0.0; };
    AddOne(name, "ms", rows_, [&](std::size_t i) {
      const double since = ((*millis)[i] - millis->front()) + (part(i) - part(0));
      return std::round(since * 1e6) / 1e6;
    });
    table_->notes.push_back(reference_.name + "." + name +
                            ": dates are read as ms since the first");
  }

  void AddMatrix(const MatValue& value, const std::string& name, const std::string& unit) {
    if (value.size.size() != 2) return Skip(name, "more than two dimensions");
    const std::size_t width = value.size[1];
    if (value.size[0] != rows_)
      Damaged(name, "has " + std::to_string(value.size[0]) + " rows; the table has " +
                        std::to_string(rows_));
    if (width > kWidestMatrix) return Skip(name, "too many columns");
    std::visit(
        [&](const auto& numbers) {
          if (numbers.size() != rows_ * width)
            Damaged(name, "its size and its numbers do not agree");
          for (std::size_t j = 0; j < width; ++j)
            AddOne(width == 1 ? name : name + "(:," + std::to_string(j + 1) + ")",
                   unit.empty() ? SplitTitle(name).unit : unit, rows_,
                   [&](std::size_t i) { return numbers[j * rows_ + i]; });
        },
        value.numbers);
  }

  template <class Next>
  void AddOne(const std::string& name, const std::string& unit, std::size_t rows,
              const Next& next) {
    numbers_ += rows;
    if (numbers_ > kMostNumbers)
      throw InputError({table_->file, reference_.name, "has more than 2e7 numbers",
                        "Save the variables of one recording only."});
    SourceColumn column{reference_.name + "." + name, unit, {}};
    table_->texts.emplace_back();
    column.cells = TextOfNumbers(rows, next, &table_->texts.back());
    table_->columns.push_back(std::move(column));
  }

  const MatObjects& objects_;
  const MatReference& reference_;
  Table* table_;
  std::size_t rows_ = 0, numbers_ = 0;
};

}  // namespace

std::string AddMatTable(const MatObjects& objects, const MatReference& reference, Table* table) {
  return TableReader(objects, reference, table).Read();
}

}  // namespace hoplab
