#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "datasets/read_dataset.h"
#include "tests/support/input_error_of.h"

namespace hoplab::testing {

/// A small valid dataset; tests break one line of it. Line numbers in the margin.
inline const char* const kYaml =
    "format: hoplab-dataset/1\n"                                       // 1
    "name: hops\n"                                                     // 2
    "mechanism:\n"                                                     // 3
    "  type: c_leg\n"                                                  // 4
    "  body_mass_kg: 1.0\n"                                            // 5
    "  gravity_m_per_s2: 9.81\n"                                       // 6
    "  leg:\n"                                                         // 7
    "    rest_radius_m: 0.09\n"                                        // 8
    "    E_Pa: 22e9\n"                                                 // 9
    "    G_Pa: 4e9\n"                                                  // 10
    "    width_m: 0.03\n"                                              // 11
    "    thickness_m: 0.0038\n"                                        // 12
    "    damping_N_s_per_m: 3.0\n"                                     // 13
    "channels:\n"                                                      // 14
    "  body_x_m: {sigma: 0.001}\n"                                     // 15
    "  body_y_m: {sigma: estimate}\n"                                  // 16
    "trials:\n"                                                        // 17
    "  - file: a.csv\n"                                                // 18
    "    role: train\n"                                                // 19
    "    touchdown_angle_deg: 25\n"                                    // 20
    "    initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1, vy_m_per_s: 0}\n"  // 21
    "  - file: b.csv\n"                                                // 22
    "    role: test\n"                                                 // 23
    "    touchdown_angle_deg: 30\n";                                   // 24

inline const char* const kCsv =
    "time_s,body_x_m,body_y_m\n"  // 1
    "0,0,0.3\n"                   // 2
    "0.01,0.01,0.2995\n"          // 3
    "0.02,0.02,0.298\n"           // 4
    "0.03,0.03,0.2956\n";         // 5

/// `text` with the first `from` replaced by `to`; a test that breaks nothing is a bug.
inline std::string Replace(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == text.npos) throw std::logic_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

inline Dataset Read(const std::string& yaml, const std::string& csv = kCsv) {
  return ReadDatasetText(yaml, {{"a.csv", csv}, {"b.csv", kCsv}}, "hops");
}

/// kYaml and kCsv with one replacement.
inline Dataset ReadWithYaml(const std::string& from, const std::string& to) {
  return Read(Replace(kYaml, from, to));
}
inline Dataset ReadWithCsv(const std::string& from, const std::string& to) {
  return Read(kYaml, Replace(kCsv, from, to));
}
/// What is said of a dataset; "" if nothing is.
inline std::string ErrorOf(const std::string& yaml, const std::string& csv = kCsv) {
  return InputErrorOf([&] { Read(yaml, csv); });
}
inline std::string ErrorWithYaml(const std::string& from, const std::string& to) {
  return InputErrorOf([&] { ReadWithYaml(from, to); });
}
inline std::string ErrorWithCsv(const std::string& from, const std::string& to) {
  return InputErrorOf([&] { ReadWithCsv(from, to); });
}

}  // namespace hoplab::testing
