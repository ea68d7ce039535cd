// The report of a sweep.

// Columns that are varied (keys of the scenario stand first) and those that come out as numbers.
function sweepColumns(rows) {
  const columns = list(run.columns).filter((c) => ArrayBuffer.isView(rows.column(c.name)));
  const isKey = (c) => (run.keys ? run.keys.includes(c.name) : c.name.includes('.'));
  const varied = columns.filter((c) => isKey(c) && new Set(rows.column(c.name)).size > 1);
  const outputs = columns.filter((c) => !isKey(c) && [...rows.column(c.name)].some(isNumber));
  return {varied, outputs};
}

const shortName = (name) => splitUnit(name.split('.').pop()).name;

// A column in units that read well: {values, title, unit}.
function scaledColumn(rows, column) {
  const raw = [...rows.column(column.name)];
  const most = Math.max(...raw.filter(isNumber).map(Math.abs));
  const {factor, unit} = readableUnit(most, column.unit);
  return {values: raw.map((v) => v * factor), title: {text: withUnit(words(shortName(column.name)), unit)}, unit};
}

const distinct = (values) => [...new Set(values)].sort((a, b) => a - b);

// A line for each value of the second key, where it has few.
function sweepLines(x, z, second, ended) {
  const kinds = ['one', 'two', 'three', 'four', 'soft', 'ink'];
  const groups = second ? distinct(second.values) : [undefined];
  return groups.map((value, i) => {
    const rows = x.values.map((_, row) => row).filter((row) => !second || second.values[row] === value).sort((a, b) => x.values[a] - x.values[b]);
    const name = second ? `${second.title.text.replace(/ \[.*/, '')} = ${brief(value)} ${second.unit}${rows.some((r) => isNumber(z.values[r])) ? '' : ` (${notComputed})`}` : '';
    return {x: rows.map((r) => x.values[r]), y: rows.map((r) => z.values[r]), customdata: rows.map((r) => ended[r]), mode: 'lines+markers', name, line: {color: colour(kinds[i % 6])},
      hovertemplate: `%{x:.5g} ${x.unit}: %{y:.5g} ${z.unit}<br>%{customdata}<extra>${name}</extra>`};
  });
}

function sweepPlot(rows, output, varied) {
  const keys = [...varied].sort((a, b) => new Set(rows.column(b.name)).size - new Set(rows.column(a.name)).size);
  const [x, y] = keys.map((key) => scaledColumn(rows, key));
  const z = scaledColumn(rows, output);
  const ended = rows.has('outcome') ? rows.column('outcome').map(words) : [];
  const layout = {xaxis: {title: x.title}, yaxis: {title: y?.title}};
  if (keys.length === 1 || (keys.length === 2 && distinct(y.values).length <= 6))
    return {traces: sweepLines(x, z, y, ended), layout: {...layout, yaxis: {title: z.title}, showlegend: Boolean(y)}};
  const [xs, ys] = [distinct(x.values), distinct(y.values)];
  const hover = `%{x:.5g} ${x.unit}, %{y:.5g} ${y.unit}<br>`;
  const bar = {thickness: 12, title: {text: z.unit}};
  if (xs.length * ys.length <= 1.5 * rows.rows) { // a grid; of further keys the last row counts
    const grid = ys.map(() => Array(xs.length).fill(null));
    const said = ys.map(() => Array(xs.length).fill(''));
    x.values.forEach((v, i) => {
      const [r, c] = [ys.indexOf(y.values[i]), xs.indexOf(v)];
      grid[r][c] = isNumber(z.values[i]) ? z.values[i] : null;
      said[r][c] = ended[i] ?? '';
    });
    return {traces: [{type: 'heatmap', x: xs, y: ys, z: grid, customdata: said, colorscale: upward(), hoverongaps: true, colorbar: bar, xgap: 1, ygap: 1,
      hovertemplate: `${hover}%{z:.5g} ${z.unit}<br>%{customdata}<extra></extra>`}], layout};
  }
  return {traces: [{x: x.values, y: y.values, mode: 'markers', marker: {color: z.values, size: 9, colorscale: upward(), showscale: true, line: {color: colour('soft'), width: 1}, colorbar: bar},
    customdata: z.values, hovertemplate: `${hover}%{customdata:.5g} ${z.unit}<extra></extra>`}], layout};
}

function sweepTable(rows) {
  const names = rows.names.filter((n) => n !== 'reason' || rows.values('reason').some((r) => typeof r === 'string' && r));
  const shown = Math.min(rows.rows, 60);
  const columns = names.map((name) => {
    const column = list(run.columns).find((c) => c.name === name) ?? {name, unit: ''};
    if (!ArrayBuffer.isView(rows.column(name))) return {title: words(shortName(name)), cells: rows.column(name).map(words), align: 'l'};
    const {values, title} = scaledColumn(rows, column);
    return {title: title.text, cells: values.map((v) => (isNumber(v) ? brief(v) : '')), align: 'r'};
  });
  return el('div', {}, dataTable(columns.map((c) => c.title), Array.from({length: shown}, (_, row) => columns.map((c) => c.cells[row])), columns.map((c) => c.align).join('')),
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
