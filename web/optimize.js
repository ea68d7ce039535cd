// The report of a search for gains.

const objectiveUnit = () => (run.objective === 'convergence_time' ? 's' : '');
const ofStrides = () => run.mechanism?.type === 'robot';
const objectiveName = () => words(run.objective ?? 'objective');

function historyPlot() {
  const history = table('history');
  if (!history?.rows) return undefined;
  const kinds = ['one', 'two', 'three', 'four', 'soft'];
  return plot('The best found so far, seed by seed.', () => ({
    traces: history.values('seed').map((seed, i) => {
      const rows = history.where({seed});
      return {x: history.pick('evaluation', rows), y: history.pick('objective', rows), mode: 'lines', line: {shape: 'hv', color: colour(kinds[i % 5])}, name: `seed ${seed}`,
        hovertemplate: `evaluation %{x}: %{y:.5g} ${objectiveUnit()}<extra>seed ${seed}</extra>`};
    }),
    layout: {xaxis: {title: {text: 'evaluation'}}, yaxis: {title: {text: withUnit(objectiveName(), objectiveUnit())}}, showlegend: true},
  }), {height: 300});
}

function mapPlot() {
  const map = table('map');
  const best = entries(run.best?.parameters);
  if (!map || best.length < 2) return undefined;
  const [first, second] = map.names;
  const xs = [...new Set(map.column(first))].sort((a, b) => a - b);
  const ys = [...new Set(map.column(second))].sort((a, b) => a - b);
  const z = ys.map(() => Array(xs.length).fill(null));
  const said = ys.map(() => Array(xs.length).fill(''));
  for (let row = 0; row < map.rows; ++row) {
    const [i, j] = [ys.indexOf(map.column(second)[row]), xs.indexOf(map.column(first)[row])];
    const value = map.column('objective')[row];
    const verdict = words(map.column('verdict')[row]);
    z[i][j] = isNumber(value) ? value : null;
    said[i][j] = verdict === 'run ended' ? words(map.column('outcome')[row]) : verdict;
  }
  const [across, up] = [first, second].map(splitKey);
  const place = `${across.name} %{x:.4g} ${across.unit}<br>${up.name} %{y:.4g} ${up.unit}`;
  const mark = (point, name, symbol) => ({x: [point[0]], y: [point[1]], mode: 'markers', name, marker: {symbol, size: 13, color: colour('paper'), line: {color: colour('ink'), width: 2}},
    hovertemplate: `${place}<extra>${name}</extra>`});
  const before = list(run.variables).map((v) => v.before);
  return plot(`The map of ${objectiveName()}${objectiveUnit() ? ` [${objectiveUnit()}]` : ''}, other variables at their best; blank where nothing settles.`, () => ({
    traces: [{type: 'heatmap', x: xs, y: ys, z, customdata: said, colorscale: downward(), hoverongaps: true, colorbar: {thickness: 12, title: {text: objectiveUnit()}},
      hovertemplate: `${place}<br>%{z:.4g} ${objectiveUnit()}, %{customdata}<extra></extra>`},
    mark(best.map(([, v]) => v), 'best', 'star'), ...(before.length > 1 ? [mark(before, 'before', 'circle')] : [])],
    layout: {xaxis: {title: {text: withUnit(across.name, across.unit)}}, yaxis: {title: {text: withUnit(up.name, up.unit)}}, showlegend: true},
  }), {height: 420});
}

function robustnessTable(robustness) {
  if (!robustness) return undefined;
  const worst = (w) => (w ? `${w.converged} of ${w.runs} settle${isNumber(w.worst_time_s) ? `, at worst in ${quantity(w.worst_time_s, 's', 3)}` : ''}${w.ended ? `, ${w.ended} fall` : ''}` : notComputed);
  const noise = (n) => (n ? `${n.fell} of ${n.runs} fall; speed varies by ${percent(n.relative_speed_deviation, 2)}` : notComputed);
  return dataTable(['', 'before', 'best'], [
    ['stiffness up to 5 % off', worst(robustness.before?.stiffness_5_percent), worst(robustness.best?.stiffness_5_percent)],
    ['other starts', worst(robustness.before?.starts), worst(robustness.best?.starts)],
    ...(robustness.before?.touchdown_noise_half_deg?.runs ? [['half a degree of noise at every landing', noise(robustness.before?.touchdown_noise_half_deg), noise(robustness.best?.touchdown_noise_half_deg)]] : [])], 'lll');
}

function searchTable() {
  const value = (point, key, unit) => (point ? quantity(point[key], unit) : notComputed);
  return dataTable(['', 'before', 'best', 'searched'], [
    ...list(run.variables).map((v) => [withUnit(splitKey(v.name).name, splitKey(v.name).unit), significant(v.before), significant(run.best?.parameters?.[v.name]), `${significant(v.low)} to ${significant(v.high)}`]),
    ...[['convergence time', 'convergence_time_s', 's', !ofStrides()], ['steady speed', 'steady_speed_m_per_s', 'm/s', true], ['cost of transport', 'cost_of_transport', '', ofStrides()],
      ['spectral radius', 'spectral_radius', '', true], ['greatest torque', 'max_torque_N_m', 'N m', true], ['ground clearance', 'clearance_m', 'm', !ofStrides()]].filter((row) => row[3])
      .map(([name, key, unit]) => [name, value(run.before, key, unit), value(run.best, key, unit), ''])], 'lrrr');
}

// The best gait in front, the one before behind it.
function gaitsInMotion(cycles, sets) {
  const names = sets.map(([name]) => name).reverse();
  const motions = repeatedTogether(names.map((name) => motionOf(cycles, cycles.where({run: name}))));
  return names.map((name, i) => ({label: name, kind: i ? 'before' : 'after', mechanism: run.mechanism, motion: motions[i]}));
}

function optimizeReport() {
  const gaits = run.gaits ?? {};
  section('Before and best', searchTable(), explained('convergence-time', 'spectral-radius', 'fixed-point'));
  section('The search', paragraph(`${run.evaluations} evaluations by ${run.algorithm}; ${run.agreeing_seeds} of ${plural(list(run.seeds).length, 'seed')} end within 1 % of the best.`), mapPlot(), historyPlot());
  const cycles = table('cycles');
  const sets = [['before', 'two', 'diamond'], ['best', 'one', 'circle']].filter(([name]) => gaits[name]);
  if (sets.length) {
    section('The gaits', gaitTable([['before', gaits.before], ['best', gaits.best]]),
      multiplierPlot(sets.map(([name, kind, symbol]) => ({name, kind, symbol, values: gaits[name].multipliers})), 'Multipliers of the return map: inside the unit circle a disturbance dies out, the nearer to 0 the sooner.'),
      cycles ? phasePlot(sets.map(([name, kind]) => ({name, kind, trajectory: cycles, rows: cycles.where({run: name})})), 'The limit cycles.') : undefined,
      cycles && run.mechanism ? animationOf(gaitsInMotion(cycles, sets)) : undefined,
      animationLegend(sets.length > 1), paragraph(animationNote, 'note'));
  }
  section('Robustness', robustnessTable(run.robustness));
  runDetails();
}
