
/* ---- compliance of the arc, by Castigliano's theorem -------------------------------------------
   C(phi) = 1/2 [r^3 f/(E I) + r (3 sin phi - phi)/(E A) + kappa r (phi - sin phi)/(G A)] */

/* A function of the contact arc and its derivatives. */
typedef struct {
  double value, d1, d2;
} leg_shape;

/* sum of c[i] phi^(lowest + 2 i): where a closed form loses digits to cancellation. */
static leg_shape leg_series(const double *c, int terms, int lowest, double phi) {
  const double q = phi * phi, low = pow(phi, lowest - 2);
  leg_shape s = {0.0, 0.0, 0.0};
  int i;
  for (i = terms - 1; i >= 0; --i) {
    const double n = lowest + 2.0 * i;
    s.value = s.value * q + c[i];
    s.d1 = s.d1 * q + n * c[i];
    s.d2 = s.d2 * q + n * (n - 1.0) * c[i];
  }
  s.value *= low * q;
  s.d1 *= low * phi;
  s.d2 *= low;
  return s;
}

/* f = 2 phi - 3 sin phi + phi cos phi, of bending. */
static leg_shape leg_bending(double phi) {
  static const double c[10] = {0.016666666666666666,   -0.00079365079365079365,
                               1.6534391534391536e-05, -2.0041686708353376e-07,
                               1.6059043836821615e-09, -9.1765964781837793e-12,
                               3.936040156083729e-14,  -1.3153016394598927e-16,
                               3.5231293914104271e-19, -7.7363403412613678e-22};
  leg_shape s;
  if (phi < 1.0) return leg_series(c, 10, 5, phi);
  s.value = 2.0 * phi - 3.0 * sin(phi) + phi * cos(phi);
  s.d1 = 2.0 - 2.0 * cos(phi) - phi * sin(phi);
  s.d2 = sin(phi) - phi * cos(phi);
  return s;
}

static leg_shape leg_compliance(double phi, double radius) {
  const double bending = radius * radius * radius / (2.0 * LEG_EI);
  const double axial = radius / (2.0 * LEG_EA), shear = LEG_KAPPA * radius / (2.0 * LEG_GA);
  const leg_shape f = leg_bending(phi);
  leg_shape C;
  C.value = bending * f.value + axial * (3.0 * sin(phi) - phi) + shear * (phi - sin(phi));
  C.d1 = bending * f.d1 + axial * (3.0 * cos(phi) - 1.0) + shear * (1.0 - cos(phi));
  C.d2 = bending * f.d2 - axial * 3.0 * sin(phi) + shear * sin(phi);
  return C;
}
