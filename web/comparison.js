// The report of several runs side by side, each held against the first.

// Every value in per cent of the first run's, with its interval; a panel a value.
function comparisonPlot(values, names) {
  const shown = values.filter((v) => isNumber(v.runs[0].value) && v.runs[0].value !== 0 && v.runs.filter((r) => isNumber(r.value)).length > 1);
  if (!shown.length) return undefined;
  return plot('Values with their 95 % intervals, in per cent of the first run\u2019s.', () => {
    const traces = names.map((name, i) => {
      const rows = shown.map((v, place) => ({v, place, own: v.runs[i]})).filter(({own}) => isNumber(own.value));
      const relative = (v, x) => 100 * (x / v.runs[0].value - 1);
      const bar = (end) => rows.map(({v, own}) => (Array.isArray(own.ci95) ? Math.abs(relative(v, own.ci95[end]) - relative(v, own.value)) : 0));
      return {type: 'scatter', mode: 'markers', name, x: rows.map(({v, own}) => relative(v, own.value)),
        y: rows.map(({place}) => place + 0.5 * (i / (names.length - 1) - 0.5)), marker: {color: colour(['one', 'two', 'three', 'four'][i % 4]), size: 9},
        error_x: {type: 'data', symmetric: false, array: bar(1), arrayminus: bar(0), color: colour(['one', 'two', 'three', 'four'][i % 4]), thickness: 2, width: 6},
        customdata: rows.map(({v, own}) => quantity(own.value, v.unit)), hovertemplate: `%{customdata} (%{x:+.2f} %)<extra>${name}</extra>`};
    });
    return {traces, layout: {xaxis: {title: {text: `off ${names[0]} [%]`}, zeroline: true},
      yaxis: {tickvals: shown.map((_, i) => i), ticktext: shown.map((v) => v.name), range: [shown.length - 0.5, -0.5]}}};
  }, {height: 150 + 60 * shown.length});
}

function comparedValueRows(values, names) {
  return values.flatMap((v) => {
    const first = v.runs.find((r) => isNumber(r.value));
    const {factor, unit} = readableUnit(first?.value, v.unit);
    return v.runs.map((own, i) => {
      const half = Array.isArray(own.ci95) ? 0.5 * factor * (own.ci95[1] - own.ci95[0]) : undefined;
      const value = !isNumber(own.value) ? 'not fitted' : half ? (own.value * factor).toFixed(decimalsFor(half)) : significant(own.value * factor);
      const range = own.difference_ci95;
      const change = !isNumber(own.difference) ? ''
        : Array.isArray(range) ? (own.difference * factor).toFixed(decimalsFor(0.5 * factor * (range[1] - range[0]))) : significant(own.difference * factor, 3);
      return [i ? '' : v.name, names[i], value, intervalText(own.ci95, factor), unit, change, intervalText(range, factor),
        isNumber(own.z) ? significant(own.z, 2) : '', own.clear ? 'clear' : ''];
    });
  });
}

function comparedCauseText(own) {
  if (!own.found) return own.looked_for ? 'not found' : 'not looked for';
  const parts = list(own.parameters).map((p) => `${p.name} ${quantity(p.value, p.unit, 3)}`);
  const share = own.share_of_misfit ?? own.share;
  if (isNumber(share)) parts.push(`${percent(share, 2)} of the misfit`);
  if (isNumber(own.probability)) parts.push(`probability ${significant(own.probability, 2)}`);
  return parts.join(', ');
}

function comparisonReport() {
  const names = list(run.runs).map((r) => r.name);
  const common = list(run.runs).slice(1).some((r) => !r.other_recordings_than_first);
  section('Runs', dataTable(['', 'run', 'of', 'law', 'verdict'], list(run.runs).map((r, i) =>
    [String(i + 1), r.name, `${r.command} of ${r.dataset}`, words(r.law), words(r.verdict ?? r.status)]), 'rllll'));
  section('Values', comparisonPlot(list(run.values), names),
    dataTable(['', 'run', 'value', '95 % interval', 'unit', 'change', '95 %', 'z', ''], comparedValueRows(list(run.values), names), 'llrllrlrl'),
    paragraph('A change is clear where all values of a run together would show such a one by chance in less than one comparison of twenty (Holm). Its interval joins those of both runs, between trials where a model misses more than the noise.', 'note'),
    common ? paragraph('Runs on the same recordings share their errors: their differences have no interval and no z.', 'note') : undefined);
  section('Errors', dataTable(['', ...names], list(run.errors).map((e) => {
    const scale = errorScale(e.unit);
    return [`${e.what}${e.channel ? `, ${splitUnit(e.channel).name}` : ''}`, ...e.values.map((v) => (isNumber(v) ? `${significant(v * scale.factor, 3)} ${scale.unit}`.trim() : notComputed))];
  }), `l${'r'.repeat(names.length)}`));
  if (list(run.causes).length)
    section('Causes', dataTable(['', ...names], run.causes.map((c) => [words(c.name), ...c.runs.map(comparedCauseText)]), 'l'));
  section('Set otherwise', list(run.changed).length
    ? dataTable(['', ...names], run.changed.map((c) => [words(c.key), ...c.values.map(settingText)]), 'l')
    : paragraph('Nothing: the runs differ in their recordings alone.'));
  runDetails();
}
