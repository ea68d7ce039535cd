// A run folder as `hoplab reproduce` writes it, with numbers that mean nothing: claims, tables over
// one and two settings, figures of lines and surfaces, two legs in motion.
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const number = (name, value, unit = '') => ({name, value, unit});

function claims() {
  const check = (holds) => ({statement: 'the apex is lower with damping', holds, numbers: [number('apex', 0.31, 'm')]});
  return [
    {name: 'claim-a', statement: 'Damping lowers the apex.', verdict: 'reproduced', remark: '', checks: [check(true)], alternatives: []},
    {name: 'claim-b', statement: 'It falls sooner with damping.', verdict: 'only_under_settings', remark: 'Not with the plain reading of the law.',
      checks: [check(false)], alternatives: [{setting: 'law consistent', holds: [true]}, {setting: 'lift-off by length', holds: [false]}]},
    {name: 'claim-c', statement: 'All starts converge.', verdict: 'not_reproduced', remark: '', checks: [check(false)], alternatives: []},
  ];
}

function studyTables() {
  const compared = (at, published, ours) => ({at, quantity: 'convergence_time', unit: 's', published, ours, tolerance: 0.5, agrees: ours !== null && Math.abs(ours - published) <= 0.5});
  const grid = [0.8, 1.0, 1.2].flatMap((speed) => [0.25, 0.3, 0.35].map((height) => compared(
    [number('start_speed', speed, 'm/s'), number('start_height', height, 'm')], 4 + speed, speed > 0.9 ? 4.2 + speed * height : null)));
  const row = [21.1, 21.4, 21.7].map((E) => compared([number('E', 1e9 * E, 'Pa')], 9 - E / 5, 9.1 - E / 5));
  const common = {statistics: [number('rank_correlation', 0.8)], checks: [], columns: [], rows: []};
  return [
    {name: 'table-6.1', title: 'Convergence time over starts', settings: [number('damping', 0, 'N s/m')], numbers: grid, verdict: 'not_reproduced', ...common},
    {name: 'table-6.4', title: 'Convergence time over modulus', settings: [number('damping', 6, 'N s/m')], numbers: row, verdict: 'reproduced', ...common},
  ];
}

function figures() {
  const column = (name, label, unit) => ({name, label, unit});
  const angles = [30, 45, 60, 75, 90];
  const plane = angles.flatMap((rear) => angles.map((front) => [rear, front, 8 + (rear - front) / 6, rear === front ? null : (rear - front) / 6 - 3]));
  return [
    {name: 'figure-6.23', title: 'Speed, controlled.', kind: 'lines', columns: [column('time_s', 'time', 's'), column('speed_m_per_s', 'speed', 'm/s')], numbers: [],
      curves: ['d = 0', 'd = 3'].map((label) => ({label, settings: {start_height_m: 0.3, touchdown_angle_rad: 0.698}, outcome: 'completed', end_time_s: 15}))},
    {name: 'pitch-range', title: 'Reachable pitch.', kind: 'surface', numbers: [], curves: [{label: '', rows: plane}],
      columns: [column('rear_deg', 'rear start angle', 'deg'), column('front_deg', 'front start angle', 'deg'), column('max_deg', 'greatest pitch', 'deg'), column('min_deg', 'least pitch', 'deg')]},
  ];
}

// `simulated`: run folders of two simulations to be shown in motion.
export function makeUpStudy(folder, simulated) {
  mkdirSync(folder, {recursive: true});
  const records = simulated.map((run) => JSON.parse(readFileSync(join(run, 'run.json'), 'utf8')));
  const names = ['C-leg', 'another gain'];
  const record = {
    schema: 'hoplab-run/1', command: 'reproduce', version: '0.1.0', status: 'ok', message: '', dataset: null, law: 'thesis', seed: null,
    options: {targets: ['all']}, seconds: 12.5, scenario: 'a made-up study', claims: claims(), tables: studyTables(), figures: figures(),
    mechanisms: Object.fromEntries(names.map((name, i) => [name, records[i].mechanism])),
  };
  writeFileSync(join(folder, 'run.json'), JSON.stringify(record));
  const times = Array.from({length: 200}, (_, i) => 0.075 * i);
  const speed = (rate, t) => 1 + 0.5 * (1 - Math.exp(-rate * t));
  writeFileSync(join(folder, 'figure-6.23.csv'), ['curve,time_s,speed_m_per_s', ...times.map((t) => `d = 0,${t},${speed(0.2, t)}`), ...times.map((t) => `d = 3,${t},${speed(0.5, t)}`)].join('\n') + '\n');
  const rows = simulated.map((run) => readFileSync(join(run, 'trajectory.csv'), 'utf8').trimEnd().split('\n'));
  writeFileSync(join(folder, 'trajectories.csv'), [`run,${rows[0][0]}`, ...rows.flatMap((lines, i) => lines.slice(1).map((line) => `${names[i]},${line}`))].join('\n') + '\n');
}
