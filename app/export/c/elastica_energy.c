
/* ---- the pressed arc, exact for any load --------------------------------------------------------
   G(phi, f) is the energy of an inextensible arc between two pins beside f l0, divided by f^2 and
   E I/r, at the load f = F r^2/(E I): phi^5 times a spline of degree 5 over @CELLS@ cells of
   phi = @PHI_BEGIN@ .. @PHI_END@ and z = f w(phi) = @LOAD_BEGIN@ .. @LOAD_END@. */

#define LEG_PHI_CELLS @PHI_CELLS@
#define LEG_LOAD_CELLS @LOAD_CELLS@
#define LEG_PHI_BEGIN @PHI_BEGIN@
#define LEG_PHI_END @PHI_END@
#define LEG_LOAD_BEGIN @LOAD_BEGIN@
#define LEG_LOAD_END @LOAD_END@

/* Load scale w(phi) and two derivatives: z = 1 is about the greatest load of a leg. */
static void leg_load_scale(double phi, double *w) {
  const double unit = 1.0 / (LEG_PI * LEG_PI);
  const double a = 3.0 * unit, b = -1.9 * unit, c = 0.57 * unit, d = -0.055 * unit;
  w[0] = phi * phi * (a + phi * (b + phi * (c + phi * d)));
  w[1] = phi * (2.0 * a + phi * (3.0 * b + phi * (4.0 * c + phi * 5.0 * d)));
  w[2] = 2.0 * a + phi * (6.0 * b + phi * (12.0 * c + phi * 20.0 * d));
}

/* The six splines that a cell sees, at the place x of 0 .. 1 in it, with two derivatives: Cox and
   de Boor on uniform knots, the derivatives as differences of splines of lower degree. */
static void leg_splines(double x, double b[3][6]) {
  double n[6][6] = {{0.0}};
  int degree, i;
  n[0][0] = 1.0;
  for (degree = 1; degree <= 5; ++degree) {
    for (i = 0; i <= degree; ++i) {
      const double begun = i > 0 ? n[degree - 1][i - 1] : 0.0;
      const double ending = i < degree ? n[degree - 1][i] : 0.0;
      n[degree][i] = ((x + degree - i) * begun + (i + 1.0 - x) * ending) / degree;
    }
  }
  for (i = 0; i < 6; ++i) {
    b[0][i] = n[5][i];
    b[1][i] = (i > 0 ? n[4][i - 1] : 0.0) - (i < 5 ? n[4][i] : 0.0);
    b[2][i] = (i > 1 ? n[3][i - 2] : 0.0) - 2.0 * (i > 0 && i < 5 ? n[3][i - 1] : 0.0) +
              (i < 4 ? n[3][i] : 0.0);
  }
}

@TABLES@
/* Place of (phi, z) in the grid: the cell's first coefficient, and the splines there. */
static int leg_cell(double phi, double z, double bx[3][6], double by[3][6]) {
  const double x = (phi - LEG_PHI_BEGIN) * (LEG_PHI_CELLS / (LEG_PHI_END - LEG_PHI_BEGIN));
  const double y = (z - LEG_LOAD_BEGIN) * (LEG_LOAD_CELLS / (LEG_LOAD_END - LEG_LOAD_BEGIN));
  int i = (int)x, j = (int)y;
  i = i < 0 ? 0 : i < LEG_PHI_CELLS ? i : LEG_PHI_CELLS - 1;
  j = j < 0 ? 0 : j < LEG_LOAD_CELLS ? j : LEG_LOAD_CELLS - 1;
  leg_splines(x - i, bx);
  leg_splines(y - j, by);
  return i * (LEG_LOAD_CELLS + 5) + j;
}

static double leg_spline(const double *table, int first, const double *bx, const double *by) {
  double sum = 0.0;
  int i, j;
  for (i = 0; i < 6; ++i) {
    double row = 0.0;
    for (j = 0; j < 6; ++j) row += by[j] * table[first + i * (LEG_LOAD_CELLS + 5) + j];
    sum += bx[i] * row;
  }
  return sum;
}

/* G and its derivatives, by phi and by f. */
typedef struct {
  double G, phi, f, phi_phi, phi_f, f_f;
} leg_energy;

static leg_energy leg_energy_at(double phi, double f) {
  const double px = LEG_PHI_CELLS / (LEG_PHI_END - LEG_PHI_BEGIN);
  const double py = LEG_LOAD_CELLS / (LEG_LOAD_END - LEG_LOAD_BEGIN);
  double w[3], bx[3][6], by[3][6];
  double b, b_p, b_z, b_pp, b_pz, b_zz, s_p, s_pp, s_pf, z_p;
  const double p3 = phi * phi * phi, p4 = p3 * phi, p5 = p4 * phi;
  leg_energy e;
  int first;
  leg_load_scale(phi, w);
  first = leg_cell(phi, f * w[0], bx, by);
  b = leg_spline(leg_table_energy, first, bx[0], by[0]);
  b_p = px * leg_spline(leg_table_energy, first, bx[1], by[0]);
  b_z = py * leg_spline(leg_table_energy, first, bx[0], by[1]);
  b_pp = px * px * leg_spline(leg_table_energy, first, bx[2], by[0]);
  b_pz = px * py * leg_spline(leg_table_energy, first, bx[1], by[1]);
  b_zz = py * py * leg_spline(leg_table_energy, first, bx[0], by[2]);
  /* z = f w(phi). */
  z_p = f * w[1];
  s_p = b_p + b_z * z_p;
  s_pp = b_pp + z_p * (2.0 * b_pz + b_zz * z_p) + b_z * f * w[2];
  s_pf = w[0] * (b_pz + b_zz * z_p) + b_z * w[1];
  /* Times phi^5. */
  e.G = p5 * b;
  e.f = p5 * b_z * w[0];
  e.f_f = p5 * b_zz * w[0] * w[0];
  e.phi = 5.0 * p4 * b + p5 * s_p;
  e.phi_f = 5.0 * p4 * b_z * w[0] + p5 * s_pf;
  e.phi_phi = 20.0 * p3 * b + 10.0 * p4 * s_p + p5 * s_pp;
  return e;
}
