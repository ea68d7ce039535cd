#pragma once

#include <string>

#include "app/records/comparison_record.h"
#include "app/records/json_at.h"

namespace hoplab {

/// A run of fit or diagnose, read the same way: of a diagnosis the model with the causes it found.
/// It refers to the record.
class ComparedSide {
 public:
  /// Throws InputError (place: the run.json) for a run of another kind, or one without a result.
  explicit ComparedSide(const ComparedRun& compared);

  const std::string& name() const { return name_; }  // the folder's
  const Json& record() const { return record_; }
  bool is_diagnosis() const { return is_diagnosis_; }
  const Json& parameters() const { return JsonAt(record_, part_ + "/parameters"); }
  /// One of them; null if it was not fitted.
  const Json* parameter(const std::string& name) const;
  /// Whether the model misses more than the noise.
  bool misfit() const { return JsonAt(record_, part_ + "/misfit") == Json(true); }
  /// Errors on fitted and on held-out trials; of an extended model the former are not recorded.
  const Json& train() const { return JsonAt(record_, part_ + "/train"); }
  const Json& test() const;
  double chi2() const { return NumberAt(record_, part_ + "/chi2_per_dof"); }
  const Json& trials() const { return JsonAt(record_, part_ + "/trials"); }
  const Json& mechanism() const;

 private:
  const Json& record_;
  std::string name_, part_;
  bool is_diagnosis_ = false, is_extended_ = false;
};

}  // namespace hoplab
