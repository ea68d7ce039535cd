#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/import/unit.h"

namespace hoplab {

/// A column of a log; columns of one table may differ in length where the file keeps them apart.
struct SourceColumn {
  std::string name;  // as the file has it: "z [mm]", "hip.Position.Y", "/body/z", "log.pos(:,2)"
  std::string unit;  // what the file says of it, as written there; empty: nothing
  std::vector<std::string_view> cells;  // decimal text in `texts`; empty: missing
};

/// A recorded file as named columns of printed numbers. Numbers of binary files stand here as the
/// shortest text that gives them back.
struct Table {
  Table() = default;
  Table(Table&&) = default;
  Table& operator=(Table&&) = default;
  Table(const Table&) = delete;  // cells point into texts
  Table& operator=(const Table&) = delete;

  std::string file;    // as it was named
  std::string format;  // "OpenSim TRC"
  std::vector<SourceColumn> columns;
  /// Units the file states for all columns of a kind, by dimension, as written there.
  std::map<Dimension, std::string> units;
  std::vector<std::size_t> lines;  // of the rows in a text file; empty for a binary one
  std::vector<std::string> notes;  // what the user should know of how it was read
  std::deque<std::string> texts;

  /// Where a sample stands: "run17.csv:12", or "run17.mat, sample 12".
  std::string Place(std::size_t row) const {
    if (row < lines.size()) return file + ":" + std::to_string(lines[row]);
    return file + ", sample " + std::to_string(row + 1);
  }
};

enum class LogFormat { kCsv, kMotive, kTrc, kStorage, kMat, kHdf5 };

/// "csv", "motive", "trc", "sto", "mat", "hdf5", in the order of LogFormat.
std::vector<std::string> LogFormatNames();

/// The format of a file by its name and, for a .csv, its first words; .csv and .txt are plain CSV
/// where nothing else fits.
LogFormat FormatOfFile(const std::filesystem::path& file);

/// Reads a log. Throws InputError with place, value, rule and remedy if there is no such file or it
/// is not of the format.
Table ReadLog(const std::filesystem::path& file, LogFormat format);

// The readers, one a format; `bytes` is the file's text, `name` how messages call it.
Table ReadPlainCsv(std::string bytes, const std::string& name);
Table ReadMotiveCsv(std::string bytes, const std::string& name);
Table ReadTrc(std::string bytes, const std::string& name);
Table ReadStorage(std::string bytes, const std::string& name);
Table ReadMat(const std::filesystem::path& file);
Table ReadHdf5(const std::filesystem::path& file);

}  // namespace hoplab
