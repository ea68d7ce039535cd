#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace hoplab::testing {

/// The named columns of a table with a line of names, row by row.
inline std::vector<std::vector<std::string>> CsvRows(const std::filesystem::path& file,
                                                     const std::vector<std::string>& columns) {
  std::ifstream lines(file);
  const auto cells = [](const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
    return out;
  };
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells(line);
  std::vector<std::size_t> places;
  for (const std::string& column : columns)
    places.push_back(
        static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin()));
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> row = cells(line);
    rows.emplace_back();
    for (const std::size_t place : places) rows.back().push_back(row.at(place));
  }
  return rows;
}

}  // namespace hoplab::testing
