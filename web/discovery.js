// The report of a search for a formula.

// A found term over its first variable, with its 95 % band.
function discoveredPlot(found) {
  const curves = table('discovered');
  const rows = curves ? curves.where({file: found.file}) : [];
  if (!rows.length) return undefined;
  const pick = (column) => curves.pick(column, rows);
  const unit = {body_force_x: 'N', body_force_y: 'N', body_force_along: 'N', body_force_across: 'N', chord_force: 'N', hip_torque: 'N m',
    landing_velocity_along: 'm/s', landing_velocity_across: 'm/s', touchdown_angle: 'rad', reading_x: 'm', reading_y: 'm', restitution: '-'}[found.acts_as];
  const free = list(found.free?.points).filter((p) => isNumber(p.value) && isNumber(p.at) && isNumber(p.band95));
  // A hat that the data hardly see would hide the curve.
  const span = Math.max(...pick('high').map(Math.abs), ...pick('low').map(Math.abs), ...pick('value').map(Math.abs));
  const seen = free.filter((p) => p.band95 < 2 * span);
  const caption = seen.length
    ? 'What it adds, over its variable, with its 95 % band; the points are what acts there free of any formula.'
    : 'What it adds, over its variable; other variables at their natural sizes. The band is 95 %.';
  return plot(caption, () => ({
    traces: [
      {mode: 'lines', x: pick('at'), y: pick('low'), line: {width: 0}, hoverinfo: 'skip', showlegend: false},
      {mode: 'lines', x: pick('at'), y: pick('high'), fill: 'tonexty', line: {width: 0}, hoverinfo: 'skip', showlegend: false},
      ...(seen.length ? [{mode: 'markers', name: 'free of any formula', x: seen.map((p) => p.at), y: seen.map((p) => p.value), marker: {color: colour('two'), size: 7},
        error_y: {type: 'data', array: seen.map((p) => p.band95), color: colour('two'), thickness: 1.5}, hovertemplate: `%{x:.4g}: %{y:.4g} ${unit}<extra>free</extra>`}] : []),
      {mode: 'lines', name: words(found.acts_as), x: pick('at'), y: pick('value'), line: {color: colour('one')}, hovertemplate: `%{x:.4g}: %{y:.4g} ${unit}<extra></extra>`}],
    layout: {xaxis: {title: {text: pick('variable')[0]}}, yaxis: {title: {text: `${words(found.acts_as)} [${unit}]`}, zeroline: true}, showlegend: false},
  }), {height: 260});
}

function exponentText(e) {
  if (!e || !isNumber(e.value)) return undefined;
  const ci = list(e.ci95);
  return `${significant(e.taken, 2)}; freed ${significant(e.value, 3)}${ci.length ? `, 95 %: ${significant(ci[0], 3)} to ${significant(ci[1], 3)}` : ''}`;
}

function discoveryReport() {
  const found = list(run.discovered);
  section('What was found', paragraph(run.reason ? `${run.reason.replace(/^./, (c) => c.toUpperCase())}.` : ''),
    found.map((f) => [
      el('h3', {}, f.words.replace(/^./, (c) => c.toUpperCase())), typeset(f.mathml),
      definitionList([['sizes', f.sizes], ['exponent', exponentText(f.exponent)],
        ['explains', `${shareText(f.share)} of the misfit beyond noise`],
        ['picked in', isNumber(f.selected_in) ? `${significant(100 * f.selected_in, 3)} % of the resamples of the trials` : undefined],
        ['physics', f.physics], ['file', el('code', {}, f.file)]].filter(([, value]) => value !== undefined)),
      discoveredPlot(f)]));
  const alternatives = list(run.alternatives);
  if (alternatives.length) {
    section('What does as well', dataTable(['in place of', 'acts on', 'formula', 'why'],
      alternatives.map((a) => [a.in_place_of, words(a.acts_as), a.formula, a.why])));
  }
  const residuals = table('residuals');
  if (residuals) {
    const trials = residuals.values('trial');
    const extended = found.length > 0;
    section(extended ? 'Before and after' : 'Measured and simulated',
      extended ? heldOutTable(run.test_before, run.test_after) : undefined,
      ...traceView({residuals, start: trials[0], describe: () => '',
        models: [{column: 'before', name: extended ? 'simulated before' : 'simulated', kind: extended ? 'two' : 'one', model: 'before'},
          ...(extended ? [{column: 'after', name: 'simulated after', kind: 'one', model: 'after'}] : [])],
        caption: 'Each channel with its residual below it, simulated minus measured.', runsOf: () => []}));
  }
  if (found.length) section('Where along a trial it speaks', evidencePlot());
  // A found formula is drawn with its own free curve: forces each alone would tell another story.
  if (run.verdict !== 'found') forcesPart();
  runDetails();
}
