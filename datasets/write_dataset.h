#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/atomic_file.h"
#include "datasets/dataset.h"

namespace hoplab {

struct WriteDatasetOptions {
  bool force = false;  // replace a dataset that stands there
};

/// `text` in double quotes, as YAML reads it back.
std::string QuotedYaml(const std::string& text);

/// The files of a dataset by name: dataset.yaml and one CSV for each trial. Reading them gives an
/// equal dataset, number by number; only a touch-down angle computed in radians may come back one
/// unit in the last place off, since the file has degrees.
std::map<std::string, std::string> FormatDataset(const Dataset& dataset);

/// Writes the dataset to `folder`, whole or not at all. Throws InputError if the folder exists and
/// is not empty (with `force`: if it holds no dataset.yaml), or cannot be written.
void WriteDataset(const Dataset& dataset, const std::filesystem::path& folder,
                  const WriteDatasetOptions& options = {});

}  // namespace hoplab
