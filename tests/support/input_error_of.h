#pragma once

#include <string>

#include "base/input_error.h"

namespace hoplab::testing {

/// The message of the InputError that `call` throws; "(no error)" if it throws none.
template <typename Call>
std::string InputErrorOf(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

}  // namespace hoplab::testing
