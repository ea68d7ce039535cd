#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/seed_seq.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cstdint>

namespace hoplab {

/// A numbered stream of random numbers: the same (seed, stream) gives the same numbers on every
/// machine and whatever runs beside it (Boost.Random's distributions are portable, the standard
/// library's are not).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) {
    boost::random::seed_seq words{Low(seed), High(seed), Low(stream), High(stream)};
    engine_.seed(words);
  }
  /// Standard normal.
  double Normal() { return normal_(engine_); }
  /// Uniform in [low, high).
  double Uniform(double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(engine_);
  }

 private:
  static std::uint32_t Low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
  static std::uint32_t High(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace hoplab
