
/* ---- what every law shares ---------------------------------------------------------------------- */

/* Force along the chord: elastic, damper, effects. */
static double leg_chord_force(double y, const leg_instant *s) {
  double force = s->elastic - LEG_D * s->rate;
@CHORD@  force += (y * s->viscous_y - s->u * s->viscous_x) / s->l;
  return force;
}

void leg_start(leg_state *leg) {
  leg->mode = LEG_FLIGHT;
  leg->placed = 0;
  leg->contact = leg->f = 0.0;
  leg->phi = LEG_PI;
}

double leg_torque(double vx) {
  const double torque = LEG_KP * (LEG_V_DES - vx);
  return fmin(fmax(torque, -LEG_MOST_TORQUE), LEG_MOST_TORQUE);
}

double leg_touchdown_angle(double commanded, double vx) {
@ANGLE@}

double leg_touchdown_height(double angle) {
/*@if STRAIGHT*/
  return LEG_L0 * cos(angle);
/*@else*/
  return angle > 0.0 ? LEG_R * (1.0 + cos(angle)) : 2.0 * LEG_R * cos(angle);
/*@end*/
}

int leg_load_at(leg_state *leg, const leg_hip *hip, leg_load *load) {
  return leg_load_driven(leg, hip, leg->mode == LEG_FLIGHT ? 0.0 : leg_torque(hip->vx), load);
}

int leg_load_driven(leg_state *leg, const leg_hip *hip, double motor, leg_load *load) {
  static const leg_load none = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const double y = hip->y;
  double force, normal, across;
  leg_instant s;
  *load = none;
  if (leg->mode == LEG_FLIGHT) return 0;
  if (leg_solve(leg, hip, &s) != 0 || !(fabs(s.elastic) < HUGE_VAL)) return 1;
  force = leg_chord_force(y, &s);
  load->torque = motor;
@TORQUE@  normal = load->torque / (s.l * s.l);
  across = (y * s.viscous_x + s.u * s.viscous_y) / (s.l * s.l);
  load->chord_force = force;
  load->fx = normal * y - force * s.u / s.l + across * y;
  load->fy = force * y / s.l + LEG_TORQUE_SIGN * normal * s.u + across * s.u;
  load->contact_x = hip->x + s.u;
  load->length = s.l;
  load->arc = s.phi;
  load->angle = s.angle;
  load->angle_rate = s.angle_rate;
  load->contact_rate = s.contact_rate;
  return 0;
}

/* Touch-down: the place of the contact, and the stance that begins. */
static void leg_land(leg_state *leg, leg_hip *hip, double angle) {
  leg->f = 0.0;
/*@if STRAIGHT*/
  leg->mode = LEG_STANCE;
  leg->contact = hip->x + LEG_L0 * sin(angle);
/*@else*/
  if (angle <= 0.0) {
    leg->mode = LEG_TOE;
    leg->phi = LEG_PI;
    leg->contact = hip->x + 2.0 * LEG_R * sin(angle);
  } else {
    leg->mode = LEG_ROLLING;
    leg->phi = LEG_PI - angle;
    leg->contact = hip->x + LEG_R * sin(angle) - LEG_UNROLLED * leg->phi;
  }
/*@end*/
/*@if LANDING*/
  { /* The impact takes some of the speed along the chord. */
    const double alpha = @ALPHA@;
    const double along = hip->vy * cos(alpha) - hip->vx * sin(alpha);
    hip->vx += LEG_LANDING_LOSS * along * sin(alpha);
    hip->vy -= LEG_LANDING_LOSS * along * cos(alpha);
  }
/*@end*/
}

leg_mode leg_decide(leg_state *leg, leg_hip *hip, double commanded_angle) {
  leg_instant s;
  if (leg->mode == LEG_FLIGHT) {
    const double angle = leg_touchdown_angle(commanded_angle, hip->vx);
    if (hip->y > leg_touchdown_height(angle)) {
      leg->placed = 1;
    } else if (leg->placed) {
      leg_land(leg, hip, angle);
    }
    return leg->mode;
  }
  if (leg_solve(leg, hip, &s) != 0) return leg->mode;
  if (@LIFTOFF@) {
    leg->mode = LEG_FLIGHT;
    leg->placed = 0;
  }
/*@if CURVED*/
  else if (s.change < 0.0) {
    if (leg->mode == LEG_ROLLING) {
      leg->mode = LEG_TOE;
      leg->contact += LEG_UNROLLED * LEG_PI;
    } else {
      leg->mode = LEG_ROLLING;
      leg->contact -= LEG_UNROLLED * LEG_PI;
    }
    leg->phi = LEG_PI;
  }
/*@end*/
  return leg->mode;
}
