#include "model/integrators/integrator_options.h"

namespace hoplab {

std::string_view NameOf(IntegratorKind kind) {
  switch (kind) {
    case IntegratorKind::kDop853:
      return "dop853";
    case IntegratorKind::kErkStep:
      return "erkstep";
    case IntegratorKind::kCvodes:
      return "cvodes";
  }
  return "";
}

std::optional<IntegratorKind> FindIntegrator(std::string_view name) {
  for (IntegratorKind kind :
       {IntegratorKind::kDop853, IntegratorKind::kErkStep, IntegratorKind::kCvodes}) {
    if (NameOf(kind) == name) return kind;
  }
  return std::nullopt;
}

}  // namespace hoplab
