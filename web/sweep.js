// The report of a sweep.

// Columns that are varied: they come first and hold more than one value.
function sweepColumns(rows) {
  const columns = list(run.columns).filter((c) => rows.has(c.name) && typeof rows.column(c.name)[0] === 'number' || rows.has(c.name) && ArrayBuffer.isView(rows.column(c.name)));
  const keys = columns.filter((c) => c.name.includes('.') || splitUnit(c.name).unit === 'deg' || c.name.startsWith('initial'));
  const varied = keys.filter((c) => new Set(rows.column(c.name)).size > 1);
  const outputs = columns.filter((c) => !keys.includes(c) && [...rows.column(c.name)].some(isNumber));
  return {varied, outputs};
}

const shortName = (name) => splitUnit(name.split('.').pop()).name;

function sweepPlot(rows, output, varied) {
  const x = [...rows.column(varied[0].name)];
  const z = [...rows.column(output.name)];
  const axisTitle = (c) => ({title: {text: withUnit(words(shortName(c.name)), c.unit)}});
  const missing = rows.has('outcome') ? rows.column('outcome') : [];
  if (varied.length >= 2) {
    const y = [...rows.column(varied[1].name)];
    const [xs, ys] = [[...new Set(x)].sort((a, b) => a - b), [...new Set(y)].sort((a, b) => a - b)];
    if (xs.length * ys.length <= 1.5 * rows.rows) { // a grid; of further keys the last row counts
      const grid = ys.map(() => Array(xs.length).fill(null));
      const said = ys.map(() => Array(xs.length).fill(''));
      x.forEach((v, i) => {
        grid[ys.indexOf(y[i])][xs.indexOf(v)] = isNumber(z[i]) ? z[i] : null;
        said[ys.indexOf(y[i])][xs.indexOf(v)] = missing[i] ?? '';
      });
      return {traces: [{type: 'heatmap', x: xs, y: ys, z: grid, customdata: said, colorscale: sequential(), hoverongaps: true, colorbar: {thickness: 12, title: {text: output.unit}}, xgap: 1, ygap: 1,
        hovertemplate: `%{x:.5g} ${varied[0].unit}, %{y:.5g} ${varied[1].unit}<br>%{z:.5g} ${output.unit}<br>%{customdata}<extra></extra>`}],
      layout: {xaxis: axisTitle(varied[0]), yaxis: axisTitle(varied[1])}};
    }
    return {traces: [{x, y, mode: 'markers', marker: {color: z, size: 9, colorscale: sequential(), showscale: true, line: {color: colour('soft'), width: 1}, colorbar: {thickness: 12, title: {text: output.unit}}},
      customdata: z, hovertemplate: `%{x:.5g} ${varied[0].unit}, %{y:.5g} ${varied[1].unit}<br>%{customdata:.5g} ${output.unit}<extra></extra>`}],
    layout: {xaxis: axisTitle(varied[0]), yaxis: axisTitle(varied[1])}};
  }
  return {traces: [{x, y: z, mode: 'lines+markers', line: {color: colour('one')}, hovertemplate: `%{x:.5g} ${varied[0].unit}: %{y:.5g} ${output.unit}<extra></extra>`}],
    layout: {xaxis: axisTitle(varied[0]), yaxis: {title: {text: withUnit(words(shortName(output.name)), output.unit)}}}};
}

function sweepTable(rows) {
  const names = rows.names.filter((n) => n !== 'reason' || rows.values('reason').some((r) => typeof r === 'string' && r));
  const shown = Math.min(rows.rows, 60);
  const cell = (name, row) => { const v = rows.column(name)[row]; return typeof v === 'number' ? (Number.isNaN(v) ? '' : significant(v, 5)) : v; };
  return el('div', {}, dataTable(names.map((n) => withUnit(words(shortName(n)), list(run.columns).find((c) => c.name === n)?.unit ?? '')),
    Array.from({length: shown}, (_, row) => names.map((n) => cell(n, row))), names.map((n) => (ArrayBuffer.isView(rows.column(n)) ? 'r' : 'l')).join('')),
  paragraph(rows.allRows > shown ? `The first ${shown} of ${rows.allRows} rows; all are in rows.csv. An empty cell was not computed.` : 'An empty cell was not computed.', 'note'));
}

function sweepReport() {
  const rows = table('rows');
  if (rows) {
    const {varied, outputs} = sweepColumns(rows);
    if (varied.length && outputs.length) {
      let output = outputs[0];
      const names = outputs.map((o) => words(shortName(o.name)));
      const drawn = new Plot('One point or cell a run; blank where it was not computed.', () => sweepPlot(rows, output, varied), {height: 400});
      section('What comes out', choices('Quantity', names, (name) => {
        output = outputs[names.indexOf(name)];
        if (drawn.shown) drawn.show();
      }), drawn.figure, paragraph(rows.thinning, 'note'));
    }
    section('How the runs ended', dataTable(['outcome', 'runs'], rows.values('outcome').map((o) => [words(o), String(rows.where({outcome: o}).length)]), 'lr'));
    section('Rows', sweepTable(rows));
  }
  runDetails();
}
