#pragma once

#include <stdexcept>

namespace hoplab {

/// A command line that says nothing sensible (as `--fix E`, without a value): exit code 64. What it
/// names being wrong (no such parameter) is an InputError instead.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hoplab
