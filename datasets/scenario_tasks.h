#pragma once

#include <string>
#include <utility>
#include <vector>

#include "datasets/scenario.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

// What a scenario asks for beside its run: a search, a sweep, a dataset.

/// Numbers by the dotted keys they stand at.
using KeyedNumbers = std::vector<std::pair<std::string, double>>;

/// The scenario without these blocks.
YamlNode WithoutTasks(YamlNode root);
/// The run of the scenario with other numbers at these keys. Throws InputError (place `place`) for
/// a key that is not a number's, and for a value that may not stand there.
Scenario ReadRunAt(const YamlNode& root, const KeyedNumbers& values, const std::string& place);

/// Tries values at the keys that a search or sweep varies.
class KeyProbe {
 public:
  explicit KeyProbe(const YamlNode& root) : root_(WithoutTasks(root)) {}
  /// Throws unless each value may stand at its key, all of them together.
  void Try(const KeyedNumbers& values, const std::string& place) const;

 private:
  YamlNode root_;
};

SearchSpec ReadSearch(const YamlCursor& cursor, const KeyProbe& probe);
SweepSpec ReadSweep(const YamlCursor& cursor, const KeyProbe& probe);
/// `root` is the whole scenario's, `scenario` its run.
GenerateSpec ReadGenerate(const YamlCursor& cursor, const YamlNode& root, const Scenario& scenario);

}  // namespace hoplab
