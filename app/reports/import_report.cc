#include "app/reports/import_report.h"

#include <filesystem>

#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

std::vector<std::string> MapTable(const ImportResult& made) {
  using enum TextTable::Align;
  TextTable table({kLeft, kLeft, kLeft, kLeft, kLeft});
  table.AddRow({"channel", "column", "in", "", "why"});
  for (std::size_t i = 0; i < made.columns.size(); ++i) {
    const MappedColumn& mapped = made.map.columns[i];
    table.AddRow({TargetName(mapped.target),
                  (mapped.negate ? "-" : "") + Printable(made.columns[i]), mapped.unit.name,
                  mapped.guessed ? "guessed" : "", mapped.guessed ? mapped.why : ""});
  }
  return table.Lines();
}

// One word of a command line, in quotes where it has to be.
std::string ShellWord(const std::string& text) {
  const bool plain = text.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789._-=:/,+@%") == std::string::npos;
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string UnusedColumns(const ImportResult& made) { return Printable(Join(made.unused), 400); }

// "robot, 2 legs"; nothing of a hopper, which is what is taken for granted.
std::string MechanismLine(const std::string& begin, const ImportResult& made) {
  if (made.legs == 0) return "";
  return begin + NameOf(made.type) + ", " + std::to_string(made.legs) +
         (made.legs == 1 ? " leg\n" : " legs\n");
}

}  // namespace

std::string GuessesText(const ImportResult& made) {
  std::string text;
  for (const std::string& line : MapTable(made)) text += line + '\n';
  if (!made.unused.empty()) text += "  not used: " + UnusedColumns(made) + '\n';
  text += MechanismLine("  mechanism: ", made);
  text += "  in words:";
  for (const std::string& word : made.map_texts) text += " --map " + ShellWord(word);
  return text + '\n';
}

std::string ImportReport(const std::string& name, const std::string& out, const ImportResult& made,
                         bool colours) {
  using enum TextTable::Align;
  std::string text = Styled(name, Emphasis::kBold, colours) + "\n\n";
  text += WithHeader(MapTable(made), colours) + '\n';
  TextTable trials({kLeft, kLeft, kLeft, kRight, kRight, kLeft});
  trials.AddRow({"trial", "role", "from", "rows", "seconds", "missing samples"});
  for (const ImportedLog& log : made.logs) {
    std::string missing;
    for (const auto& [target, count] : log.trace.missing)
      missing += (missing.empty() ? "" : ", ") + std::to_string(count) + " of " +
                 WithoutUnit(TargetName(target));
    trials.AddRow({log.file, RoleName(log.role), log.format, std::to_string(log.trace.rows),
                   Fixed(log.trace.last_s - log.trace.first_s, 3), missing});
  }
  text += WithHeader(trials.Lines(), colours) + '\n';
  if (!made.unused.empty()) text += "  not used    " + UnusedColumns(made) + '\n';
  text += MechanismLine("  mechanism   ", made);
  text += "  dataset     " + out + '\n';
  if (made.blanks.empty()) return text;
  return text + "  to fill in  " + std::to_string(made.blanks.size()) + " values in " +
         (std::filesystem::path(out) / "dataset.yaml").string() + ": hoplab check " +
         ShellWord(out) + " lists them\n";
}

}  // namespace hoplab
