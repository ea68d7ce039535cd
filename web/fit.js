// The report of a fit.

// Mean error of each hop: trials down, hops across, a panel a channel.
function hopErrorPlot(hops) {
  const channels = hops.values('channel');
  const trials = hops.values('trial');
  const most = Math.max(...hops.column('hop')) + 1;
  return plot('Root-mean-square error hop by hop; a hop ends at the apex.', () => {
    const domains = panelDomains(channels.length, narrow.matches ? 0.12 : 0.04);
    const layout = {margin: {l: 56, r: 12, t: 34, b: 44}, annotations: []};
    const traces = channels.map((channel, i) => {
      const {name, unit} = splitUnit(channel);
      const {factor, unit: shown} = errorScale(unit);
      const z = trials.map(() => Array(most).fill(null));
      for (const row of hops.where({channel}))
        z[trials.indexOf(hops.column('trial')[row])][hops.column('hop')[row]] = factor * hops.column('rmse')[row];
      const k = i ? String(i + 1) : '';
      layout[`xaxis${k}`] = {domain: domains[i].x, title: {text: 'hop'}, tickvals: [...Array(most).keys()], ticktext: [...Array(most).keys()].map((h) => h + 1), anchor: `y${k}`};
      layout[`yaxis${k}`] = {domain: domains[i].y, autorange: 'reversed', showticklabels: i === 0 || narrow.matches, anchor: `x${k}`};
      layout.annotations.push({text: withUnit(name, shown), xref: 'paper', yref: 'paper', x: domains[i].x[0], xanchor: 'left', y: domains[i].y[1], yanchor: 'bottom', showarrow: false});
      return {type: 'heatmap', x: [...Array(most).keys()], y: trials, z, xaxis: `x${k}`, yaxis: `y${k}`, colorscale: sequential(), showscale: false, zmin: 0,
        xgap: 2, ygap: 2, texttemplate: '%{z:.3g}', hovertemplate: `%{y}, hop %{x}<br>${name} %{z:.3g} ${shown}<extra></extra>`};
    });
    return {traces, layout, height: (110 + 28 * Math.max(3, trials.length)) * (narrow.matches ? channels.length : 1)};
  }, {height: 110 + 28 * Math.max(3, trials.length)});
}

function errorTable(before, after) {
  const channels = Object.keys(before?.rmse ?? {});
  const cell = (errors, channel) => {
    const {unit} = splitUnit(channel);
    const scale = errorScale(unit);
    const value = errors?.rmse?.[channel];
    return isNumber(value) ? `${significant(value * scale.factor, 3)} ${scale.unit}` : notComputed;
  };
  return {channels, cell};
}

function describeTrial(trial) {
  const found = list(run.trials).find((t) => t.file === trial);
  if (!found) return trial;
  const errors = entries(found.rmse).map(([channel, value]) => {
    const {name, unit} = splitUnit(channel);
    const scale = errorScale(unit);
    return `${name} ${isNumber(value) ? `${significant(value * scale.factor, 3)} ${scale.unit}` : notComputed}`;
  });
  return `${found.role === 'test' ? 'Held out' : 'Fitted'}; ${found.outcome === 'completed' ? '' : `the simulation ${words(found.outcome)}; `}rms error ${errors.join(', ')}.`;
}

function weakDirections(identifiability) {
  const weak = list(identifiability?.weak_directions);
  if (!weak.length) return undefined;
  return dataTable(['eigenvalue', 'direction'], weak.map((d) => [significant(d.eigenvalue, 3),
    entries(d.loadings).filter(([, v]) => Math.abs(v) >= 0.1).map(([n, v]) => `${v > 0 ? '+' : '−'}${Math.abs(v).toFixed(2)} ${n}`).join(' ')]), 'rl', 'Weakly determined combinations');
}

function fitReport() {
  const parameters = list(run.parameters);
  const residuals = table('residuals');
  if (residuals) {
    const motion = table('trajectories');
    section('Measured and simulated', ...traceView({
      residuals, models: [{column: 'simulated', name: 'simulated', kind: 'one'}],
      start: worstTrial(residuals.values('trial')), describe: describeTrial,
      caption: 'Each channel with its residual below it, simulated minus measured.',
      runsOf: (trial) => (motion && run.mechanism ? [{label: '', kind: 'after', mechanism: run.mechanism, motion: motionOf(motion, motion.where({trial}))}] : []),
    }));
  }
  section('Fitted values', run.sentences?.misfit ? paragraph(`The fit as a whole: ${run.sentences.misfit}.`) : undefined,
    parameterTable(parameters, run.misfit), intervalPlot(parameters, run.misfit),
    el('h3', {}, 'What the data determine'),
    paragraph(run.sentences?.determined ? `Determined: ${run.sentences.determined}.` : `Identifiability: ${notComputed}.`),
    weakDirections(run.identifiability), correlationPlot(run.correlation), ...profilePlots(run.profiles, parameters),
    explained(run.law, 'confidence-interval', 'between-trials', 'misfit', 'identifiability', 'condition-number', 'weak-direction', 'profile'));
  formulaPart();
  const {channels, cell} = errorTable(run.test ?? run.train);
  const errorRows = [['fitted trials', run.train], ['held-out trials', run.test]].map(([name, errors]) =>
    [name, String(errors?.trials ?? notComputed), ...channels.map((c) => cell(errors, c)), significant(errors?.nll_per_sample, 4)]);
  section('Errors', dataTable(['', 'trials', ...channels.map((c) => splitUnit(c).name), 'negative log-likelihood a sample'], errorRows, 'lr' + 'r'.repeat(channels.length + 1)),
    table('hops') ? hopErrorPlot(table('hops')) : undefined, explained('rmse', 'held-out', 'likelihood'));
  runDetails(gradientPart(run.gradient_check, run.sentences?.gradients), startsPart());
}
