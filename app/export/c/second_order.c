
/* The next term of the elastica: C2(phi) = (r^5/(E I)^2) g,
   g = 3/4 phi^2 S K^2 + 9/2 phi K^3 - 3/4 phi K - 17/2 S K^2 + S, S and K sine and cosine of phi/2. */
static leg_shape leg_second_order(double phi, double radius) {
  static const double c[13] = {
      0.0012648809523809524,   -0.00014570932539682539, 6.5914445797258295e-06,
      -1.6799139927395137e-07, 2.8044931209749382e-09,  -3.335565875935417e-11,
      2.9841497505851529e-13,  -2.0867895457481717e-15, 1.1739186031497388e-17,
      -5.4332172633142731e-20, 2.10665655434656e-22,    -6.9458557220986959e-25,
      1.9719405461205777e-27};
  const double unit = radius * radius * radius * radius * radius / (LEG_EI * LEG_EI);
  leg_shape g;
  if (phi < 1.5) {
    g = leg_series(c, 13, 7, phi);
  } else {
    const double h = 0.5 * phi, S = sin(h), K = cos(h), S2 = S * S, K2 = K * K;
    g.value = 3.0 * h * h * S * K2 + 9.0 * h * K2 * K - 1.5 * h * K - 8.5 * S * K2 + S;
    g.d1 = 0.5 * (h * h * K * (3.0 * K2 - 6.0 * S2) - 21.0 * h * S * K2 + 1.5 * h * S +
                  16.5 * S2 * K);
    g.d2 = 0.25 * (h * h * S * (6.0 * S2 - 21.0 * K2) + h * K * (30.0 * S2 - 15.0 * K2 + 1.5) +
                   12.0 * S * K2 + 1.5 * S - 16.5 * S2 * S);
  }
  g.value *= unit;
  g.d1 *= unit;
  g.d2 *= unit;
  return g;
}
