#pragma once

#include <boost/container/static_vector.hpp>

#include "base/check.h"

namespace hoplab {

/// What guards and rates of a mechanism depend on beside its state, and derivatives do not: on
/// which side of a limit it is, where it searches a root. Written by one instance of a mechanism
/// and read, in the same order, by the same mechanism in another scalar type.
class DiscreteState {
 public:
  void Put(double value) {
    HOPLAB_CHECK(values_.size() < values_.capacity());
    values_.push_back(value);
  }
  double Take() {
    HOPLAB_CHECK(next_ < values_.size());
    return values_[next_++];
  }

 private:
  boost::container::static_vector<double, 128> values_;
  std::size_t next_ = 0;
};

}  // namespace hoplab
