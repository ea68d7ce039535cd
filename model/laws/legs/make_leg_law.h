#pragma once

#include "model/mechanisms/legged_body_inl.h"

namespace hoplab {

/// The registry entry of a law whose leg is LegT.
template <template <class> class LegT>
constexpr LegLaw MakeLegLaw(const LawInfo& info) {
  return {info,
          {[](const auto& setup, auto& to) {
             to.template Emplace<LeggedBody<double, LegT<double>>>(setup);
           },
           [](const auto& setup, auto& to) {
             to.template Emplace<LeggedBody<Jet<1>, LegT<Jet<1>>>>(setup);
           },
           [](const auto& setup, auto& to) {
             to.template Emplace<LeggedBody<Jet<kNarrowJet>, LegT<Jet<kNarrowJet>>>>(setup);
           },
           [](const auto& setup, auto& to) {
             to.template Emplace<LeggedBody<Jet<kWideJet>, LegT<Jet<kWideJet>>>>(setup);
           },
           [](const auto& setup, auto& to) {
             to.template Emplace<LeggedBody<Jet<kWidestJet>, LegT<Jet<kWidestJet>>>>(setup);
           }},
          [](const auto& p, auto& leg) { leg.template Emplace<LegT<double>>(p); },
          [](const auto& p, auto& leg) { leg.template Emplace<LegT<Jet<1>>>(p); },
          [](const auto& p, auto& leg) { leg.template Emplace<LegT<Jet<kNarrowJet>>>(p); },
          [](const auto& p, auto& leg) { leg.template Emplace<LegT<Jet<kWideJet>>>(p); },
          [](const auto& p, auto& leg) { leg.template Emplace<LegT<Jet<kWidestJet>>>(p); }};
}

}  // namespace hoplab
