#include "app/terminal/pace.h"

#include <fmt/format.h>

#include <cmath>

#include "app/terminal/quantity.h"

namespace hoplab {
namespace {

constexpr double kMinute = 60.0, kHour = 3600.0;

std::string RateText(double per_second) {
  const auto [rate, unit] = per_second >= 0.1             ? std::pair{per_second, "s"}
                            : per_second >= 0.1 / kMinute ? std::pair{per_second * kMinute, "min"}
                                                          : std::pair{per_second * kHour, "h"};
  return (rate >= 10.0 ? Fixed(rate, 0) : Fixed(rate, 1)) + "/" + unit;
}

}  // namespace

std::string DurationText(Pace::Seconds duration) {
  const long seconds = std::lround(duration.count());
  if (seconds < kMinute) return fmt::format("{} s", seconds);
  if (seconds < kHour) return fmt::format("{} min {} s", seconds / 60, seconds % 60);
  return fmt::format("{} h {} min", seconds / 3600, seconds % 3600 / 60);
}

std::string Pace::Text(long done, long total, Seconds elapsed) const {
  const long finished = done - begun_with_;
  if (finished <= 0 || done >= total || elapsed.count() <= 0.0) return "";
  const double rate = static_cast<double>(finished) / elapsed.count();
  const Seconds left(static_cast<double>(total - done) / rate);
  return RateText(rate) + ", " + DurationText(left) + " left";
}

}  // namespace hoplab
