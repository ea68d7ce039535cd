// The report of a reproduced study: claims, tables beside the published ones, figures, kinematics.
// A figure's curves stand in its CSV, told apart by its `series_column`; of a surface the first two
// columns are the plane. trajectories.csv has the runs of two legs, told apart by `run`; `mechanisms` says what each is; shown in
// motion where a run folder has them.

const verdictKinds = {'reproduced': 'supported', 'only under stated settings': 'indistinguishable', 'not reproduced': 'excluded'};
const badge = (verdict) => el('span', {class: `status ${verdictKinds[verdict] ?? 'not_tested'}`}, verdict ? words(verdict) : 'not judged');

// "damping 3 N s/m": as captions say it, angles in degrees.
function namedValue(name, value, unit) {
  const shown = unit === 'rad' ? brief((180 / Math.PI) * value, 'deg') : brief(value, unit);
  return `${words(name)} ${shown}`;
}

// A list of {name, value, unit}, or an object whose keys end with their units.
function settingsText(settings) {
  if (Array.isArray(settings)) return settings.map((s) => namedValue(s.name, s.value, s.unit)).join(', ');
  return entries(settings).filter(([, v]) => v !== null).map(([key, v]) => {
    if (typeof v === 'object') return `${words(key)} (${settingsText(v)})`;
    const {name, unit} = splitUnit(key);
    return isNumber(v) ? namedValue(name, v, unit) : `${words(name)} ${v}`;
  }).join(', ');
}

const checkTable = (checks) => (list(checks).length ? dataTable(['', 'what has to hold', 'figures'], list(checks).map((c) => [
  el('span', {class: `status ${c.holds ? 'supported' : 'excluded'}`}, c.holds ? 'holds' : 'does not'), c.statement, settingsText(c.numbers)])) : undefined);

// The rows of a CSV of the run folder under the labels of its columns.
function plainTable(item) {
  const rows = item.file ? table(item.file.replace(/\.csv$/, '')) : undefined;
  if (!rows) return undefined;
  const columns = list(item.columns).filter((c) => rows.has(c.name));
  return dataTable(columns.map((c) => withUnit(c.label, c.unit)), rows.where({}).slice(0, 100).map((row) => columns.map((c) => brief(rows.column(c.name)[row]))), 'r'.repeat(columns.length));
}

function claimPart(claim) {
  const alternatives = list(claim.alternatives);
  return el('article', {class: 'claim'}, el('h3', {}, badge(claim.verdict), ' ', words(claim.name)), paragraph(claim.statement),
    claim.remark ? paragraph(`${claim.remark.replace(/^./, (c) => c.toUpperCase())}.`, 'said') : undefined,
    details('What decided it', checkTable(claim.checks), alternatives.length ? dataTable(['with other settings', 'holds'],
      alternatives.map((a) => [a.setting, list(a.holds).every(Boolean) ? 'all of it' : `${list(a.holds).filter(Boolean).length} of ${list(a.holds).length} checks`])) : undefined,
    paragraph(settingsText(claim.numbers), 'said'), plainTable(claim)));
}

// Angles of a cell in degrees.
const inDegrees = (number) => ({...number, at: list(number.at).map((a) => (a.unit === 'rad' ? {...a, value: (180 / Math.PI) * a.value, unit: 'deg'} : a))});

const atLabel = (number) => withUnit(words(number.name), number.unit);

// Published, ours and the difference of one quantity over two settings, as heat maps on one scale.
function comparisonMaps(name, numbers) {
  const [first, second] = [0, 1].map((i) => distinct(numbers.map((n) => n.at[i].value)));
  const grid = (value) => second.map((y) => first.map((x) => {
    const found = numbers.find((n) => n.at[0].value === x && n.at[1].value === y);
    const v = found ? value(found) : null;
    return isNumber(v) ? v : null;
  }));
  const unit = numbers[0].unit;
  const panels = [['published', (n) => n.published], ['ours', (n) => n.ours], ['ours − published', (n) => (isNumber(n.ours) && isNumber(n.published) ? n.ours - n.published : null)]];
  const all = numbers.flatMap((n) => [n.published, n.ours]).filter(isNumber);
  const apart = Math.max(...numbers.map((n) => Math.abs((n.ours ?? NaN) - (n.published ?? NaN))).filter(isNumber), 1e-12);
  return plot(`${name} [${unit}]: as published, ours, and the difference; blank where there is none.`, () => {
    const layout = {margin: {l: 56, r: 12, t: 34, b: 48}, annotations: []};
    const domains = panelDomains(3, narrow.matches ? 0.1 : 0.035);
    const traces = panels.map(([title, value], i) => {
      const k = i ? String(i + 1) : '';
      const labelled = narrow.matches ? i === 2 : i === 1;
      layout[`xaxis${k}`] = {domain: domains[i].x, type: 'category', title: {text: labelled ? atLabel(numbers[0].at[0]) : ''}, anchor: `y${k}`};
      layout[`yaxis${k}`] = {domain: domains[i].y, type: 'category', title: {text: i ? '' : atLabel(numbers[0].at[1])}, showticklabels: i === 0 || narrow.matches, anchor: `x${k}`};
      layout.annotations.push({text: title, xref: 'paper', yref: 'paper', x: domains[i].x[0], xanchor: 'left', y: domains[i].y[1], yanchor: 'bottom', showarrow: false});
      const scale = i === 2 ? {colorscale: diverging(), zmin: -apart, zmax: apart} : {colorscale: sequential(), zmin: Math.min(...all), zmax: Math.max(...all)};
      return {type: 'heatmap', x: first.map((v) => brief(v)), y: second.map((v) => brief(v)), z: grid(value), xaxis: `x${k}`, yaxis: `y${k}`, ...scale, showscale: false, xgap: 2, ygap: 2,
        texttemplate: first.length < 8 ? (i === 2 ? '%{z:.2g}' : '%{z:.3g}') : '', hovertemplate: `${words(numbers[0].at[0].name)} %{x} ${numbers[0].at[0].unit}, ${words(numbers[0].at[1].name)} %{y} ${numbers[0].at[1].unit}<br>%{z:.4g} ${unit}<extra>${title}</extra>`};
    });
    return {traces, layout, height: (150 + 34 * second.length) * (narrow.matches ? 2.2 : 1)};
  }, {height: 150 + 34 * second.length});
}

function comparisonLines(name, numbers) {
  const at = numbers[0].at[0] ?? {name: '', unit: ''};
  const across = readableUnit(at.value, at.unit);
  const up = readableUnit(numbers.map((n) => n.published ?? n.ours).find(isNumber), numbers[0].unit);
  const x = numbers.map((n) => n.at[0]?.value * across.factor);
  const line = (key, title, kind, symbol) => ({x, y: numbers.map((n) => (isNumber(n[key]) ? n[key] * up.factor : null)), mode: 'lines+markers', name: title, marker: {symbol, size: 8}, line: {color: colour(kind)},
    hovertemplate: `%{x:.4g} ${across.unit}: %{y:.4g} ${up.unit}<extra>${title}</extra>`});
  return plot(`${name.replace(/^./, (c) => c.toUpperCase())}, as published and ours.`, () => ({traces: [line('published', 'published', 'two', 'diamond'), line('ours', 'ours', 'one', 'circle')],
    layout: {xaxis: {title: {text: withUnit(words(at.name), across.unit)}}, yaxis: {title: {text: withUnit(name, up.unit)}}}}), {height: 280});
}

function statisticsTable(statistics) {
  const rows = entries(statistics).map(([name, s]) => [words(name), brief(s.value, s.unit)]);
  return rows.length ? dataTable(['how far apart', ''], rows, 'lr') : undefined;
}

function tablePart(t) {
  const numbers = list(run.comparison?.published).filter((n) => n.table === t.name).map(inDegrees);
  const quantities = [...new Set(numbers.map((n) => n.quantity))];
  const agree = numbers.filter((n) => n.agrees).length;
  return el('article', {class: 'comparison'}, el('h3', {}, `${words(t.name)}: ${t.title ?? ''} `, badge(t.verdict)),
    paragraph([settingsText(t.settings), numbers.length ? `${agree} of ${numbers.length} numbers within their tolerance` : ''].filter(Boolean).join('; '), 'said'),
    ...quantities.map((q) => {
      const of = numbers.filter((n) => n.quantity === q);
      return list(of[0].at).length >= 2 ? comparisonMaps(words(q), of) : comparisonLines(words(q), of);
    }),
    details('Every number, and what was asked of them', checkTable(t.checks), statisticsTable(run.comparison?.statistics?.[t.name]),
      dataTable(['at', 'quantity', 'published', 'ours', 'unit', 'tolerance', ''], numbers.map((n) => [settingsText(n.at), words(n.quantity), isNumber(n.published) ? significant(n.published, 5) : 'none',
        isNumber(n.ours) ? significant(n.ours, 5) : 'none', n.unit, brief(n.tolerance), n.agrees ? 'agrees' : 'differs']), 'llrrlrl')));
}

// The columns of one series of a figure, in the order of the figure's own columns.
function seriesColumns(figure, label) {
  const rows = table((figure.file ?? figure.name).replace(/\.csv$/, ''));
  if (!rows) return list(figure.columns).map(() => []);
  const of = rows.where(figure.series_column && rows.has(figure.series_column) ? {[figure.series_column]: label} : {});
  return list(figure.columns).map((c) => rows.pick(c.name, of));
}

const figureColumns = (figure) => list(figure.columns).map((c) => ({label: c.label ?? words(splitUnit(c.name).name), unit: c.unit ?? splitUnit(c.name).unit}));

// What the captions of the study state: settings common to all curves (a curve's label tells its own),
// and how the runs ended.
function captionSettings(curves) {
  const own = curves.map((c) => entries(c.settings).filter(([, v]) => v !== null));
  const common = (own[0] ?? []).filter(([key, v]) => own.every((o) => o.some(([k, w]) => k === key && JSON.stringify(w) === JSON.stringify(v))));
  const ends = [...new Set(curves.map((c) => words(c.outcome ?? '')))];
  const ended = ends.length === 1 ? ends[0] : curves.map((c) => `${c.label}: ${words(c.outcome ?? notComputed)}`).join('; ');
  return [settingsText(Object.fromEntries(common)), ended ? `Ended: ${ended}` : ''].filter(Boolean).map((t) => `${t.replace(/^./, (c) => c.toUpperCase())}.`).join(' ');
}

function linesFigure(figure) {
  const curves = list(figure.series);
  const columns = figureColumns(figure);
  const kinds = ['one', 'two', 'three', 'four'];
  return plot(`${words(figure.name)}. ${figure.title ?? ''}. ${captionSettings(curves)}`, () => ({
    traces: curves.map((curve, i) => {
      const data = seriesColumns(figure, curve.label);
      return {x: data[0], y: data[1], mode: 'lines', name: curve.label || figure.name, line: {color: colour(kinds[i % 4]), dash: i < 4 ? 'solid' : 'dash', width: 1.8},
        hovertemplate: `%{x:.4g} ${columns[0]?.unit ?? ''}: %{y:.4g} ${columns[1]?.unit ?? ''}<extra>${curve.label ?? ''}</extra>`};
    }),
    layout: {xaxis: {title: {text: withUnit(columns[0]?.label ?? '', columns[0]?.unit)}}, yaxis: {title: {text: withUnit(columns[1]?.label ?? '', columns[1]?.unit)}}, showlegend: curves.length > 1},
  }), {height: 300});
}

// Values over a plane, as rows of a grid.
function gridOf(xs, ys, z) {
  const [x, y] = [distinct([...xs]), distinct([...ys])];
  const at = new Map([...xs].map((v, i) => [`${v},${ys[i]}`, i]));
  const value = (a, b) => z[at.get(`${a},${b}`)];
  return {x, y, z: y.map((b) => x.map((a) => (isNumber(value(a, b)) ? value(a, b) : null)))};
}

const axisText = (column) => ({text: withUnit(column?.label ?? '', column?.unit)});
const isFlat = (figure) => list(figure.columns).length < 4;

// One value over a plane is a map, several are surfaces.
function mapFigure(figure) {
  const [cx, cy, cz] = figureColumns(figure);
  const [xs, ys, zs] = seriesColumns(figure);
  return plot(`${words(figure.name)}. ${figure.title ?? ''}.`, () => ({
    traces: [{type: 'heatmap', ...gridOf(xs, ys, zs), colorscale: upward(), showscale: Boolean(cz?.unit), xgap: 1, ygap: 1,
      hovertemplate: `${cx.label} %{x:.4g} ${cx.unit}<br>${cy.label} %{y:.4g} ${cy.unit}<br>${cz.label} %{z:.4g} ${cz.unit}<extra></extra>`}],
    layout: {xaxis: {title: axisText(cx), constrain: 'domain'}, yaxis: {title: axisText(cy), scaleanchor: cx.unit === cy.unit ? 'x' : undefined}}}), {height: 420});
}

function surfaceFigure(figure) {
  const columns = figureColumns(figure);
  const [xs, ys, ...zs] = seriesColumns(figure);
  return plot(`${words(figure.name)}. ${figure.title ?? ''}. Drag to turn.`, () => {
    const axis = (title) => ({title, gridcolor: colour('line'), color: colour('ink'), backgroundcolor: 'rgba(0,0,0,0)'});
    const paint = [[[0, colour('heat-1')], [1, colour('one')]], [[0, colour('toe')], [1, colour('two')]]];
    return {traces: zs.map((z, i) => ({type: 'surface', ...gridOf(xs, ys, z), name: columns[i + 2].label, colorscale: paint[i % 2], showscale: false, opacity: 0.95,
      hovertemplate: `${columns[0].label} %{x:.4g} ${columns[0].unit}<br>${columns[1].label} %{y:.4g} ${columns[1].unit}<br>${columns[i + 2].label} %{z:.4g} ${columns[i + 2].unit}<extra></extra>`})),
    layout: {margin: {l: 0, r: 0, t: 0, b: 0}, scene: {xaxis: axis(axisText(columns[0])), yaxis: axis(axisText(columns[1])), zaxis: axis({text: withUnit(zs.length > 1 ? '' : columns[2].label, columns[2].unit).trim()}), camera: {eye: {x: 1.5, y: -1.5, z: 0.9}}}}};
  }, {height: 460, surfaces: true});
}

function motionPart() {
  const motion = table('trajectories');
  if (!motion?.has('run')) return;
  const mechanism = (name) => run.mechanisms?.[name] ?? run.mechanism;
  const names = motion.values('run').filter(mechanism);
  const runs = names.slice(0, 2).map((name, i) => ({label: name, kind: i ? 'before' : 'after', mechanism: mechanism(name), motion: motionOf(motion, motion.where({run: name}))}));
  if (runs.length) section('In motion', animationOf(runs), animationLegend(false), paragraph(runs.length > 1 ? `Broad and pale: ${names[1]}.` : ''), paragraph(animationNote, 'note'));
}

function reproductionReport() {
  const figures = list(run.figures);
  const surfaces = figures.filter((f) => f.kind === 'surface');
  const lines = figures.filter((f) => f.kind !== 'surface');
  if (list(run.claims).length) section('Claims', ...list(run.claims).map(claimPart));
  if (list(run.tables).length) section('Tables', ...list(run.tables).map(tablePart));
  if (lines.length) section('Figures', el('div', {class: 'pair'}, ...lines.map(linesFigure)));
  if (surfaces.length) section('Kinematics', ...surfaces.map((f) => (isFlat(f) ? mapFigure(f) : surfaceFigure(f))));
  motionPart();
  runDetails();
}
