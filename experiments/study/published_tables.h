#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// Numbers that were printed elsewhere, as `experiments/published/NAME.csv` has them.
struct PublishedTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  // NaN where the cell is empty

  /// A column by its name, which must exist.
  std::vector<double> Column(std::string_view column) const;
};

/// The tables of the folder are part of the program. `name` must be one of them, without `.csv`.
const PublishedTable& FindPublishedTable(std::string_view name);

}  // namespace hoplab
