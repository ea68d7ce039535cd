// Measured against simulated, trial by trial: one panel a channel, one below it for the residuals.

// A run's stretches in one mode and its events, from the table of events.
function segmentsOf(events, rows, begin, end) {
  const times = events.pick('time_s', rows);
  const after = events.pick('mode_after', rows);
  const before = events.pick('mode_before', rows);
  const kinds = events.pick('event', rows);
  const segments = [];
  let from = begin;
  times.forEach((time, i) => {
    segments.push({mode: before[i], begin: from, end: time});
    from = time;
  });
  if (times.length) segments.push({mode: after[after.length - 1], begin: from, end});
  return {segments, marks: times.map((time, i) => ({time, kind: kinds[i]})).filter((e) => e.kind !== 'apex')};
}

// The file of a trial and what it is for.
const roleOf = (trial) => list(run.trials).find((t) => t.file === trial)?.role;

// models: [{column, name, kind, model}], `model` naming the rows of the events to show.
function tracePanels(residuals, trial, models) {
  const channels = residuals.values('channel').filter((c) => residuals.where({trial, channel: c}).length);
  const events = table('events');
  const lead = models[models.length - 1];
  const eventRows = events ? events.where({trial, ...(lead.model ? {model: lead.model} : {})}) : [];
  const gap = channels.length > 4 ? 0.14 / channels.length : 0.035;
  const share = (1 - gap * (2 * channels.length - 1)) / channels.length;
  const traces = [];
  const layout = {margin: {l: 64, r: 12, t: 12, b: 44}, legend: {y: 1.0, itemsizing: 'constant'}, shapes: [], annotations: []};
  let top = 1;
  let begin = Infinity;
  let end = -Infinity;
  channels.forEach((channel, i) => {
    const rows = residuals.where({trial, channel});
    const time = residuals.pick('time_s', rows);
    const measured = residuals.pick('measured', rows);
    const {name, unit} = splitUnit(channel);
    const error = errorScale(unit);
    const sigma = residuals.has('sigma') ? residuals.pick('sigma', rows)[0]
      : list(run.channels).find((c) => c.name === channel)?.sigma;
    begin = Math.min(begin, time[0]);
    end = Math.max(end, time[time.length - 1]);
    const [main, below] = [2 * i + 1, 2 * i + 2];
    const axis = (k) => (k === 1 ? '' : String(k));
    layout[`yaxis${axis(main)}`] = {domain: [top - 0.64 * share, top], title: {text: withUnit(name, unit)}};
    top -= 0.64 * share + gap;
    layout[`yaxis${axis(below)}`] = {domain: [Math.max(0, top - 0.36 * share), top], title: {text: channels.length > 4 ? error.unit : withUnit('error', error.unit)}, zeroline: true};
    top -= 0.36 * share + gap;
    traces.push({
      x: time, y: measured, yaxis: `y${axis(main)}`, mode: 'markers', name: 'measured', showlegend: i === 0,
      legendgroup: 'measured', marker: {size: 3, color: colour('ink'), opacity: 0.45},
      hovertemplate: `%{x:.4f} s<br>${name} %{y:.5g} ${unit}<extra>measured</extra>`,
    });
    for (const model of models) {
      const simulated = residuals.pick(model.column, rows);
      if (!simulated.some(isNumber)) continue;
      traces.push({
        x: time, y: simulated, yaxis: `y${axis(main)}`, mode: 'lines', name: model.name, showlegend: i === 0,
        legendgroup: model.name, line: {color: colour(model.kind), width: 2, dash: model.dash ?? 'solid'},
        hovertemplate: `%{x:.4f} s<br>${name} %{y:.5g} ${unit}<extra>${model.name}</extra>`,
      });
      traces.push({
        x: time, y: simulated.map((v, k) => error.factor * (v - measured[k])), yaxis: `y${axis(below)}`, mode: 'markers',
        showlegend: false, legendgroup: model.name, marker: {size: 3, color: colour(model.kind)},
        hovertemplate: `%{x:.4f} s<br>error %{y:.3g} ${error.unit}<extra>${model.name}</extra>`,
      });
    }
    if (isNumber(sigma)) {
      layout.shapes.push({
        type: 'rect', layer: 'below', xref: 'paper', yref: `y${axis(below)}`, x0: 0, x1: 1,
        y0: -1.96 * sigma * error.factor, y1: 1.96 * sigma * error.factor, line: {width: 0}, fillcolor: colour('band'),
      });
    }
  });
  layout.xaxis = {title: {text: 'time [s]'}, anchor: `y${2 * channels.length}`, range: [begin, end]};
  if (eventRows.length) {
    const {segments, marks} = segmentsOf(events, eventRows, begin, end);
    layout.shapes.push(...modeBands(segments, marks));
  }
  return {traces, layout, height: channels.length > 4 ? 100 + 200 * channels.length : Math.min(900, 130 + 210 * channels.length)};
}

const traceLegend = () => el('p', {class: 'legend'}, swatch('band-rolling', 'rolling or stance (simulated)'),
  swatch('band-toe', 'on the toe'), swatch('mark-event', 'touch-down, lift-off, change of stance'), swatch('band-noise', '95 % of the noise'));

// The trial to look at first: the held-out one the model misses most.
function worstTrial(trials, of = list(run.trials)) {
  const misses = (t) => (isNumber(t.chi2) && t.samples ? t.chi2 / t.samples : -1);
  const candidates = of.filter((t) => trials.includes(t.file));
  const held = candidates.filter((t) => t.role === 'test');
  return (held.length ? held : candidates).sort((a, b) => misses(b) - misses(a))[0]?.file ?? trials[0];
}

// A section's worth: a choice of trial, the panels, the animation of that trial.
// runsOf(trial) gives the runs to animate.
function traceView({residuals, models, start, describe, caption, runsOf}) {
  const trials = residuals.values('trial');
  let trial = start;
  const panels = new Plot(caption, () => tracePanels(residuals, trial, models), {height: 550});
  const said = el('p', {class: 'said'});
  const stage = el('div', {class: 'stage-place'});
  const first = runsOf(start)[0];
  const gait = first?.mechanism.type === 'robot' ? gaitDiagram(() => runsOf(trial)[0]) : undefined;
  const choose = (chosen) => {
    trial = chosen;
    said.textContent = describe(trial);
    const runs = runsOf(trial).filter((r) => r.motion.time.length > 1);
    stage.replaceChildren(...(runs.length ? [animationOf(runs), animationLegend(runs.length > 1), paragraph(animationNote, 'note')] : []));
    for (const drawn of [panels, gait]) if (drawn?.shown) drawn.show();
  };
  const choice = choices('Trial', trials, choose, start);
  return [choice, said, panels.figure, traceLegend(), paragraph(residuals.thinning, 'note'), stage, gait?.figure];
}
