#include "datasets/import/clock_text.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "datasets/import/table.h"
#include "datasets/import/text_rows.h"

namespace hoplab {
namespace {

constexpr std::int64_t kMinute = 60, kHour = 3600, kDay = 86400;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A number of `least` to `most` digits at the beginning, which is taken away.
std::optional<int> TakeNumber(std::string_view* text, std::size_t least, std::size_t most) {
  std::size_t digits = 0;
  while (digits < std::min(most, text->size()) && IsDigit((*text)[digits])) ++digits;
  if (digits < least) return std::nullopt;
  int value = 0;
  std::from_chars(text->data(), text->data() + digits, value);
  text->remove_prefix(digits);
  return value;
}

bool Take(std::string_view* text, char c) {
  if (!text->starts_with(c)) return false;
  text->remove_prefix(1);
  return true;
}

// "10:00:00.125"; hours, minutes and seconds.
std::optional<ClockText> TakeTime(std::string_view* text) {
  const auto hour = TakeNumber(text, 1, 2);
  if (!hour || !Take(text, ':')) return std::nullopt;
  const auto minute = TakeNumber(text, 2, 2);
  if (!minute || !Take(text, ':')) return std::nullopt;
  const auto second = TakeNumber(text, 2, 2);
  if (!second || *hour > 24 || *minute > 59 || *second > 60) return std::nullopt;
  ClockText clock{*hour * kHour + *minute * kMinute + *second, {}, {}, false};
  if (!Take(text, '.') && !Take(text, ',')) return clock;
  const auto end = std::find_if_not(text->begin(), text->end(), IsDigit);
  clock.fraction = text->substr(0, static_cast<std::size_t>(end - text->begin()));
  text->remove_prefix(clock.fraction.size());
  return clock;
}

std::string InCapitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

// "10:00:00 PM", "12:00:00 a.m.": the half of the day that stands behind its time, if one does.
// False where the hour is none of a half.
bool TakeHalf(std::string_view* text, ClockText* clock) {
  *text = Trim(*text);
  for (const auto& [word, is_later] : {std::pair("AM", false), std::pair("PM", true),
                                       std::pair("A.M.", false), std::pair("P.M.", true)}) {
    if (InCapitals(text->substr(0, std::string_view(word).size())) != word) continue;
    const std::int64_t hour = clock->second / kHour;
    if (hour < 1 || hour > 12) return false;
    clock->second += ((is_later ? 12 : 0) - (hour == 12 ? 12 : 0)) * kHour;
    text->remove_prefix(std::string_view(word).size());
    return true;
  }
  return true;
}

// Seconds that a zone is ahead: "Z", "+02:00", "-0430", nothing.
std::optional<std::int64_t> ZoneOf(std::string_view text) {
  text = Trim(text);
  if (text.empty() || text == "Z" || text == "UTC") return 0;
  const std::int64_t sign = text[0] == '-' ? -1 : 1;
  if (!Take(&text, '+') && !Take(&text, '-')) return std::nullopt;
  const auto hours = TakeNumber(&text, 2, 2);
  Take(&text, ':');
  const auto minutes = text.empty() ? std::optional<int>(0) : TakeNumber(&text, 2, 2);
  if (!hours || !minutes || !text.empty()) return std::nullopt;
  return sign * (*hours * kHour + *minutes * kMinute);
}

// Days since 1970 of a date of ISO 8601.
std::optional<std::int64_t> DaysOf(std::string_view text) {
  const auto year = TakeNumber(&text, 4, 4);
  if (!year || (!Take(&text, '-') && !Take(&text, '/'))) return std::nullopt;
  const auto month = TakeNumber(&text, 2, 2);
  if (!month || (!Take(&text, '-') && !Take(&text, '/'))) return std::nullopt;
  const auto day = TakeNumber(&text, 2, 2);
  if (!day || !text.empty()) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

std::optional<std::vector<ClockText>> ClocksOf(const SourceColumn& column) {
  std::vector<ClockText> clocks;
  for (const std::string_view cell : column.cells) {
    const std::optional<ClockText> clock = ParseClockText(cell);
    if (!clock) return std::nullopt;
    const ClockText& first = clocks.empty() ? *clock : clocks.front();
    const bool alike =
        clock->is_dated == first.is_dated && (clock->is_dated || clock->date == first.date);
    if (!alike) return std::nullopt;
    clocks.push_back(*clock);
  }
  if (clocks.empty()) return std::nullopt;
  return clocks;
}

// A clock without a date that goes back by more than half a day has passed midnight. Whether one
// did.
bool GoOnPastMidnight(std::vector<ClockText>& clocks) {
  bool passed = false;
  for (std::size_t i = 1; i < clocks.size() && !clocks.front().is_dated; ++i) {
    while (clocks[i].second < clocks[i - 1].second - kDay / 2) {
      clocks[i].second += kDay;
      passed = true;
    }
  }
  return passed;
}

}  // namespace

std::optional<ClockText> ParseClockText(std::string_view text) {
  text = Trim(text);
  std::string_view date;
  const std::size_t colon = text.find(':');
  if (colon == text.npos) return std::nullopt;
  if (const std::size_t between = text.substr(0, colon).find_last_of("T "); between != text.npos) {
    date = Trim(text.substr(0, between));
    text.remove_prefix(between + 1);
  }
  std::optional<ClockText> clock = TakeTime(&text);
  if (!clock || !TakeHalf(&text, &*clock)) return std::nullopt;
  const std::optional<std::int64_t> zone = ZoneOf(text);
  const bool digits = std::any_of(date.begin(), date.end(), IsDigit);
  if (!zone || (!date.empty() && !digits)) return std::nullopt;
  clock->second -= *zone;
  clock->date = date;
  if (const std::optional<std::int64_t> days = DaysOf(date)) {
    clock->second += *days * kDay;
    clock->is_dated = true;
  }
  return clock;
}

void TurnClocksToSeconds(Table* table) {
  for (SourceColumn& column : table->columns) {
    std::optional<std::vector<ClockText>> clocks = ClocksOf(column);
    if (!clocks) continue;
    const bool past_midnight = GoOnPastMidnight(*clocks);
    const std::int64_t earliest =
        std::min_element(clocks->begin(), clocks->end(), [](const auto& a, const auto& b) {
          return a.second < b.second;
        })->second;
    for (std::size_t i = 0; i < clocks->size(); ++i) {
      const ClockText& clock = (*clocks)[i];
      std::string seconds = std::to_string(clock.second - earliest);
      if (!clock.fraction.empty()) seconds += "." + std::string(clock.fraction);
      column.cells[i] = table->texts.emplace_back(std::move(seconds));
    }
    column.unit = "s";
    table->notes.push_back(column.name +
                           " holds times of the clock: read as seconds since the "
                           "earliest whole one" +
                           (past_midnight ? ", past midnight" : ""));
  }
}

}  // namespace hoplab
