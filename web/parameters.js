// Fitted values: the table, the intervals side by side, the correlations, profiles.

function parameterRows(parameters, misfit) {
  return parameters.map((p) => {
    const at = p.determined === false ? p.initial : p.value;
    const {factor, unit} = readableUnit(at, p.unit);
    const wide = misfit ? p.ci95_between_trials : undefined;
    const narrow = Array.isArray(p.ci95) ? p.ci95 : undefined;
    const counted = wide ?? narrow;
    const decimals = counted ? decimalsFor(0.5 * (counted[1] - counted[0]) * factor) : undefined;
    const value = !isNumber(p.value) ? 'not determined'
      : decimals === undefined || Math.abs(p.value * factor) < 1e-3 ? significant(p.value * factor) : (p.value * factor).toFixed(decimals);
    return [p.name, value, unit, intervalText(p.ci95, factor) || 'none',
      misfit ? intervalText(p.ci95_between_trials, factor) || 'none' : undefined,
      significant(p.initial * factor), p.at_bound ? 'at a bound' : ''].filter((cell) => cell !== undefined);
  });
}

function parameterTable(parameters, misfit) {
  const header = ['parameter', 'value', 'unit', '95 % interval', ...(misfit ? ['95 % between trials'] : []), 'start', ''];
  return dataTable(header, parameterRows(parameters, misfit), misfit ? 'lrlrrrl' : 'lrlrrl', 'Fitted values');
}

// Intervals of all parameters on one axis: per cent of the fitted value.
function intervalPlot(parameters, misfit) {
  const shown = parameters.filter((p) => isNumber(p.value) && p.value !== 0 && Array.isArray(p.ci95));
  if (!shown.length) return undefined;
  const relative = (p, v) => 100 * (v / p.value - 1);
  const bars = (key, name, kind, size, offset) => {
    const with_ = shown.filter((p) => Array.isArray(p[key]));
    return {
      type: 'scatter', mode: 'markers', name, x: with_.map(() => 0), y: with_.map((p) => shown.indexOf(p) + offset),
      marker: {color: colour(kind), size},
      error_x: {type: 'data', symmetric: false, color: colour(kind), thickness: 2, width: 6,
        array: with_.map((p) => Math.abs(relative(p, p[key][1]))), arrayminus: with_.map((p) => Math.abs(relative(p, p[key][0])))},
      customdata: with_.map((p) => `${quantity(p[key][0], p.unit)} to ${quantity(p[key][1], p.unit)}`),
      hovertemplate: `%{customdata}<extra>${name}</extra>`,
    };
  };
  return plot('95 % intervals, in per cent of the fitted value.', () => ({
    traces: [bars('ci95', 'from the noise alone', 'one', 8, misfit ? 0.12 : 0),
      ...(misfit ? [bars('ci95_between_trials', 'between trials', 'two', 6, -0.12)] : [])],
    layout: {xaxis: {title: {text: 'off the fitted value [%]'}, zeroline: true},
      yaxis: {tickvals: shown.map((_, i) => i), ticktext: shown.map((p) => p.name), range: [shown.length - 0.4, -0.6]}},
  }), {height: 120 + 44 * shown.length});
}

function correlationPlot(correlation) {
  const names = Object.keys(correlation ?? {});
  if (names.length < 2) return undefined;
  if (names.length === 2) return paragraph(`${names[0]} and ${names[1]} are correlated by ${significant(correlation[names[0]][names[1]], 2)}.`);
  const z = names.map((row) => names.map((column) => correlation[row][column]));
  return plot('Correlation of the fitted values: near ±1 the data see only a combination of two.', () => ({
    traces: [{type: 'heatmap', x: names, y: names, z, zmin: -1, zmax: 1, colorscale: diverging(), xgap: 2, ygap: 2,
      texttemplate: '%{z:.2f}', hovertemplate: '%{y} and %{x}: %{z:.3f}<extra></extra>', colorbar: {thickness: 12, title: {text: ''}}}],
    layout: {yaxis: {autorange: 'reversed'}, xaxis: {side: 'bottom'}},
  }), {height: 120 + Math.max(140, 34 * names.length)});
}

function profilePlots(profiles, parameters) {
  return list(profiles).filter((p) => list(p.points).length).map((profile) => {
    const p = parameters.find((q) => q.name === profile.name) ?? {unit: ''};
    const {factor, unit} = readableUnit(p.value, p.unit);
    const x = profile.points.map((q) => q.value * factor);
    return plot(`Profile of ${profile.name}: everything else refitted at each value. 95 %: ${intervalText(profile.ci95, factor) || 'open'} ${unit}.`, () => ({
      traces: [{x, y: profile.points.map((q) => q.delta_chi2), mode: 'lines+markers', line: {color: colour('one'), shape: 'spline'}, name: profile.name,
        hovertemplate: `%{x:.6g} ${unit}<br>chi² rises by %{y:.3g}<extra></extra>`}],
      layout: {xaxis: {title: {text: withUnit(profile.name, unit)}}, yaxis: {title: {text: 'rise of chi²'}, rangemode: 'tozero'}, showlegend: false,
        shapes: [{type: 'line', xref: 'paper', x0: 0, x1: 1, y0: 3.841, y1: 3.841, line: {color: colour('soft'), dash: 'dash', width: 1}}],
        annotations: [{xref: 'paper', x: 1, y: 3.841, xanchor: 'right', yanchor: 'bottom', text: '95 %', showarrow: false, font: {color: colour('soft')}}]},
    }), {height: 280});
  });
}
