// A run folder as `hoplab reproduce` writes it, with numbers that mean nothing: claims, tables over
// one and two settings, figures of lines and surfaces, two legs in motion.
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const number = (name, value, unit = '') => ({name, value, unit});

function claims() {
  const check = (holds) => ({statement: 'the apex is lower with damping', holds, numbers: [number('apex', 0.31, 'm')]});
  return [
    {name: 'claim-a', statement: 'Damping lowers the apex.', verdict: 'reproduced', remark: '', checks: [check(true)], alternatives: []},
    {name: 'claim-b', statement: 'It falls sooner with damping.', verdict: 'only under stated settings', remark: 'Not with the plain reading of the law.',
      checks: [check(false)], alternatives: [{setting: 'law consistent', holds: [true]}, {setting: 'lift-off by length', holds: [false]}]},
    {name: 'claim-c', statement: 'All starts converge.', verdict: 'not reproduced', remark: '', checks: [check(false)], alternatives: []},
  ];
}

function comparison() {
  const compared = (table, at, published, ours) => ({table, at, quantity: 'convergence_time', unit: 's', published, ours, tolerance: 0.5, agrees: ours !== null && Math.abs(ours - published) <= 0.5});
  const grid = [0.8, 1.0, 1.2].flatMap((speed) => [0.25, 0.3, 0.35].map((height) => compared('table-6.1',
    [number('start_speed', speed, 'm/s'), number('start_height', height, 'm')], 4 + speed, speed > 0.9 ? 4.2 + speed * height : null)));
  const row = [21.1, 21.4, 21.7].map((E) => compared('table-6.4', [number('E', 1e9 * E, 'Pa')], 9 - E / 5, 9.1 - E / 5));
  return {published: [...grid, ...row], statistics: {'table-6.1': {rank_correlation: {value: 0.8, unit: ''}}}};
}

function studyTables() {
  const made = (name, title, damping, verdict) => ({name, title, file: `${name}.csv`, settings: [number('damping', damping, 'N s/m')], columns: [], checks: [], verdict});
  return [made('table-6.1', 'Convergence time over starts', 0, 'not reproduced'), made('table-6.4', 'Convergence time over modulus', 6, 'reproduced')];
}

const column = (name, label, unit) => ({name, label, unit});
const figure = (name, title, kind, columns, series) => ({name, title, file: `${name}.csv`, kind, series_column: kind === 'lines' ? 'series' : null, columns, numbers: [],
  series: series.map((label) => ({label, settings: label ? {start_height_m: 0.3, touchdown_angle_rad: 0.698, straight_leg: null} : null, outcome: label ? 'completed' : null, end_time_s: null}))});

function figures() {
  const plane = [column('rear_deg', 'rear start angle', 'deg'), column('front_deg', 'front start angle', 'deg')];
  return [
    figure('figure-6.23', 'Speed, controlled', 'lines', [column('time_s', 'time', 's'), column('speed_m_per_s', 'speed', 'm/s')], ['d = 0', 'd = 3']),
    figure('figure-3.5', 'Reachable pitch', 'surface', [...plane, column('lowest_deg', 'lowest pitch', 'deg'), column('highest_deg', 'highest pitch', 'deg')], ['']),
    figure('figure-3.6', 'Feasible starts', 'surface', [...plane, column('feasible', 'feasible', '')], ['']),
  ];
}

// The CSVs of these figures by name.
function figureTables() {
  const times = Array.from({length: 200}, (_, i) => 0.075 * i);
  const speed = (rate, t) => 1 + 0.5 * (1 - Math.exp(-rate * t));
  const angles = [30, 45, 60, 75, 90];
  const pairs = angles.flatMap((rear) => angles.map((front) => [rear, front]));
  const text = (header, rows) => `${[header, ...rows].join('\n')}\n`;
  return {
    'figure-6.23': text('series,time_s,speed_m_per_s', [...times.map((t) => `d = 0,${t},${speed(0.2, t)}`), ...times.map((t) => `d = 3,${t},${speed(0.5, t)}`)]),
    'figure-3.5': text('rear_deg,front_deg,lowest_deg,highest_deg', pairs.map(([a, b]) => `${a},${b},${a === b ? '' : (a - b) / 6 - 3},${8 + (a - b) / 6}`)),
    'figure-3.6': text('rear_deg,front_deg,feasible', pairs.map(([a, b]) => `${a},${b},${a > b ? 1 : 0}`)),
  };
}

// `simulated`: run folders of two simulations to be shown in motion.
export function makeUpStudy(folder, simulated) {
  mkdirSync(folder, {recursive: true});
  const records = simulated.map((run) => JSON.parse(readFileSync(join(run, 'run.json'), 'utf8')));
  const names = ['C-leg', 'another gain'];
  const record = {
    schema: 'hoplab-run/1', command: 'reproduce', version: '0.1.0', status: 'ok', message: '', dataset: null, law: 'thesis', seed: null,
    options: {targets: ['all']}, seconds: 12.5, scenario: 'a made-up study', claims: claims(), tables: studyTables(), comparison: comparison(), figures: figures(), left_out: [],
    mechanisms: Object.fromEntries(names.map((name, i) => [name, records[i].mechanism])),
  };
  writeFileSync(join(folder, 'run.json'), JSON.stringify(record));
  for (const [name, text] of Object.entries(figureTables())) writeFileSync(join(folder, `${name}.csv`), text);
  const rows = simulated.map((run) => readFileSync(join(run, 'trajectory.csv'), 'utf8').trimEnd().split('\n'));
  writeFileSync(join(folder, 'trajectories.csv'), [`run,${rows[0][0]}`, ...rows.flatMap((lines, i) => lines.slice(1).map((line) => `${names[i]},${line}`))].join('\n') + '\n');
}
