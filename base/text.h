#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// Text without the blanks and tabs at both ends.
std::string_view Trim(std::string_view text);

/// The number that the whole of `text` writes, in any usual notation: `22e9`, `1.0E-9`, `+3`, `.5`,
/// `5.`; the point is the decimal sign whatever the locale. Infinity where it says so (`inf`,
/// `.inf`) or is too large for a double, NaN for `nan` and `.nan`, in any case; the caller decides
/// whether these are allowed. Nothing for anything else, an empty text included.
std::optional<double> ParseDouble(std::string_view text);

/// The shortest text that ParseDouble reads back as the same double; `nan`, `inf`, `-inf`.
std::string FormatDouble(double value);

/// To three significant digits, for a message.
std::string Rounded(double value);

/// `text` fit for a message of one line: control characters as \xNN, cut after `max_length` bytes.
std::string Printable(std::string_view text, std::size_t max_length = 60);

/// "a, b, c".
std::string Join(const std::vector<std::string>& words, std::string_view separator = ", ");
/// "a, b and c".
std::string Listed(const std::vector<std::string>& words);

/// The number of insertions, deletions, replacements and swaps of neighbours that turn `a` into
/// `b`; letters of other case cost nothing.
std::size_t EditDistance(std::string_view a, std::string_view b);

/// The word of `known` that `word` was meant to be: the nearest by EditDistance, of equals one of
/// the same letters, else the first; where a third of its letters differ the only one it begins.
std::optional<std::string> NearestWord(std::string_view word,
                                       const std::vector<std::string>& known);

/// The remedy for an unknown word: "Did you mean E_Pa?", else "Known: a, b, c."
std::string DidYouMean(std::string_view word, const std::vector<std::string>& known);

}  // namespace hoplab
