#pragma once

#include <string>

namespace hoplab {

/// Where something was read, for messages: "rig-drops/dataset.yaml:12". No part of what it is: two
/// of them are always equal.
struct Origin {
  std::string place;
  bool operator==(const Origin&) const { return true; }
};

}  // namespace hoplab
