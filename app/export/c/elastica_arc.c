
/* ---- the law elastica -----------------------------------------------------------------------------
   Psi = (E I/r) (f 2 sin(phi/2) - f^2 G) - F^2 C_s/2, C_s the normal and shear part of C:
   l = 2 r sin(phi/2) - r f (2 G + f G_f) - F C_s;  u/l = cos(phi/2) - f G_phi - F C_s'/2 while it
   rolls;  x_c = X0 + r phi. Two equations for phi and f, by Newton. */
static int leg_solve(leg_state *leg, const leg_hip *hip, leg_instant *s) {
  const double r = LEG_R, unit = LEG_EI / (r * r), y = hip->y, u0 = leg->contact - hip->x;
  const double axial = unit / (2.0 * LEG_EA), shear = unit * LEG_KAPPA / (2.0 * LEG_GA);
  const int rolls = leg->mode == LEG_ROLLING;
  double phi = rolls ? leg->phi : LEG_PI, f = leg->f, w[3];
  int round, last = 0;
  s->contact_rate = s->viscous_x = s->viscous_y = 0.0;
  for (round = 0; round < 60; ++round) {
    double u, l, lead, S, K, stretch, stretch1, stretch2, chord, tip, tip_phi, tip_f, chord_phi;
    double chord_f, over, turn, press, sine, sine_f;
    leg_energy e;
    phi = fmin(fmax(phi, LEG_PHI_BEGIN), LEG_PHI_END);
    leg_load_scale(phi, w);
    f = fmin(fmax(f, LEG_LOAD_BEGIN / w[0]), LEG_LOAD_END / w[0]);
    e = leg_energy_at(phi, f);
    u = rolls ? u0 + r * phi : u0;
    l = sqrt(u * u + y * y);
    lead = u / l;
    S = sin(0.5 * phi);
    K = cos(0.5 * phi);
    stretch = axial * (3.0 * sin(phi) - phi) + shear * (phi - sin(phi));
    stretch1 = axial * (3.0 * cos(phi) - 1.0) + shear * (1.0 - cos(phi));
    stretch2 = -3.0 * axial * sin(phi) + shear * sin(phi);
    chord = 2.0 * S - l / r - f * (2.0 * e.G + f * e.f + stretch);
    tip = lead - K + f * (e.phi + 0.5 * stretch1);
    tip_phi = r * y * y / (l * l * l) + 0.5 * S + f * (e.phi_phi + 0.5 * stretch2);
    tip_f = e.phi + f * e.phi_f + 0.5 * stretch1;
    chord_phi = K - lead - f * (2.0 * e.phi + f * e.phi_f + stretch1);
    chord_f = -(2.0 * e.G + f * (4.0 * e.f + f * e.f_f) + stretch);
/*@if HARDENING*/
    { /* Takes (beta/r) C^2 from what the cube of the load has: - F^3 A2/3 of Psi. */
      const leg_shape C = leg_compliance(phi, r);
      const double F = unit * f, per_r = LEG_HARDENING / r;
      const double A2 = -per_r * C.value * C.value, A2_1 = -2.0 * per_r * C.value * C.d1;
      const double A2_2 = -2.0 * per_r * (C.d1 * C.d1 + C.value * C.d2);
      chord -= F * F * A2 / r;
      chord_phi -= F * F * A2_1 / r;
      chord_f -= 2.0 * F * unit * A2 / r;
      tip += F * F * A2_1 / (3.0 * r);
      tip_phi += F * F * A2_2 / (3.0 * r);
      tip_f += 2.0 * F * unit * A2_1 / (3.0 * r);
    }
/*@end*/
    s->change = rolls ? LEG_PI - phi : -tip;
    sine = lead - tip; /* of the angle at which chord and tip meet, less a right angle */
    sine_f = -tip_f;
    if (!rolls) { /* phi stays */
      tip = tip_f = 0.0;
      tip_phi = 1.0;
    }
    over = 1.0 / (tip_phi * chord_f - tip_f * chord_phi);
    turn = -over * (chord_f * tip - tip_f * chord);
    press = -over * (tip_phi * chord - chord_phi * tip);
    if (!(fabs(turn) < HUGE_VAL) || !(fabs(press) < HUGE_VAL)) return 1;
    if (last) {
      const double z = f * w[0], cube = 1.0 / (l * l * l);
      /* How the root follows the hip's place. */
      const double tip_u = rolls ? y * y * cube : 0.0, tip_y = rolls ? -u * y * cube : 0.0;
      const double chord_u = -lead / r, chord_y = -y / (l * r);
      const double phi_u = -over * (chord_f * tip_u - tip_f * chord_u);
      const double phi_y = -over * (chord_f * tip_y - tip_f * chord_y);
/*@if ALONG_ARC*/
      const double f_u = -over * (tip_phi * chord_u - chord_phi * tip_u);
      const double f_y = -over * (tip_phi * chord_y - chord_phi * tip_y);
/*@end*/
      if (!(phi > LEG_PHI_BEGIN && phi < LEG_PHI_END && z > LEG_LOAD_BEGIN && z < LEG_LOAD_END))
        return 1;
      leg->f = f;
      if (rolls) leg->phi = phi;
      s->u = u;
      s->l = l;
      s->phi = phi;
      s->elastic = unit * f;
      s->rest = 2.0 * r * S;
      s->stiffness = 0.0;
      s->rate = (y * hip->vy - u * hip->vx) / l;
      /* The hip meets the chord as the tip does. */
      s->angle = rolls ? 2.0 * atan2(u, y) : atan2(u, y) + asin(sine);
      if (rolls) {
        const double lead_rate = r * (phi_y * hip->vy - phi_u * hip->vx) - hip->vx;
        s->angle_rate = 2.0 * (y * lead_rate - u * hip->vy) / (l * l);
      } else {
        s->angle_rate = sine_f * s->rate / (r * chord_f * sqrt(1.0 - sine * sine)) -
                        (y * hip->vx + u * hip->vy) / (l * l);
      }
/*@if ALONG_ARC*/
      leg_damp_along_arc(phi, f, z, rolls ? -phi_u : 0.0, rolls ? phi_y : 0.0, -f_u, f_y, hip, s);
/*@end*/
      return 0;
    }
    phi += fabs(turn) < 0.3 ? turn : turn < 0.0 ? -0.3 : 0.3;
    f += fabs(press) < 0.3 ? press : press < 0.0 ? -0.3 : 0.3;
    last = fabs(turn) < 1e-9 && fabs(press) < 1e-9;
  }
  return 1;
}
