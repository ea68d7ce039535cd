// The leg in motion, drawn from the run's own rows.

const svgNamespace = 'http://www.w3.org/2000/svg';
function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(svgNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

// The states of a run: rows of a trajectory table as objects of arrays.
function motionOf(trajectory, rows) {
  const pick = (name) => trajectory.pick(name, rows);
  return {
    time: pick('time_s'), x: pick('body_x_m'), y: pick('body_y_m'), angle: pick('leg_angle_rad'),
    contactX: pick('contact_x_m'), contactY: pick('contact_y_m'), arc: pick('contact_arc_rad'),
    forceX: pick('ground_force_x_N'), forceY: pick('ground_force_y_N'), mode: pick('mode'),
    ...robotMotionOf(trajectory, rows),
  };
}

// A motion that repeats itself, `times` over: the way on goes on, the rest is the same again.
function repeated(motion, times) {
  const last = motion.time.length - 1;
  const [period, advance] = [motion.time[last] - motion.time[0], motion.x[last] - motion.x[0]];
  const copies = (values, step) => Array.from({length: times}, (_, k) => Array.from(values, (v) => (step ? v + k * step : v))).flat();
  const steps = {time: period, x: advance};
  const stepOf = (name) => (name.startsWith('contactX') ? advance : steps[name]);
  return Object.fromEntries(Object.entries(motion).map(([name, values]) => [name, copies(values, stepOf(name))]));
}

// Steady hops of different length side by side, each repeated until the longest has been seen twice.
function repeatedTogether(motions) {
  const lengths = motions.map((m) => m.time[m.time.length - 1] - m.time[0]);
  return motions.map((m, i) => repeated(m, Math.min(20, Math.ceil((2 * Math.max(...lengths)) / lengths[i]))));
}

// The state at a time: the row before it, hip and force moved on linearly within a mode.
function stateAt(motion, time) {
  const times = motion.time;
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle; else high = middle;
  }
  const next = motion.mode[high] === motion.mode[low] ? high : low;
  const share = next === low ? 0 : Math.min(1, Math.max(0, (time - times[low]) / (times[high] - times[low])));
  const at = (values) => {
    const ahead = share * (values[next] - values[low]);
    return isNumber(ahead) ? values[low] + ahead : values[low]; // a leg that lands or lifts in between
  };
  const moved = Object.entries(motion).filter(([name]) => name !== 'time' && name !== 'mode');
  return {...Object.fromEntries(moved.map(([name, values]) => [name, at(values)])), mode: motion.mode[low]};
}

const forceOf = (motion, row) => Math.hypot(motion.forceX[row] || 0, motion.forceY[row] || 0);

function greatestForce(motion) {
  let row = 0;
  for (let i = 1; i < motion.time.length; ++i) if (forceOf(motion, i) > forceOf(motion, row)) row = i;
  return row;
}

// The row of the greatest force of the first stance.
function firstStance(motion) {
  const last = motion.time.length - 1;
  const stands = (i) => isNumber(motion.contactX[i]) || robotStands(motion, i);
  let row = 0;
  while (row < last && !stands(row)) ++row;
  for (let i = row; i < last && stands(i); ++i) if (forceOf(motion, i) > forceOf(motion, row)) row = i;
  return row;
}

// A leg that can be moved: body, leg, contact force.
class Hopper {
  constructor(layer, kind, label) {
    this.label = label;
    this.trail = svg('polyline', {class: `trail ${kind}`});
    this.leg = svg('polyline', {class: `leg ${kind}`});
    this.force = svg('path', {class: `force ${kind}`});
    this.body = svg('circle', {class: `body ${kind}`});
    layer.append(this.trail, this.leg, this.force, this.body);
  }

  show(mechanism, state, view) {
    const shape = legShape(mechanism, state).map(([x, y]) => view.point(x, y));
    this.leg.setAttribute('points', shape.join(' '));
    this.leg.dataset.mode = state.mode;
    const [x, y] = view.point(state.x, state.y);
    this.body.setAttribute('cx', x);
    this.body.setAttribute('cy', y);
    this.body.setAttribute('r', 5);
    this.force.setAttribute('d', isNumber(state.contactX) ? view.arrow(state) : '');
  }
}

// Screen coordinates that follow the hip.
class View {
  constructor(width, height, top, forceScale) {
    Object.assign(this, {width, height, forceScale, floor: height - 28, middle: 0});
    this.scale = (this.floor - 14) / top; // pixels a metre
  }
  point(x, y) {
    return [(this.width / 2 + (x - this.middle) * this.scale).toFixed(2), (this.floor - y * this.scale).toFixed(2)];
  }
  arrow(state) {
    const [fx, fy] = [state.forceX * this.forceScale, state.forceY * this.forceScale];
    const length = Math.hypot(fx, fy);
    if (!(length > 4)) return '';
    const [x, y] = this.point(state.contactX, state.contactY).map(Number);
    const [tx, ty] = [x + fx, y - fy];
    const [ux, uy] = [fx / length, -fy / length];
    const head = Math.min(9, length / 2);
    const side = (s) => `${tx - head * ux + s * 0.45 * head * uy} ${ty - head * uy - s * 0.45 * head * ux}`;
    return `M${x} ${y}L${tx} ${ty}M${side(1)}L${tx} ${ty}L${side(-1)}`;
  }
}

class Animation {
  // runs: [{label, kind, motion, mechanism}], drawn one over the other.
  constructor(runs) {
    this.runs = runs.filter((r) => r.motion.time.length > 1);
    const motions = this.runs.map((r) => r.motion);
    this.begin = Math.min(...motions.map((m) => m.time[0]));
    this.end = Math.max(...motions.map((m) => m.time[m.time.length - 1]));
    this.peak = Math.max(...motions.map((m) => forceOf(m, greatestForce(m))));
    const first = motions[0];
    this.time = first.time[firstStance(first)];
    this.width = 720;
    this.height = 320;
    let top = 0;
    for (const m of motions) for (const y of m.y) if (y > top) top = y;
    this.view = new View(this.width, this.height, top + 0.06, this.peak > 0 ? 120 / this.peak : 0);
    this.build();
    this.show();
  }

  build() {
    this.ground = svg('g', {class: 'ground'});
    const layer = svg('g');
    this.picture = svg('svg', {viewBox: `0 0 ${this.width} ${this.height}`, class: 'stage', role: 'img',
      'aria-label': 'The leg in motion'}, this.ground, layer);
    // The last drawn lies on top: the first of the runs.
    this.hoppers = new Map([...this.runs].reverse().map((r) => [r, new (figureOf(r.mechanism))(layer, r.kind, r.label, r.mechanism)]));
    this.readout = el('p', {class: 'readout'});
    this.button = el('button', {type: 'button', class: 'play'}, 'Play');
    this.button.addEventListener('click', () => this.toggle());
    this.scrubber = el('input', {type: 'range', min: '0', max: '1000', step: '1', 'aria-label': 'Time'});
    this.scrubber.addEventListener('input', () => {
      this.stop();
      this.time = this.begin + (this.scrubber.value / 1000) * (this.end - this.begin);
      this.show();
    });
    const speeds = [0.02, 0.05, 0.1, 0.25, 0.5, 1];
    this.speed = el('select', {'aria-label': 'Speed'}, speeds.map((s) => el('option', {value: String(s)}, `${s} × real time`)));
    this.speed.value = '0.1';
    this.element = el('div', {class: 'animation'}, this.picture,
      el('div', {class: 'controls'}, this.button, this.scrubber, el('label', {class: 'choice'}, this.speed)), this.readout);
  }

  toggle() { if (this.playing) this.stop(); else this.play(); }

  play() {
    this.playing = true;
    this.button.textContent = 'Pause';
    if (this.time >= this.end) this.time = this.begin;
    let last;
    const step = (now) => {
      if (!this.playing || !this.element.isConnected) return;
      if (last !== undefined) this.time += ((now - last) / 1000) * Number(this.speed.value);
      last = now;
      if (this.time >= this.end) this.time = this.begin;
      this.show();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  stop() {
    this.playing = false;
    this.button.textContent = 'Play';
  }

  show() {
    const states = this.runs.map((r) => stateAt(r.motion, this.time));
    this.view.middle = states.reduce((sum, s) => sum + s.x, 0) / states.length;
    this.showGround();
    this.runs.forEach((r, i) => {
      const hopper = this.hoppers.get(r);
      hopper.show(r.mechanism, states[i], this.view);
      this.showTrail(hopper, r.motion);
    });
    this.scrubber.value = String(Math.round((1000 * (this.time - this.begin)) / (this.end - this.begin)));
    this.readout.replaceChildren(el('span', {class: 'time'}, `${this.time.toFixed(3)} s`),
      ...states.map((s, i) => el('span', {}, this.describe(this.runs[i], s))));
    this.element.dataset.time = this.time.toFixed(6);
  }

  describe(r, s) {
    if (r.mechanism.type === 'robot') return (r.label ? `${r.label}: ` : '') + describeRobot(r.mechanism, s);
    const parts = [s.mode, `hip at ${(1e3 * s.y).toFixed(1)} mm`];
    const force = Math.hypot(s.forceX, s.forceY);
    if (isNumber(s.contactX)) {
      parts.push(`force ${force.toFixed(1)} N`);
      if (isNumber(s.arc)) parts.push(`contact arc ${((180 / Math.PI) * s.arc).toFixed(1)}°`);
    }
    return (r.label ? `${r.label}: ` : '') + parts.join(', ');
  }

  showTrail(hopper, motion) {
    const half = this.width / 2 / this.view.scale;
    const points = [];
    const every = Math.max(1, Math.floor(motion.time.length / 4000));
    for (let i = 0; i < motion.time.length; i += every) {
      if (Math.abs(motion.x[i] - this.view.middle) < 1.1 * half) points.push(this.view.point(motion.x[i], motion.y[i]));
    }
    hopper.trail.setAttribute('points', points.join(' '));
  }

  showGround() {
    const {view} = this;
    const slope = Math.tan(this.runs[0].mechanism.ground_slope_rad || 0);
    const half = this.width / 2 / view.scale;
    const [left, right] = [view.middle - half, view.middle + half];
    const line = (x0, y0, x1, y1) => {
      const [a, b] = view.point(x0, y0);
      const [c, d] = view.point(x1, y1);
      return `M${a} ${b}L${c} ${d}`;
    };
    const parts = [svg('path', {d: line(left, left * slope, right, right * slope)})];
    const step = [0.05, 0.1, 0.2, 0.5, 1, 2].find((s) => s * view.scale >= 96) ?? 5;
    for (let x = Math.ceil(left / step) * step; x < right; x += step) {
      const [px, py] = view.point(x, x * slope);
      parts.push(svg('path', {d: `M${px} ${py}l-4 8`}));
      const label = svg('text', {x: px, y: this.height - 4});
      label.textContent = `${(Math.round(x / step) * step + 0).toFixed(step < 0.1 ? 2 : 1)} m`;
      parts.push(label);
    }
    this.ground.replaceChildren(...parts);
  }
}

const animationLegend = (two) => el('p', {class: 'legend'}, swatch('mode-flight', 'flight'), swatch('mode-rolling', 'rolling or stance'),
  swatch('mode-toe', 'on the toe'), swatch('mode-force', 'contact force on the leg'), two ? swatch('kind-two', 'before, broad and pale') : '');

// An animation with its legend; a closed form of the bent leg is no part of the data, which is said.
function animationOf(runs) {
  const animation = new Animation(runs);
  return el('div', {}, animation.element);
}

const figureOf = (mechanism) => (mechanism.type === 'robot' ? RobotFigure : Hopper);

const animationNote = 'Hip, contact point, contact arc and force are the simulation\'s; between hip and contact an arc is drawn as a circular one of its own length over the simulated chord, a straight leg of a robot as a spring.';
