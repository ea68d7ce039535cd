#pragma once

#include <string_view>

namespace hoplab::testing {

/// Reads hostile bytes as a dataset in memory, or as a scenario: what stands before the first line
/// `%%%` is the YAML, what stands behind it the file a.csv. An InputError is the only allowed way
/// out of the readers; a dataset that reads must come back equal from the writer. Throws whatever
/// else comes up, and BugError if the written dataset differs.
void ReadHostileBytes(std::string_view bytes);

}  // namespace hoplab::testing
