
/* The strip's material is Kelvin-Voigt's, its moment E I (kappa + tau dkappa/dt):
   R = tau/2 (E I/r) (D_ff f'^2 + 2 D_fphi f' phi' + D_phiphi phi'^2), force on the hip -dR/dv. */
static void leg_damp_along_arc(double phi, double f, double z, double phi_x, double phi_y,
                               double f_x, double f_y, const leg_hip *hip, leg_instant *s) {
  const double p3 = phi * phi * phi, p4 = p3 * phi, p5 = p4 * phi;
  const double f_rate = f_x * hip->vx + f_y * hip->vy;
  const double phi_rate = phi_x * hip->vx + phi_y * hip->vy;
  const double unit = LEG_TAU * LEG_EI / LEG_R;
  double bx[3][6], by[3][6], ff, mixed, phiphi, by_load, by_arc;
  const int first = leg_cell(phi, z, bx, by);
  ff = p5 * leg_spline(leg_table_ff, first, bx[0], by[0]);
  mixed = p4 * f * leg_spline(leg_table_fphi, first, bx[0], by[0]);
  phiphi = p3 * f * f * leg_spline(leg_table_phiphi, first, bx[0], by[0]);
  by_load = unit * (ff * f_rate + mixed * phi_rate);
  by_arc = unit * (mixed * f_rate + phiphi * phi_rate);
  s->viscous_x = -(by_load * f_x + by_arc * phi_x);
  s->viscous_y = -(by_load * f_y + by_arc * phi_y);
}
