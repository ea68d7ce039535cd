// A robot of several legs: what an animation shows of it, and which leg stands when.

const legNumbers = (mechanism) => list(mechanism.hips_m).map((_, i) => i + 1);

// What a trajectory table tells of a robot; of any other mechanism nothing.
function robotMotionOf(trajectory, rows) {
  const motion = {};
  const take = (name, column) => { if (trajectory.has(column)) motion[name] = trajectory.pick(column, rows); };
  take('pitch', 'body_pitch_rad');
  for (let leg = 1; leg <= 4; ++leg) {
    take(`angle${leg}`, `leg_angle_${leg}_rad`);
    take(`arc${leg}`, `leg_arc_${leg}_rad`);
    for (const [axis, of] of [['x', 'X'], ['y', 'Y']]) {
      take(`contact${of}${leg}`, `leg_contact_${axis}_${leg}_m`);
      take(`force${of}${leg}`, `leg_force_${axis}_${leg}_N`);
    }
  }
  return motion;
}

const robotStands = (motion, row) => [1, 2, 3, 4].some((leg) => isNumber(motion[`contactX${leg}`]?.[row]));

// Rest length of a robot's straight legs [m]; of half circles nothing.
const straightLength = (mechanism) => mechanism.parameters.l0;
// Half of an unloaded leg [m].
const legSize = (mechanism) => (straightLength(mechanism) ?? 2 * mechanism.parameters.r) / 2;

// A place of the body frame in the world.
function ofBody(state, [x, y]) {
  const [c, s] = [Math.cos(state.pitch), Math.sin(state.pitch)];
  return [state.x + c * x - s * y, state.y + s * x + c * y];
}

// One leg at an instant: where it stands and what it carries, as a hopper's state.
function robotLegState(mechanism, state, leg) {
  const arc = state[`arc${leg}`];
  const bends = Math.PI - (mechanism.parameters.clamp ?? 0) / mechanism.parameters.r;
  const onToe = straightLength(mechanism) !== undefined || arc > bends - 1e-9;
  return {
    hip: ofBody(state, mechanism.hips_m[leg - 1]), angle: state.pitch + state[`angle${leg}`], arc,
    contactX: state[`contactX${leg}`], contactY: state[`contactY${leg}`],
    forceX: state[`forceX${leg}`], forceY: state[`forceY${leg}`],
    mode: !isNumber(state[`contactX${leg}`]) ? 'flight' : onToe ? 'toe' : 'rolling',
  };
}

// A straight leg: a coil spring from its hip to its foot, or in the air to its toe.
function straightLegShape([x, y], leg, length) {
  const [toX, toY] = leg.mode === 'flight' ? [x + length * Math.sin(leg.angle), y - length * Math.cos(leg.angle)] : [leg.contactX, leg.contactY];
  const [dx, dy] = [toX - x, toY - y];
  const across = 0.05 * length / Math.hypot(dx, dy);
  const turns = [...Array(12).keys()].map((i) => [0.3 + 0.04 * (i + 0.5), i % 2 ? -across : across]);
  return [[0, 0], [0.3, 0], ...turns, [0.78, 0], [1, 0]].map(([along, aside]) => [x + along * dx - aside * dy, y + along * dy + aside * dx]);
}

// The shape of that leg: of its own length between hip and contact, as leg.js draws a hopper's.
function robotLegShape(mechanism, leg) {
  if (straightLength(mechanism) !== undefined) return straightLegShape(leg.hip, leg, straightLength(mechanism));
  const {r, clamp} = mechanism.parameters;
  if (leg.mode === 'flight') return restingLeg(leg.hip, leg.angle, r);
  return loadedLeg(leg.hip, [leg.contactX, leg.contactY], Math.min(Math.PI, leg.arc + (clamp ?? 0) / r), r);
}

// The outline of the body: around its hips.
function bodyOutline(mechanism, state) {
  const hips = mechanism.hips_m;
  const half = 0.28 * legSize(mechanism);
  const [back, front] = [Math.min(...hips.map((h) => h[0])) - 1.6 * half, Math.max(...hips.map((h) => h[0])) + 1.6 * half];
  const [low, high] = [Math.min(...hips.map((h) => h[1])) - half, Math.max(...hips.map((h) => h[1])) + half];
  return [[back, low], [front, low], [front + 0.8 * half, (low + high) / 2], [front, high], [back, high]].map((p) => ofBody(state, p));
}

class RobotFigure {
  constructor(layer, kind, label, mechanism) {
    this.label = label;
    this.trail = svg('polyline', {class: `trail ${kind}`});
    this.body = svg('polygon', {class: `body ${kind}`});
    this.mass = svg('circle', {class: `mass ${kind}`, r: 3.5});
    this.legs = legNumbers(mechanism).map(() => ({
      leg: svg('polyline', {class: `leg ${kind}`}), force: svg('path', {class: `force ${kind}`}), hip: svg('circle', {class: `hip ${kind}`, r: 4}),
    }));
    layer.append(this.trail, this.body, this.mass, ...this.legs.flatMap((l) => [l.leg, l.force, l.hip]));
  }

  show(mechanism, state, view) {
    const place = (circle, at) => {
      const [x, y] = view.point(...at);
      circle.setAttribute('cx', x);
      circle.setAttribute('cy', y);
    };
    const outline = (points) => points.map(([x, y]) => view.point(x, y)).join(' ');
    this.body.setAttribute('points', outline(bodyOutline(mechanism, state)));
    place(this.mass, ofBody(state, [mechanism.parameters.com_x ?? 0, mechanism.parameters.com_y ?? 0]));
    this.legs.forEach((drawn, i) => {
      const leg = robotLegState(mechanism, state, i + 1);
      drawn.leg.setAttribute('points', outline(robotLegShape(mechanism, leg)));
      drawn.leg.dataset.mode = leg.mode;
      drawn.force.setAttribute('d', isNumber(leg.contactX) ? view.arrow(leg) : '');
      place(drawn.hip, leg.hip);
    });
  }
}

function describeRobot(mechanism, state) {
  const legs = legNumbers(mechanism).map((i) => {
    const leg = robotLegState(mechanism, state, i);
    const how = {flight: 'in the air', rolling: 'rolling', toe: 'on its toe'}[leg.mode];
    return `leg ${i} ${how}${leg.mode === 'flight' ? '' : `, ${Math.hypot(leg.forceX, leg.forceY).toFixed(1)} N`}`;
  });
  return [`body at ${(1e3 * state.y).toFixed(1)} mm`, `pitch ${((180 / Math.PI) * state.pitch).toFixed(1)}°`, ...legs].join('; ');
}

// Which leg stands when: {leg, from, to} of every contact of a run.
function contactsOf(motion, legs) {
  const contacts = [];
  for (const leg of legs) {
    const feet = motion[`contactX${leg}`];
    let from;
    feet.forEach((foot, row) => {
      if (isNumber(foot) && from === undefined) from = motion.time[row];
      if (from === undefined || (isNumber(foot) && row + 1 < feet.length)) return;
      contacts.push({leg, from, to: motion.time[row]});
      from = undefined;
    });
  }
  return contacts;
}

// A gait diagram of the run that `runOf()` gives: a bar a contact, the foremost leg on top.
function gaitDiagram(runOf) {
  const {mechanism} = runOf();
  const legs = legNumbers(mechanism);
  return new Plot('Which leg the ground carries, as simulated; leg 1 is the hindmost.', () => {
    const {motion} = runOf();
    const contacts = contactsOf(motion, legs);
    const bars = {
      type: 'bar', orientation: 'h', base: contacts.map((c) => c.from), x: contacts.map((c) => c.to - c.from), y: contacts.map((c) => `leg ${c.leg}`),
      customdata: contacts.map((c) => [c.from, c.to]), width: 0.55, marker: {color: colour('one')},
      hovertemplate: '%{y}: %{customdata[0]:.4f} to %{customdata[1]:.4f} s<extra></extra>',
    };
    return {traces: [bars], layout: {showlegend: false, margin: {l: 64, r: 12, t: 8, b: 44},
      xaxis: {title: {text: 'time [s]'}, range: [motion.time[0], motion.time[motion.time.length - 1]]},
      yaxis: {type: 'category', categoryorder: 'array', categoryarray: legs.map((i) => `leg ${i}`)}}};
  }, {height: 90 + 40 * legs.length});
}
