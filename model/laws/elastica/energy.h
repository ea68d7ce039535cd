#pragma once

#include <array>

#include "model/laws/elastica/grid.h"

namespace hoplab::elastica {

/// A function of the contact arc phi and the load f with its derivatives, [by phi][by f]. Those of
/// more than `kOrder` in all are not set.
template <int kOrder>
using Derivatives = std::array<std::array<double, kOrder + 1>, kOrder + 1>;

/// Whether a pressed arc of that length and load is in the domain of the tables.
bool InDomain(double phi, double f);

/// G of M61, the energy of the pressed arc beside f l0: P = f 2 sin(phi/2) - f^2 G(phi, f).
Derivatives<2> EnergyTo2(double phi, double f);
Derivatives<3> EnergyTo3(double phi, double f);

/// D of M63 with its slopes, by table.
struct Dissipation {
  Derivatives<1> ff, fphi, phiphi;
};
Dissipation DissipationAt(double phi, double f);

/// M121: what a torque t at the hip adds to the chord, over r, and to the cosine of the tip's angle
/// to it, and their slopes by t.
struct TorqueBending {
  Derivatives<2> chord, lead;
  Derivatives<1> chord_t, lead_t;
};
TorqueBending TorqueBendingAt(double phi, double f, double t);
/// The same without slopes by t.
TorqueBending TorqueBendingOf(double phi, double f, double t);

}  // namespace hoplab::elastica
