
/* ---- the law @LAW@: the loaded leg stays a half circle of radius r_d, its chord angle alpha half
   the leg angle; l0 = 2 r cos alpha, r_d = l/(2 cos alpha), F = (l0 - l)/C(phi; r_d) ------------- */

/* What alpha alone gives, and the elastic force. */
static void leg_half_circle(double phi, double delta, double r_d, leg_instant *s) {
  const double radius = LEG_STIFFNESS_AT_REST ? LEG_R : r_d;
  const double arc = LEG_STIFFNESS_AT_VIRTUAL_ANGLE ? 0.5 * (LEG_PI + phi) : phi;
  const double C = leg_compliance(arc, radius).value;
/*@if SECOND_ORDER*/
  const double C2 = LEG_SECOND_ORDER * leg_second_order(arc, radius).value;
  s->elastic = 2.0 * delta / (C + sqrt(C * C + 4.0 * C2 * delta));
/*@else*/
  s->elastic = delta / C;
/*@end*/
/*@if HARDENING*/
  s->elastic += LEG_HARDENING / LEG_R * delta * delta / C;
/*@end*/
  s->phi = phi;
  s->stiffness = 1.0 / leg_compliance(phi, LEG_R).value;
}

static int leg_solve(leg_state *leg, const leg_hip *hip, leg_instant *s) {
  const double y = hip->y, u = leg->contact - hip->x, l = sqrt(u * u + y * y);
  double roll, du, turn;
  s->u = u;
  s->l = l;
  s->viscous_x = s->viscous_y = 0.0;
  if (leg->mode == LEG_TOE) {
    s->rest = 2.0 * LEG_R;
    leg_half_circle(LEG_PI, 2.0 * LEG_R - l, 0.5 * l, s);
    s->rate = (y * hip->vy - u * hip->vx) / l;
    s->contact_rate = 0.0;
    s->angle = atan2(u, y);
    s->angle_rate = -(y * hip->vx + u * hip->vy) / (l * l);
    s->change = -u / l;
    return 0;
  }
  s->rest = 2.0 * LEG_R * y / l;
  leg_half_circle(LEG_PI - 2.0 * atan2(u, y), s->rest - l, 0.5 * l * l / y, s);
  /* dx_c/dt = -rho dtheta/dt, dtheta/dt = 2 (du/dt y - u vy)/l^2, du/dt = dx_c/dt - vx. */
  roll = LEG_RATE_FACTOR * (@ROLLING_RADIUS@) / (l * l);
  s->contact_rate = roll * (y * hip->vx + u * hip->vy);
  if (!LEG_ROLLS_EXPLICITLY) s->contact_rate /= 1.0 + roll * y;
  du = (LEG_DAMPS_HIP ? 0.0 : s->contact_rate) - hip->vx;
  turn = (du * y - u * hip->vy) / (l * l);
  s->rate = (u * du + y * hip->vy) / l + (LEG_DAMPS_DEFLECTION ? 2.0 * LEG_R * u / l * turn : 0.0);
  s->angle = LEG_PI - s->phi;
  s->angle_rate = 2.0 * ((s->contact_rate - hip->vx) * y - u * hip->vy) / (l * l);
  s->change = LEG_PI - s->phi;
  return 0;
}
