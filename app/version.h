#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hoplab {

/// "0.2.0".
std::string ProjectVersion();
/// What `git describe` said when this was built; empty outside a repository.
std::string SourceRevision();
/// "GNU 12.2.0".
std::string CompilerVersion();
/// Name and version of the libraries that compute.
std::vector<std::pair<std::string, std::string>> LibraryVersions();

}  // namespace hoplab
