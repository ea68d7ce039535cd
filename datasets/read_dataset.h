#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "datasets/dataset.h"

namespace hoplab {

/// Reads and checks the dataset in `folder` (format `hoplab-dataset/1`, datasets/README.md). Throws
/// InputError for whatever breaks the format: place as file:line, key or column, value, rule,
/// remedy. Reads nothing outside the folder.
Dataset ReadDataset(const std::filesystem::path& folder);

/// The same from texts in memory: dataset.yaml and the trials' files by name. `place` stands for
/// the folder in messages.
Dataset ReadDatasetText(const std::string& yaml, const std::map<std::string, std::string>& texts,
                        const std::string& place = "");

}  // namespace hoplab
