#include <charconv>

#include "base/text.h"
#include "experiments/identification/study_unit.h"

namespace hoplab {
namespace {

// Words with blanks between them.
class WordWriter {
 public:
  template <class T>
  void Add(const T& value) {
    if (!text_.empty()) text_ += ' ';
    if constexpr (std::is_floating_point_v<T>)
      text_ += FormatDouble(value);
    else
      text_ += std::to_string(value);
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

// The same read back; once a word is missing or wrong it stays `failed`.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : text_(text) {}

  void Get(double& value) {
    const auto number = ParseDouble(Next());
    failed_ |= !number;
    if (number) value = *number;
  }
  template <class T>
  requires std::is_integral_v<T>
  void Get(T& value) {
    const std::string_view word = Next();
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    failed_ |= fault != std::errc() || end != word.data() + word.size();
  }
  void Require(bool holds) { failed_ |= !holds; }
  bool failed() const { return failed_; }
  bool done() const { return text_.empty(); }

 private:
  std::string_view Next() {
    const std::size_t end = std::min(text_.find(' '), text_.size());
    const std::string_view word = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    failed_ |= word.empty();
    return word;
  }

  std::string_view text_;
  bool failed_ = false;
};

void Write(const StudyReading& reading, WordWriter& out) {
  for (const ReadingKey& key : ReadingKeys()) out.Add(key.get(reading.law));
  out.Add(static_cast<int>(reading.liftoff));
}

StudyReading ReadReading(WordReader& in) {
  StudyReading reading;
  for (const ReadingKey& key : ReadingKeys()) {
    int word = 0;
    in.Get(word);
    in.Require(word >= 0 && word < std::ssize(key.words));
    if (!in.failed()) key.set(reading.law, word);
  }
  int liftoff = 0;
  in.Get(liftoff);
  in.Require(liftoff >= 0 && liftoff <= static_cast<int>(LiftoffRule::kRestLength));
  reading.liftoff = static_cast<LiftoffRule>(liftoff);
  return reading;
}

}  // namespace

std::string TextOf(const StudyUnit& unit) {
  WordWriter out;
  out.Add(static_cast<int>(unit.runs));
  Write(unit.reading, out);
  for (const double w : unit.weights) out.Add(w);
  out.Add(unit.free.size());
  for (const StudyConstant c : unit.free) out.Add(static_cast<int>(c));
  for (const double c : unit.constants) out.Add(c);
  out.Add(unit.box);
  out.Add(unit.seed);
  out.Add(unit.budget);
  if (unit.times) out.Add(*unit.times);
  return out.text();
}

std::optional<StudyUnit> UnitOfText(std::string_view text) {
  WordReader in(text);
  StudyUnit unit;
  int runs = 0;
  in.Get(runs);
  unit.runs = static_cast<StudyUnit::Runs>(runs);
  unit.reading = ReadReading(in);
  for (double& w : unit.weights) in.Get(w);
  std::size_t free = 0;
  in.Get(free);
  for (std::size_t i = 0; i < free && !in.failed(); ++i) {
    int constant = 0;
    in.Get(constant);
    if (constant < 0 || constant >= kStudyConstantCount) return std::nullopt;
    unit.free.push_back(static_cast<StudyConstant>(constant));
  }
  for (double& c : unit.constants) in.Get(c);
  in.Get(unit.box);
  in.Get(unit.seed);
  in.Get(unit.budget);
  if (!in.done()) {
    in.Get(unit.times.emplace());
    in.Require(*unit.times >= 0);
  }
  if (in.failed() || !in.done()) return std::nullopt;
  return unit;
}

std::string TextOf(const StudyFit& fit) {
  WordWriter out;
  Write(fit.reading, out);
  for (const double c : fit.constants) out.Add(c);
  out.Add(fit.misfit);
  for (const double p : fit.parts.parts) out.Add(p);
  out.Add(fit.parts.reading);
  out.Add(fit.evaluations);
  return out.text();
}

std::optional<StudyFit> FitOfText(std::string_view text) {
  WordReader in(text);
  StudyFit fit;
  fit.reading = ReadReading(in);
  for (double& c : fit.constants) in.Get(c);
  in.Get(fit.misfit);
  for (double& p : fit.parts.parts) in.Get(p);
  in.Get(fit.parts.reading);
  in.Get(fit.evaluations);
  if (in.failed() || !in.done()) return std::nullopt;
  return fit;
}

}  // namespace hoplab
