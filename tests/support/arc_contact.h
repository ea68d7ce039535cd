#pragma once

namespace hoplab::testing {

/// From now on MuJoCo meets an ellipsoid on a plane as an arc of a circle: about the ellipsoid's
/// origin, in the x-z plane of its frame, of radius size[0], reaching size[1] [rad] to either side
/// of the z axis. One contact, at the arc's lowest point; none where that is its end towards +x,
/// which is an end of the arc before it, too. A chain of spheres or facets in its place rolls like
/// a cogwheel.
void MeetEllipsoidsAsArcs();

}  // namespace hoplab::testing
