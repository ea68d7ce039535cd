// The report of a search for the trial to record next.

const designValue = (settings, range) => {
  const keys = {angle: 'touchdown_angle_rad', height: 'height_m', speed: 'speed_m_per_s', mass: 'added_mass_kg', throw: 'throw_m_per_s', gain: 'kp_N_s', pitch: 'pitch_rad'};
  const leg = range.name.startsWith('leg_') ? `leg_angle_${range.name.slice(4)}_rad` : undefined;
  const value = settings?.[leg ?? keys[range.name]];
  return isNumber(value) && range.unit === 'deg' ? value * 180 / Math.PI : value;
};

function designsTable() {
  const space = list(run.space);
  const separates = run.task === 'separate';
  const unit = run.sharpened?.unit;
  const promise = separates ? ['doubt left [bits]', 'expected nats', 'if true'] : ['half width', 'narrower by'];
  return dataTable(['', ...space.map((r) => withUnit(r.name, r.unit)), ...promise], list(run.designs).map((d, i) => [String(i + 1),
    ...space.map((r) => significant(designValue(d.settings, r), 3)),
    ...(separates ? [significant(d.entropy_left_bits, 2), significant(d.expected_nats, 3), `${d.hardest_pair?.true}${list(run.rivals).length > 2 ? `, against ${d.hardest_pair?.other}` : ''}`] : [quantity(d.half_width, unit, 3), percent(d.worth, 2)])]),
  `r${'r'.repeat(space.length)}rr${separates ? 'l' : ''}`, 'The best designs, no two of them alike');
}

// Worth over two settings; `pair` is [across, up], columns of map.csv.
function designMap(map, pair, worth) {
  const rows = map.where({across: pair[0], up: pair[1]});
  const pick = (name) => map.pick(name, rows);
  const xs = distinct(pick('across_value'));
  const ys = distinct(pick('up_value'));
  const unit = {worth_bits: 'bits', expected_nats: 'nats'}[worth] ?? '';
  const [z, said] = [ys.map(() => Array(xs.length).fill(null)), ys.map(() => Array(xs.length).fill(''))];
  const [across, up, values, outcomes] = [pick('across_value'), pick('up_value'), pick(worth), pick('outcome')];
  rows.forEach((_, i) => {
    const [r, c] = [ys.indexOf(up[i]), xs.indexOf(across[i])];
    z[r][c] = isNumber(values[i]) ? values[i] : null;
    said[r][c] = words(outcomes[i]);
  });
  const ranges = pair.map((column) => list(run.space).find((r) => r.column === column));
  const titles = ranges.map((r) => withUnit(r.name, r.unit));
  const best = ranges.map((r) => designValue(run.designs[0].settings, r));
  const place = `${ranges[0].name} %{x:.4g} ${ranges[0].unit}<br>${ranges[1].name} %{y:.4g} ${ranges[1].unit}`;
  return {traces: [{type: 'heatmap', x: xs, y: ys, z, customdata: said, colorscale: upward(), zmin: 0, zmax: Math.max(...[...values].filter(isNumber), 1e-12), hoverongaps: true, colorbar: {thickness: 12, title: {text: unit}},
    hovertemplate: `${place}<br>%{z:.3g} ${unit}, %{customdata}<extra></extra>`},
  {x: [best[0]], y: [best[1]], mode: 'markers', name: 'best', marker: {symbol: 'star', size: 13, color: colour('paper'), line: {color: colour('ink'), width: 2}}, hovertemplate: `${place}<extra>best</extra>`}],
  layout: {xaxis: {title: {text: titles[0]}}, yaxis: {title: {text: titles[1]}}, showlegend: false}};
}

function designMaps() {
  const map = table('map');
  if (!map?.rows || !list(run.designs).length) return undefined;
  const seen = new Map();
  for (let row = 0; row < map.rows; ++row) {
    const pair = [map.column('across')[row], map.column('up')[row]];
    seen.set(pair.map((c) => splitUnit(c).name).join(' and '), pair);
  }
  let pair = [...seen.values()][0];
  const quantities = run.task === 'separate' ? new Map([['fall of the entropy', 'worth_bits'], ['nats of the hardest pair', 'expected_nats']]) : new Map([['share of the interval', 'worth']]);
  let worth = [...quantities.values()][0];
  const caption = run.task === 'separate'
    ? 'What a trial promises by the linear forecast; the other settings as in the best design. Blank where a trial cannot be simulated.'
    : 'Share by which the interval is expected to shrink; the other settings as in the best design. Blank where a trial cannot be simulated.';
  const drawn = new Plot(caption, () => designMap(map, pair, worth), {height: 420});
  return el('div', {}, choices('Settings', [...seen.keys()], (name) => {
    pair = seen.get(name);
    if (drawn.shown) drawn.show();
  }), quantities.size > 1 ? choices('Shown', [...quantities.keys()], (name) => {
    worth = quantities.get(name);
    if (drawn.shown) drawn.show();
  }) : undefined, drawn.figure);
}

function designReport() {
  const rivals = list(run.rivals);
  if (rivals.length)
    section('What is told apart', paragraph(run.decision ? `${run.decision}.` : ''), dataTable(['model with', 'probability by the recorded trials'], rivals.map((r) => [r.name, significant(r.probability, 3)]), 'lr'),
      paragraph(run.even_odds ? 'The recorded trials tell them apart already; what follows counts from even odds.' : ''), explained('separating-experiment', 'indistinguishable'));
  else if (run.sharpened)
    section('What is sharpened', paragraph(run.decision ? `${run.decision}.` : ''), dataTable(['value', 'fitted', 'half width of its 95 % interval'], [[run.sharpened.name, quantity(run.sharpened.value, run.sharpened.unit), quantity(run.sharpened.half_width, run.sharpened.unit, 2)]], 'lrr'));
  if (list(run.designs).length)
    section('What to record', designsTable(), paragraph(`Everything else as in ${run.like}, for ${quantity(run.duration_s, 's', 3)}.`), designMaps());
  section('The search', dataTable(['outcome', 'designs'], entries(run.outcomes).map(([name, count]) => [words(name), String(count)]), 'lr'),
    dataTable(['setting', 'from', 'to', 'unit'], list(run.space).map((r) => [r.name, significant(r.low, 3), significant(r.high, 3), r.unit]), 'lrrl'));
  runDetails();
}
