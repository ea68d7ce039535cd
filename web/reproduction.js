// The report of a reproduced study. What it reads of run.json:
//   claims   [{name, statement, verdict, remark, checks: [{statement, holds, numbers}],
//              alternatives: [{setting, holds: [..]}]}]
//   tables   [{name, title, verdict, settings, checks, statistics,
//              numbers: [{at: [{name, value, unit}], quantity, unit, published, ours, tolerance, agrees}]}]
//   figures  [{name, title, kind: "lines" or "surface", columns: [{name, label, unit}], numbers,
//              curves: [{label, settings, outcome, end_time_s, file, rows}]}]
// A curve's rows stand in it, or in the CSV `file` (default: the figure's name), there told apart by
// a column `curve` where there are several. Lines: first column across, second up. Surface: over the
// plane of the first two columns. trajectories.csv with a column `run`, and `mechanisms` by run, are
// shown in motion.

const verdictKinds = {reproduced: 'supported', only_under_settings: 'indistinguishable', not_reproduced: 'excluded'};
const badge = (verdict) => el('span', {class: `status ${verdictKinds[verdict] ?? 'not_tested'}`}, verdict ? words(verdict) : 'not judged');

// {name: value}, or a list of {name, value, unit}, as "E = 22 GPa, d = 3 N s/m".
function settingsText(settings) {
  if (Array.isArray(settings)) return settings.map((s) => `${words(s.name)} ${brief(s.value, s.unit)}`).join(', ');
  return entries(settings).filter(([, v]) => v !== null && typeof v !== 'object').map(([key, v]) => {
    const {name, unit} = splitUnit(key);
    return `${words(name)} ${isNumber(v) ? brief(v, unit) : v}`;
  }).join(', ');
}

const checkTable = (checks) => (list(checks).length ? dataTable(['', 'what has to hold', 'figures'], list(checks).map((c) => [
  el('span', {class: `status ${c.holds ? 'supported' : 'excluded'}`}, c.holds ? 'holds' : 'does not'), c.statement, settingsText(c.numbers)])) : undefined);

function claimPart(claim) {
  const alternatives = list(claim.alternatives);
  return el('article', {class: 'claim'}, el('h3', {}, badge(claim.verdict), ' ', words(claim.name)), paragraph(claim.statement), paragraph(claim.remark, 'said'),
    details('What decided it', checkTable(claim.checks), alternatives.length ? dataTable(['with other settings', 'holds'],
      alternatives.map((a) => [a.setting, list(a.holds).every(Boolean) ? 'all of it' : `${list(a.holds).filter(Boolean).length} of ${list(a.holds).length} checks`])) : undefined));
}

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
  const {unit} = numbers[0];
  const at = numbers[0].at[0] ?? {name: '', unit: ''};
  const scale = readableUnit(at.value, at.unit);
  const x = numbers.map((n) => n.at[0]?.value * scale.factor);
  const line = (key, title, kind, symbol) => ({x, y: numbers.map((n) => n[key]), mode: 'lines+markers', name: title, marker: {symbol, size: 8}, line: {color: colour(kind)},
    hovertemplate: `%{x:.4g} ${scale.unit}: %{y:.4g} ${unit}<extra>${title}</extra>`});
  return plot(`${name}, as published and ours.`, () => ({traces: [line('published', 'published', 'two', 'diamond'), line('ours', 'ours', 'one', 'circle')],
    layout: {xaxis: {title: {text: withUnit(words(at.name), scale.unit)}}, yaxis: {title: {text: withUnit(name, unit)}}}}), {height: 300});
}

function tablePart(t) {
  const numbers = list(t.numbers);
  const quantities = [...new Set(numbers.map((n) => n.quantity))];
  const agree = numbers.filter((n) => n.agrees).length;
  return el('article', {class: 'comparison'}, el('h3', {}, `${words(t.name)}: ${t.title ?? ''} `, badge(t.verdict)),
    paragraph([settingsText(t.settings), numbers.length ? `${agree} of ${numbers.length} numbers within their tolerance` : '', settingsText(t.statistics)].filter(Boolean).join('; '), 'said'),
    ...quantities.map((q) => {
      const of = numbers.filter((n) => n.quantity === q);
      return list(of[0].at).length >= 2 ? comparisonMaps(words(q), of) : comparisonLines(words(q), of);
    }),
    details('Every number', dataTable(['at', 'quantity', 'published', 'ours', 'unit', 'tolerance', ''], numbers.map((n) => [settingsText(n.at), words(n.quantity), isNumber(n.published) ? significant(n.published, 5) : 'none',
      isNumber(n.ours) ? significant(n.ours, 5) : 'none', n.unit, significant(n.tolerance, 3), n.agrees ? 'agrees' : 'differs']), 'llrrlrl'), checkTable(t.checks)));
}

// Columns of a curve, from the record or from the figure's table.
function curveColumns(figure, curve, place) {
  const names = list(figure.columns).map((c) => c.name);
  if (list(curve.rows).length) return names.map((_, c) => curve.rows.map((row) => row[c] ?? NaN));
  const name = (curve.file ?? figure.file ?? figure.name).replace(/\.csv$/, '');
  const rows = table(name);
  if (!rows) return names.map(() => []);
  const several = rows.has('curve') ? rows.where({curve: rows.values('curve').includes(curve.label) ? curve.label : place}) : rows.where({});
  return names.map((n) => rows.pick(n, several));
}

const figureColumns = (figure) => list(figure.columns).map((c) => ({label: c.label ?? words(splitUnit(c.name).name), unit: c.unit ?? splitUnit(c.name).unit}));

function linesFigure(figure) {
  const curves = list(figure.curves);
  const columns = figureColumns(figure);
  const kinds = ['one', 'two', 'three', 'four'];
  const settings = curves.map((c) => [c.label, settingsText(c.settings), c.outcome ? words(c.outcome) : ''].filter(Boolean).join(': ')).join('; ');
  return plot(`${words(figure.name)}. ${figure.title ?? ''} ${settings ? `(${settings})` : ''}`, () => ({
    traces: curves.map((curve, i) => {
      const data = curveColumns(figure, curve, i);
      return {x: data[0], y: data[1], mode: 'lines', name: curve.label || figure.name, line: {color: colour(kinds[i % 4]), dash: i < 4 ? 'solid' : 'dash', width: 1.8},
        hovertemplate: `%{x:.4g} ${columns[0]?.unit ?? ''}: %{y:.4g} ${columns[1]?.unit ?? ''}<extra>${curve.label ?? ''}</extra>`};
    }),
    layout: {xaxis: {title: {text: withUnit(columns[0]?.label ?? '', columns[0]?.unit)}}, yaxis: {title: {text: withUnit(columns[1]?.label ?? '', columns[1]?.unit)}}, showlegend: curves.length > 1},
  }), {height: 300});
}

function surfaceFigure(figure) {
  const columns = figureColumns(figure);
  const [xs, ys, ...zs] = curveColumns(figure, list(figure.curves)[0] ?? {}, 0);
  const [x, y] = [distinct([...xs]), distinct([...ys])];
  const at = new Map([...xs].map((v, i) => [`${v},${ys[i]}`, i]));
  const grid = (z) => y.map((b) => x.map((a) => { const i = at.get(`${a},${b}`); return i === undefined || !isNumber(z[i]) ? null : z[i]; }));
  return plot(`${words(figure.name)}. ${figure.title ?? ''} Drag to turn.`, () => {
    const axis = (i) => ({title: {text: withUnit(columns[i]?.label ?? '', columns[i]?.unit)}, gridcolor: colour('line'), color: colour('ink'), backgroundcolor: 'rgba(0,0,0,0)'});
    return {traces: zs.map((z, i) => ({type: 'surface', x, y, z: grid(z), name: columns[i + 2]?.label, colorscale: i ? [[0, colour('paper')], [1, colour('two')]] : upward(), showscale: false, opacity: 0.95,
      hovertemplate: `${columns[0].label} %{x:.4g} ${columns[0].unit}<br>${columns[1].label} %{y:.4g} ${columns[1].unit}<br>${columns[i + 2]?.label} %{z:.4g} ${columns[i + 2]?.unit}<extra></extra>`})),
    layout: {margin: {l: 0, r: 0, t: 0, b: 0}, scene: {xaxis: axis(0), yaxis: axis(1), zaxis: {...axis(2), title: {text: columns.length > 3 ? withUnit('', columns[2].unit) : axis(2).title.text}}, camera: {eye: {x: 1.5, y: -1.5, z: 0.9}}}}};
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
  if (surfaces.length) section('Kinematics', ...surfaces.map(surfaceFigure));
  motionPart();
  runDetails();
}
