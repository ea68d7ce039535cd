// Where a leg runs, from what the simulation says: hip, contact point, contact arc, leg angle.
// World W: x forward, y up [m].

const turned = (x, y, angle, length) => [x + length * Math.cos(angle), y + length * Math.sin(angle)];

// An unloaded half circle of radius r at a hip; theta as in the equation sheet.
function restingLeg(hip, theta, r) {
  const [cx, cy] = [hip[0] + r * Math.sin(theta), hip[1] - r * Math.cos(theta)];
  const points = [];
  for (let i = 0; i <= 48; ++i)
    points.push(turned(cx, cy, Math.PI / 2 + theta + (Math.PI * i) / 48, r));
  return points;
}

// The half angle a of a circular arc with sin(a)/a = chord/arc.
function halfAngleOf(chordOverArc) {
  if (!(chordOverArc < 1)) return 0;
  let a = Math.sqrt(6 * (1 - chordOverArc));
  for (let i = 0; i < 20; ++i) {
    const f = Math.sin(a) - chordOverArc * a;
    a -= f / (Math.cos(a) - chordOverArc);
    if (!(a > 0)) a = 0.1;
  }
  return a;
}

// Follows a curve of constant curvature from a point; returns its points and the heading at its end.
function follow(from, heading, curvature, length, steps = 24) {
  const points = [];
  let [x, y] = from;
  let h = heading;
  const ds = length / steps;
  for (let i = 0; i < steps; ++i) {
    x += ds * Math.cos(h + 0.5 * curvature * ds);
    y += ds * Math.sin(h + 0.5 * curvature * ds);
    h += curvature * ds;
    points.push([x, y]);
  }
  return {points, heading: h};
}

// A loaded leg: the arc between hip and contact bent to a circular arc of its own length over the
// simulated chord, the rest of the half circle unloaded beyond the contact.
function loadedLeg(hip, contact, arc, r) {
  const chord = Math.hypot(contact[0] - hip[0], contact[1] - hip[1]);
  const length = r * arc;
  const a = halfAngleOf(chord / length);
  const heading = Math.atan2(contact[1] - hip[1], contact[0] - hip[0]) - a;
  const bent = follow(hip, heading, (2 * a) / length, length);
  bent.points[bent.points.length - 1] = contact;
  const free = follow(contact, bent.heading, 1 / r, r * (Math.PI - arc));
  return [hip, ...bent.points, ...(arc < Math.PI - 1e-3 ? free.points : [])];
}

// A straight leg as a coil between hip and foot.
function coil(hip, foot) {
  const [dx, dy] = [foot[0] - hip[0], foot[1] - hip[1]];
  const points = [hip];
  const turns = 10;
  for (let i = 0; i <= turns; ++i) {
    const along = 0.15 + (0.7 * i) / turns;
    const side = i === 0 || i === turns ? 0 : (i % 2 ? 0.035 : -0.035);
    points.push([hip[0] + along * dx - side * dy, hip[1] + along * dy + side * dx]);
  }
  return [...points, foot];
}

// The drawn leg of one simulated instant; `mechanism` as in run.json.
function legShape(mechanism, state) {
  const p = mechanism.parameters ?? {};
  const hip = [state.x, state.y];
  const onGround = isNumber(state.contactX);
  if (mechanism.type === 'c_leg') {
    if (onGround && isNumber(state.arc)) return loadedLeg(hip, [state.contactX, state.contactY], state.arc, p.r);
    return restingLeg(hip, state.angle, p.r);
  }
  if (mechanism.type === 'straight_leg') {
    const foot = onGround ? [state.contactX, state.contactY]
      : [hip[0] + p.l0 * Math.sin(state.angle), hip[1] - p.l0 * Math.cos(state.angle)];
    return coil(hip, foot);
  }
  const points = []; // a ball
  for (let i = 0; i <= 32; ++i) points.push(turned(...hip, (2 * Math.PI * i) / 32, p.radius || 0.05));
  return points;
}
