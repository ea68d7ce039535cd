#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// A file of app/reports/texts, as it was when the program was built. Another name is a bug.
std::string_view ReportText(std::string_view name);

/// The texts of an entry in the order of its keys, empty where it has none.
using TextEntry = std::vector<std::string>;

/// The entries of a file of app/reports/texts: lines `key: text`, continued on indented lines and
/// joined by a blank; an empty line ends an entry, `#` begins a remark. Another key, one out of
/// order or an entry without its first key is a bug of the build.
std::vector<TextEntry> EntriesOf(std::string_view file, std::span<const std::string_view> keys);

/// The same of a text.
std::vector<TextEntry> ParseEntries(std::string_view text, std::span<const std::string_view> keys);

}  // namespace hoplab
