#pragma once

#include <stdexcept>
#include <string>

namespace hoplab {

/// A broken invariant inside hoplab: a bug, not bad input. Caught once in `main`, exit code 70.
class BugError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

#define HOPLAB_STRINGIFY_DETAIL(x) #x
#define HOPLAB_STRINGIFY(x) HOPLAB_STRINGIFY_DETAIL(x)
/// Stops with file, line and the condition when an invariant of the program does not hold.
#define HOPLAB_CHECK(condition)                                                          \
  do {                                                                                   \
    if (!(condition))                                                                    \
      throw ::hoplab::BugError(__FILE__ ":" HOPLAB_STRINGIFY(__LINE__) ": " #condition); \
  } while (false)

}  // namespace hoplab
