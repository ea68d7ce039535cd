// The report of a gait.

function settlingPlot(apexes, steady) {
  return plot('Forward speed at the apexes of the scenario\'s own run; the band is 1 % about the steady hop.', () => ({
    traces: [{x: apexes.map((_, i) => i + 1), y: apexes.map((a) => a.vx_m_per_s), mode: 'lines+markers', line: {color: colour('one')}, customdata: apexes.map((a) => a.time_s),
      hovertemplate: 'apex %{x}, %{customdata:.3f} s: %{y:.5g} m/s<extra></extra>'}],
    layout: {xaxis: {title: {text: 'apex'}}, yaxis: {title: {text: 'speed [m/s]'}}, showlegend: false,
      shapes: isNumber(steady) ? [{type: 'rect', layer: 'below', xref: 'paper', x0: 0, x1: 1, y0: 0.99 * steady, y1: 1.01 * steady, line: {width: 0}, fillcolor: colour('band')}] : []},
  }), {height: 300});
}

// What 1 % more of each parameter does to the spectral radius.
function sensitivityPlot(rates, parameters) {
  const shown = entries(rates).map(([name, rate]) => ({name, value: parameters?.[name], change: 0.01 * rate * parameters?.[name]}))
    .filter((r) => isNumber(r.change) && r.change !== 0).sort((a, b) => Math.abs(a.change) - Math.abs(b.change));
  if (!shown.length) return undefined;
  return plot('What 1 % more of each parameter does to the spectral radius; less is faster.', () => ({
    traces: [{type: 'bar', orientation: 'h', y: shown.map((r) => r.name), x: shown.map((r) => r.change), marker: {color: shown.map((r) => colour(r.change < 0 ? 'one' : 'two'))},
      customdata: shown.map((r) => significant(r.value, 4)), hovertemplate: '%{y} = %{customdata} (SI): %{x:+.4g} per hop<extra></extra>'}],
    layout: {xaxis: {title: {text: 'change of the spectral radius'}, zeroline: true}, bargap: 0.3},
  }), {height: 110 + 24 * shown.length});
}

function branchPlots() {
  const branch = table('branch');
  if (!branch) return undefined;
  const name = branch.names[0];
  const x = [...branch.column(name)];
  const bifurcations = list(run.branch?.bifurcations);
  const line = (column, label, unit, more = {}) => plot(more.caption, () => ({
    traces: [{x, y: [...branch.column(column)], mode: 'lines', line: {color: colour('one'), width: 2}, hovertemplate: `${name} = %{x:.4g} (SI): %{y:.5g} ${unit}<extra></extra>`}],
    layout: {xaxis: {title: {text: `${name} [SI]`}}, yaxis: {title: {text: withUnit(label, unit)}}, showlegend: false,
      shapes: [...(more.limit ? [{type: 'line', xref: 'paper', x0: 0, x1: 1, y0: 1, y1: 1, line: {color: colour('soft'), dash: 'dash', width: 1}}] : []),
        ...bifurcations.map((b) => ({type: 'line', yref: 'paper', y0: 0, y1: 1, x0: b.parameter, x1: b.parameter, line: {color: colour('two'), dash: 'dot'}}))]},
  }), {height: 260});
  const states = run.stride !== undefined
    ? [line('speed_m_per_s', 'speed', 'm/s', {caption: 'Mean speed of the stride.'}), line('pitch_rad', 'pitch', 'rad', {caption: 'Pitch at the section.'})]
    : [line('vx_m_per_s', 'speed', 'm/s', {caption: 'Speed at the apex.'}), line('y_m', 'height', 'm', {caption: 'Height of the apex.'})];
  return section(`Along ${name}`, line('spectral_radius', 'spectral radius', '', {limit: true, caption: 'Stable below 1.'}), ...states,
    bifurcations.length ? dataTable([name, 'what happens'], bifurcations.map((b) => [significant(b.parameter, 5), words(b.kind)]), 'rl') : undefined);
}

// A robot's stride: what it does, when its legs stand, how its neighbours behave.
function strideTable(stride) {
  return dataTable(['', ''], [['kind', words(stride.kind)], ['speed', quantity(stride.speed_m_per_s, 'm/s')], ['stride', `${quantity(run.advance_m, 'm')} in ${quantity(run.period_s, 's')}`],
    ['all legs in the air', percent(stride.flight_share, 2)], ['cost of transport', significant(stride.cost_of_transport, 3)], ['greatest torque of a motor', quantity(stride.peak_torque_N_m, 'N m', 3)],
    ...list(stride.legs).map((leg, i) => [`leg ${i + 1}`, `on the ground ${percent(leg.duty, 2)} of the stride, the middle at ${percent(leg.middle, 2)}`]),
    ['spectral radius', `${significant(run.spectral_radius, 5)}, ${run.stable ? 'stable' : 'unstable'}`]], 'll');
}

// Pitch against its rate, over the way there and the steady stride.
function pitchPhasePlot(own, cycles) {
  const curve = (name, kind, trajectory, faint) => {
    const rows = trajectory.where({});
    const [time, pitch] = ['time_s', 'body_pitch_rad'].map((column) => trajectory.pick(column, rows));
    const rate = pitch.map((_, i) => (i > 0 && i + 1 < pitch.length ? (pitch[i + 1] - pitch[i - 1]) / (time[i + 1] - time[i - 1]) : null));
    return {x: pitch, y: rate, mode: 'lines', name, line: {color: colour(kind), width: faint ? 1 : 2.5}, opacity: faint ? 0.7 : 1,
      hovertemplate: `pitch %{x:.4g} rad, %{y:.4g} rad/s<extra>${name}</extra>`};
  };
  return plot('Pitch and its rate: a steady stride is a closed curve.', () => ({
    traces: [...(own ? [curve('from the scenario\'s start', 'soft', own, true)] : []), curve('steady stride', 'one', cycles, false)],
    layout: {xaxis: {title: {text: 'pitch [rad], nose up'}}, yaxis: {title: {text: 'pitch rate [rad/s]'}, zeroline: true}, showlegend: Boolean(own)},
  }), {height: 380});
}

function strideReport() {
  const cycles = table('cycles');
  const own = table('trajectory');
  if (run.stride && cycles) {
    section('The steady stride', strideTable(run.stride),
      multiplierPlot([{name: 'multipliers', kind: 'one', values: list(run.multipliers)}], 'Multipliers of the return map: inside the unit circle a disturbance dies out, the nearer to 0 the sooner.'),
      pitchPhasePlot(own, cycles),
      phasePlot([{name: 'steady stride', kind: 'one', trajectory: cycles, rows: cycles.where({})}], 'Height against vertical speed of the body.'),
      explained('fixed-point', 'return-map', 'floquet-multiplier', 'spectral-radius'));
  }
  const moving = cycles ?? own;
  if (moving && run.mechanism) {
    const motion = cycles ? repeated(motionOf(cycles, cycles.where({})), 3) : motionOf(own, own.where({}));
    const shown = {label: '', kind: 'after', mechanism: run.mechanism, motion};
    section('In motion', animationOf([shown]), animationLegend(), paragraph(animationNote, 'note'), gaitDiagram(() => shown).figure);
  }
  const effects = sensitivityPlot(run.d_spectral_radius, {...run.mechanism?.parameters, ...run.clock});
  if (effects) section('What changes its stability', effects);
  branchPlots();
  runDetails();
}

function gaitReport() {
  if (run.stride !== undefined) {
    strideReport();
    return;
  }
  const cycles = table('cycles');
  const own = table('trajectory');
  const fixed = run.fixed_point;
  if (isNumber(fixed?.vx_m_per_s)) {
    section('The steady hop', gaitTable([['steady hop', {...fixed, period_s: run.period_s, spectral_radius: run.spectral_radius, stable: run.stable, events: run.events}]]),
      multiplierPlot([{name: 'multipliers', kind: 'one', values: list(run.multipliers)}], 'Multipliers of the return map: inside the unit circle a disturbance dies out, the nearer to 0 the sooner.'),
      cycles ? phasePlot([...(own ? [{name: 'from the scenario\'s start', kind: 'soft', trajectory: own, rows: own.where({}), faint: true}] : []),
        {name: 'steady hop', kind: 'one', trajectory: cycles, rows: cycles.where({})}], 'The limit cycle, and the way to it.') : undefined,
      explained('fixed-point', 'return-map', 'floquet-multiplier', 'spectral-radius'));
  }
  const moving = cycles ?? own;
  if (moving && run.mechanism) {
    section('In motion', animationOf([{label: '', kind: 'after', mechanism: run.mechanism, motion: cycles ? repeated(motionOf(cycles, cycles.where({})), 3) : motionOf(own, own.where({}))}]), animationLegend(), paragraph(animationNote, 'note'));
  }
  const apexes = list(run.apex_speeds);
  const effects = sensitivityPlot(run.d_spectral_radius, run.mechanism?.parameters);
  if (apexes.length > 1 || effects) {
    section('How fast it settles', paragraph(isNumber(run.counted?.hops) ? `In the scenario's own run the speed stays within ${run.counted.band_percent} % from apex ${run.counted.hops} on, after ${quantity(run.counted.time_s, 's')}.` : 'The scenario\'s own run does not settle, or does not reach its end.'),
      apexes.length > 1 ? settlingPlot(apexes, fixed?.vx_m_per_s) : undefined, effects, explained('convergence-time'));
  }
  branchPlots();
  runDetails();
}
