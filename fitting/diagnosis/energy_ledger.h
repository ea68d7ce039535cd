#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/diagnosis/measure.h"

namespace hoplab {

/// Energy of the body over one hop, kinetic and potential [J]; NaN where it does not show.
struct HopBalance {
  double begin = 0.0, end = 0.0;
  /// Share of `begin` that was lost, negative if gained.
  double LossShare() const { return (begin - end) / begin; }
};

/// One hop, from apex to apex (the first from the start): as the trace shows it, and as each model
/// makes it.
struct HopEnergy {
  HopBalance measured, before;
  std::optional<HopBalance> after;  // absent without an extension
};

/// Energy from hop to hop of one recording. All three columns are read off the channels in the same
/// way, by parabolas through the flights, and weighed with the mass and the gravity of the model
/// before, so that they can be compared.
struct EnergyLedger {
  /// Empty: no trial shows its apexes and its speed along the ground and is simulated to its end.
  std::string recording;
  std::vector<HopEnergy> hops;
};

/// The ledger of a held-out recording (a train one if there is none): the one with most hops.
/// `after` may be null. With trials that are single hops, simulated energies begin and end with
/// each hop on its own.
EnergyLedger LedgerOf(const FittedModel& model, const HeldOutErrors& before,
                      const HeldOutErrors* after);

}  // namespace hoplab
