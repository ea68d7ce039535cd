#include <cmath>

#include "model/channels/channel_reading.h"

namespace hoplab {
namespace {

// M55: of the body, and as an accelerometer on it reads them, without gravity.
struct Accelerations {
  static constexpr std::array<std::string_view, kMostRead> kNames = {
      "body_ax_m_per_s2", "body_ay_m_per_s2", "imu_ax_m_per_s2", "imu_ay_m_per_s2"};

  template <class T>
  static void Read(const Instant<T>& at, ReadValues<T>& a) {
    using std::cos;
    using std::sin;
    T dz[kMaxStates];
    at.system.Derivative(at.mode, at.time, at.z, dz);
    a[0] = dz[2];
    a[1] = dz[3];
    const T &slope = at.parameters.slope, &g = at.parameters.g;
    const bool level = IsZero(slope);
    const T along = level ? T(0.0) : T(g * sin(slope));
    const T down = level ? g : T(g * cos(slope));
    a[2] = dz[2] + along;
    a[3] = dz[3] + down;
    at.frame.VectorToWorld(a[0], a[1]);
    at.frame.VectorToWorld(a[2], a[3]);
  }
};

}  // namespace

namespace channel_readings {
extern constexpr ChannelReading accelerations = MakeChannelReading<Accelerations>();
}
}  // namespace hoplab
