#pragma once

namespace hoplab::bench {

/// One cell of the published study's table 6.1, with the constants of `experiments/published.yaml`:
/// 15 s of hopping under the speed controller, undamped, from 0.3 m and 1 m/s. False if it does not
/// last so long.
bool RunStudyCell();

}  // namespace hoplab::bench
