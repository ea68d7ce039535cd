#include "base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>
#include <system_error>

namespace hoplab {
namespace {

// Longer words are no slips of the pen, and the distance costs the product of the lengths.
constexpr std::size_t kLongestWord = 64;

char LowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool SameWord(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return LowerCase(x) == LowerCase(y);
         });
}

// Whether a plain positive number such as `0.001e-400` is below one, from its digits alone.
bool IsBelowOne(std::string_view text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, e);
  const auto point = static_cast<long>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first_digit = static_cast<long>(mantissa.find_first_not_of("0."));
  long exponent = 0;
  if (e < text.size()) {
    std::string_view digits = text.substr(e + 1);
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    const std::from_chars_result result =
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec != std::errc()) return digits.front() == '-';
  }
  return point - first_digit + exponent <= 0;
}

}  // namespace

std::string_view Trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::optional<double> ParseDouble(std::string_view text) {
  text = Trim(text);
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  for (const char* word : {"inf", ".inf", "infinity"}) {
    if (SameWord(text, word)) {
      const double inf = std::numeric_limits<double>::infinity();
      return negative ? -inf : inf;
    }
  }
  if (SameWord(text, "nan") || SameWord(text, ".nan"))
    return std::numeric_limits<double>::quiet_NaN();
  // from_chars would take a second sign and the words above with trailing letters.
  if (text.front() != '.' && (text.front() < '0' || text.front() > '9')) return std::nullopt;

  double value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ptr != end || result.ec == std::errc::invalid_argument) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range) {
    // from_chars does not say which end of the range was passed.
    value = IsBelowOne(text) ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return negative ? -value : value;
}

std::string Rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string FormatDouble(double value) {
  if (value != value) return "nan";
  std::array<char, 40> buffer;
  const std::to_chars_result result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), result.ptr);
  // People write 1e9 and 1e-4 where to_chars has 1e+09 and 1e-04.
  const std::size_t e = text.find('e');
  if (e == text.npos) return text;
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  const std::size_t digits = e + (text[e + 1] == '-' ? 2 : 1);
  if (text[digits] == '0') text.erase(digits, 1);
  return text;
}

std::string Printable(std::string_view text, std::size_t max_length) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    // Cut before a character, not inside its UTF-8 bytes.
    if (i >= max_length && (c & 0xC0) != 0x80) return out + "...";
    if (c < 0x20 || c == 0x7F) {
      out += {'\\', 'x', kHex[c >> 4], kHex[c & 15]};
    } else {
      out += static_cast<char>(c);
    }
  }
  return out;
}

std::string Join(const std::vector<std::string>& words, std::string_view separator) {
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += separator;
    out += word;
  }
  return out;
}

std::string Listed(const std::vector<std::string>& words) {
  if (words.size() < 2) return Join(words);
  return Join({words.begin(), words.end() - 1}) + " and " + words.back();
}

std::size_t EditDistance(std::string_view a, std::string_view b) {
  // Three rows of the usual table: the swap of neighbours looks two rows back.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char x = LowerCase(a[i - 1]);
      const char y = LowerCase(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (x == y ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && x == LowerCase(b[j - 2]) && y == LowerCase(a[i - 2]) && x != y;
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

namespace {

// The one word that goes on where `beginning` ends: "condition" for "condition-number".
std::optional<std::string> OnlyWordThatBegins(std::string_view beginning,
                                              const std::vector<std::string>& known) {
  constexpr std::size_t kShortest = 3;
  if (beginning.size() < kShortest) return std::nullopt;
  std::optional<std::string> only;
  for (const std::string& candidate : known) {
    if (!candidate.starts_with(beginning)) continue;
    if (only && *only != candidate) return std::nullopt;
    only = candidate;
  }
  return only;
}

}  // namespace

namespace {
bool SameLetters(std::string a, std::string b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}
}  // namespace

std::optional<std::string> NearestWord(std::string_view word,
                                       const std::vector<std::string>& known) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t best = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : known) {
    const std::size_t distance = EditDistance(word, candidate);
    const std::size_t allowed =
        std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    // "xeport" is export, not report: letters that changed places are the likelier slip.
    const bool likelier =
        distance < best || (distance == best && SameLetters(std::string(word), candidate) &&
                            !SameLetters(std::string(word), *nearest));
    if (distance <= allowed && likelier) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest ? nearest : OnlyWordThatBegins(word, known);
}

std::string DidYouMean(std::string_view word, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = NearestWord(word, known);
  if (nearest) return "Did you mean " + *nearest + "?";
  return "Known: " + Join(known) + ".";
}

}  // namespace hoplab
