#include "tests/support/arc_contact.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

namespace hoplab::testing {
namespace {

int MeetArc(const mjModel* model, const mjData* data, mjContact* contact, int plane, int arc,
            mjtNum margin) {
  const mjtNum radius = model->geom_size[3 * arc], half = model->geom_size[3 * arc + 1];
  const mjtNum* frame = data->geom_xmat + 9 * arc;
  const mjtNum* floor = data->geom_xmat + 9 * plane;
  const mjtNum normal[3] = {floor[2], floor[5], floor[8]};
  mjtNum up[3];  // the normal, in the arc's frame
  mju_rotVecMatT(up, normal, frame);
  const mjtNum lowest = std::atan2(up[0], -up[2]);  // from the z axis towards -x
  if (lowest < -half) return 0;
  const mjtNum angle = std::min(lowest, half);
  const mjtNum local[3] = {-radius * std::sin(angle), 0.0, radius * std::cos(angle)};
  mjtNum point[3], above[3];
  mju_rotVecMat(point, local, frame);
  mju_addTo3(point, data->geom_xpos + 3 * arc);
  mju_sub3(above, point, data->geom_xpos + 3 * plane);
  contact->dist = mju_dot3(above, normal);
  if (contact->dist > margin) return 0;
  mju_addScl3(contact->pos, point, normal, -0.5 * contact->dist);
  mju_copy3(contact->frame, normal);
  mju_zero3(contact->frame + 3);
  return 1;
}

}  // namespace

void MeetEllipsoidsAsArcs() { mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_ELLIPSOID] = MeetArc; }

}  // namespace hoplab::testing
