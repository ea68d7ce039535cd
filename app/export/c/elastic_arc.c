
/* ---- the law @LAW@: equilibrium of the massless arc, from Psi = F l0 - F^2 C/2 - F^3 A2/3 --------
   l = l0 - F C - F^2 A2;  u/l = cos(phi/2) - F C'/2 - F^2 A2'/3 while it rolls;  x_c = X0 + r phi */

static leg_shape leg_next_term(double phi, const leg_shape *C) {
  leg_shape a = {0.0, 0.0, 0.0};
/*@if SECOND_ORDER*/
  a = leg_second_order(phi, LEG_R);
  a.value *= LEG_SECOND_ORDER;
  a.d1 *= LEG_SECOND_ORDER;
  a.d2 *= LEG_SECOND_ORDER;
/*@end*/
  a.value -= LEG_HARDENING / LEG_R * C->value * C->value;
  a.d1 -= 2.0 * LEG_HARDENING / LEG_R * C->value * C->d1;
  a.d2 -= 2.0 * LEG_HARDENING / LEG_R * (C->d1 * C->d1 + C->value * C->d2);
@UNUSED_PHI@  return a;
}

static int leg_solve(leg_state *leg, const leg_hip *hip, leg_instant *s) {
  const double r = LEG_R, y = hip->y, u0 = leg->contact - hip->x;
  const int rolls = leg->mode == LEG_ROLLING;
  double phi = rolls ? leg->phi : LEG_PI, phi_u0 = 0.0, phi_y = 0.0;
  int round, last = !rolls;
  s->contact_rate = s->viscous_x = s->viscous_y = 0.0;
  for (round = 0; round < 40; ++round) {
    const double S = sin(0.5 * phi), K = cos(0.5 * phi);
    const leg_shape C = leg_compliance(phi, r), A2 = leg_next_term(phi, &C);
    const double u = rolls ? u0 + r * phi : u0, l = sqrt(u * u + y * y), lead = u / l;
    const double delta = 2.0 * r * S - l;
    const double root = sqrt(C.value * C.value + 4.0 * A2.value * delta);
    const double F = 2.0 * delta / (C.value + root);
    const double by_load = (0.5 * C.d1 + 2.0 / 3.0 * F * A2.d1) / r;
    const double F_phi = (r * (K - lead) - F * C.d1 - F * F * A2.d1) / root;
    const double cube = 1.0 / (l * l * l);
    const double miss = lead - K + F * (0.5 * C.d1 + F * A2.d1 / 3.0) / r;
    const double slope = r * y * y * cube + 0.5 * S + by_load * F_phi +
                         F * (0.5 * C.d2 + F * A2.d2 / 3.0) / r;
    double step = -miss / slope;
    if (!(fabs(F) < HUGE_VAL)) return 1;
    if (last) {
      s->u = u;
      s->l = l;
      s->phi = phi;
      s->elastic = F;
      s->rest = 2.0 * r * S;
      s->stiffness = 1.0 / C.value;
      if (rolls) {
        leg->phi = phi;
        phi_u0 = -(y * y * cube - by_load / root * lead) / slope;
        phi_y = (u * y * cube + by_load / root * y / l) / slope;
      }
      s->change = rolls ? LEG_PI - phi : -miss;
      s->rate = (y * hip->vy - u * hip->vx) / l;
      s->angle = rolls ? LEG_PI - phi : atan2(u, y);
      s->angle_rate = rolls ? phi_u0 * hip->vx - phi_y * hip->vy
                            : -(y * hip->vx + u * hip->vy) / (l * l);
      return 0;
    }
    if (!(fabs(step) < 0.5)) step = step < 0.0 ? -0.5 : 0.5;
    phi = fmin(fmax(phi + step, 0.05), 2.0 * LEG_PI - 0.05);
    last = fabs(step) < 1e-9;
  }
  return 1;
}
