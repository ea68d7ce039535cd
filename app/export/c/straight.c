
/* ---- the straight spring leg: F = k (l0 - l), the toe fixed in stance --------------------------- */
static int leg_solve(leg_state *leg, const leg_hip *hip, leg_instant *s) {
  const double y = hip->y, u = leg->contact - hip->x, l = sqrt(u * u + y * y), delta = LEG_L0 - l;
  s->u = u;
  s->l = l;
  s->phi = 0.0;
  s->elastic = LEG_K * delta * (1.0 + LEG_HARDENING / LEG_L0 * delta);
  s->rate = (y * hip->vy - u * hip->vx) / l;
  s->contact_rate = s->viscous_x = s->viscous_y = 0.0;
  s->angle = atan2(u, y);
  s->angle_rate = -(y * hip->vx + u * hip->vy) / (l * l);
  s->change = 1.0;
  s->rest = LEG_L0;
  s->stiffness = LEG_K;
  return 0;
}
