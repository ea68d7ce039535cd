// The report of a diagnosis.

const statusKinds = {supported: 'one', indistinguishable: 'three', excluded: 'two', not_needed: 'two', not_tested: 'soft'};
const statusSymbols = {supported: 'circle', indistinguishable: 'diamond', excluded: 'x-thin-open', not_needed: 'line-ew-open', not_tested: 'circle-open'};

// A run of an older program knows one trial or all.
const trialsOf = (c) => c.only_in_trials ?? (c.only_in_trial ? [c.only_in_trial] : []);
const whereText = (c) => (trialsOf(c).length ? `${c.effect} (${trialsOf(c).join(', ')} only)` : c.effect);
const causeText = (c) => (c.each_trial ? `${c.effect} of each trial's own size` : whereText(c));

// Sizes of a candidate's parameters, from the table of candidates: [{parameter, unit, typical, ...}].
function sizesOf(candidate) {
  const t = table('candidates');
  if (!t) return [];
  return t.where({effect: candidate.effect}).filter((row) => t.column('only_in_trial')[row] === trialsOf(candidate).join('+')
    || (!trialsOf(candidate).length && !t.values('only_in_trial').some((v) => typeof v === 'string' && v))).map((row) => Object.fromEntries(t.names.map((name) => [name, t.column(name)[row]])));
}

function sizeText(candidate) {
  return sizesOf(candidate).map((s) => {
    if (candidate.status === 'excluded' && isNumber(s.bound95)) return `${s.parameter} beyond ${quantity(s.bound95, s.unit, 2)}`;
    if (candidate.status === 'not_tested') return `${s.parameter} typically ${quantity(s.typical, s.unit, 2)}`;
    return isNumber(s.refit_value) ? `${s.parameter} = ${quantity(s.refit_value, s.unit, 3)}` : `${s.parameter} ${notComputed}`;
  }).join('; ');
}

function ladderPlot(candidates) {
  const shown = candidates.filter((c) => isNumber(c.gain_nats) && c.gain_nats > 0);
  const leastShown = 0.1; // smaller gains stand at the edge
  if (!shown.length) return undefined;
  return plot('Log-likelihood each cause gains when it is added alone and everything is refitted [nats]. Beyond the dashed line a gain pays for the choice among so many causes.', () => {
    const traces = Object.keys(statusKinds).map((status) => {
      const of = shown.filter((c) => c.status === status);
      return {mode: 'markers', name: words(status), y: of.map(causeText), x: of.map((c) => Math.max(c.gain_nats, leastShown)),
        marker: {color: colour(statusKinds[status]), size: status === 'supported' ? 12 : 9, symbol: statusSymbols[status]}, customdata: of.map((c) => [significant(c.gain_nats, 4), sizeText(c)]),
        hovertemplate: `%{y}: %{customdata[0]} nats<br>%{customdata[1]}<extra>${words(status)}</extra>`};
    }).filter((t) => t.y.length);
    const penalty = run.penalty_nats;
    return {traces, layout: {
      xaxis: {type: 'log', dtick: 1, title: {text: 'gain [nats], logarithmic'}},
      yaxis: {categoryorder: 'array', categoryarray: shown.map(causeText).reverse(), tickfont: {size: 12}, range: [-0.8, shown.length - 0.2], showticklabels: !narrow.matches}, legend: {traceorder: 'normal'},
      // In a narrow window the names stand above their marks.
      annotations: narrow.matches ? shown.map((c) => ({xref: 'paper', x: 0, xanchor: 'left', y: causeText(c), yanchor: 'bottom', text: causeText(c), showarrow: false, font: {size: 11}})) : [],
      shapes: isNumber(penalty) ? [{type: 'line', yref: 'paper', y0: 0, y1: 1, x0: penalty, x1: penalty, line: {color: colour('ink'), dash: 'dash', width: 1}}] : [],
    }, height: 120 + (narrow.matches ? 34 : 20) * shown.length};
  }, {height: 120 + 20 * shown.length});
}

// Share as it stands in the report on the terminal: never rounded up.
const shareText = (share) => {
  const percent = 100 * Math.min(Math.max(share, 0), 1);
  return percent > 0 && percent < 0.1 ? 'under 0.1 %' : `${percent < 10 ? percent.toFixed(1) : Math.floor(percent)} %`;
};

// A size in each trial: its mean and spread, and what such sizes are worth.
function variesText(v) {
  const interval = Array.isArray(v.ci95) ? ` (95 % ${v.ci95.map((x) => quantity(x, v.unit, 2)).join(' .. ')})` : '';
  const text = `${v.name}: mean ${quantity(v.mean, v.unit, 3)}${interval}, spread ${quantity(v.spread, v.unit, 2)}`;
  const w = v.with_sizes;
  if (!w) return v.refitted === false ? `${text}, to first order.` : `${text}.`;
  const errors = Object.keys(w.held_out_rmse).filter((ch) => isNumber(w.held_out_rmse[ch]) && isNumber(w.held_out_rmse_one_size[ch]))
    .map((ch) => `${splitUnit(ch).name} ${quantity(w.held_out_rmse_one_size[ch], splitUnit(ch).unit, 3)} → ${quantity(w.held_out_rmse[ch], splitUnit(ch).unit, 3)}`);
  return `${text}. With these sizes the causes explain ${shareText(w.explained)} of the misfit instead of ${shareText(w.explained_one_size)}${errors.length ? `, held-out ${errors.join(', ')}` : ''} (${significant(w.evidence_nats, 2)} nats).`;
}

// Of a cause of each trial's own size: the mean of the sizes and how far they spread.
function sizeOf(cause, p) {
  const own = cause.each_trial ? list(cause.varies).find((v) => v.name === p.name && isNumber(v.spread)) : undefined;
  return `${p.name} = ${quantity(p.value, p.unit, 3)}${own ? ` on average, spread ${quantity(own.spread, p.unit, 2)}` : ''}`;
}

// Of the misfit; runs of before 2026-11-25 have the share of what all causes explain alone.
const shareOf = (c) => shareText(c.share_of_misfit ?? c.share);
const chance = (p) => (isNumber(p) ? p.toFixed(2) : notComputed);

const valuesText = (parameters) => parameters.map((p) => `${parameters.length > 1 ? `${p.name} ` : ''}${quantity(p.value, p.unit, 3)}`).join(', ');
const unconfirmedText = (c) => `${causeText({...c, effect: c.name})} (${shareOf(c)}; ${valuesText(c.parameters)} by the first parts, ${valuesText(c.parameters_by_whole_trials)} by the whole trials)`;

// The extension taken apart: what each cause explains, how likely the name is, and the held-out error without it.
function causesPart(causes, extension) {
  const setAside = list(run.set_aside);
  const unconfirmed = setAside.filter((c) => list(c.parameters_by_whole_trials).length);
  const leftOut = setAside.filter((c) => !unconfirmed.includes(c));
  if (!causes.length && !setAside.length) return undefined;
  const whyLeftOut = run.shows_late_alone ? 'but are seen late alone, as a model’s own error is' : 'but most likely do not act';
  const channels = Object.keys(causes[0]?.held_out_rmse_without ?? {});
  const unit = (c) => splitUnit(c).unit;
  const row = (c) => [causeText({...c, effect: c.name}), c.parameters.map((p) => sizeOf(c, p)).join('; '),
    shareOf(c), chance(c.probability),
    ...channels.map((ch) => (isNumber(c.held_out_rmse_without[ch]) ? quantity(c.held_out_rmse_without[ch], unit(ch), 3) : notComputed))];
  const heads = ['size', 'explains', 'P', ...channels.map((ch) => `without it, ${splitUnit(ch).name}`)];
  const [main, small] = [causes.filter((c) => c.main), causes.filter((c) => !c.main && !c.stands_in)];
  const doubted = (cs) => cs.map((c) => `${causeText({...c, effect: c.name})} (${shareOf(c)}, P ${chance(c.probability_group ?? c.probability)})`).join(', ');
  const needed = causes.filter((c) => c.stands_in);
  const align = `llrr${'r'.repeat(channels.length)}`;
  const left = Object.entries(run.left ?? {}).filter(([, l]) => isNumber(l?.amplitude) && l.amplitude > 0);
  const asked = causes.map((c) => c.name);
  return section(main.length ? 'The causes' : causes.length ? 'Small corrections' : 'Set aside',
    main.length ? dataTable(['main cause', ...heads], main.map(row), align, 'What each cause explains, and the held-out errors without it') : undefined,
    small.length ? details('Small corrections the data also want, which may stand for details of the model', dataTable(['cause', ...heads], small.map(row), align)) : undefined,
    needed.length ? paragraph(`The model needs them, but most likely in place of something not listed: ${doubted(needed)}.`) : undefined,
    leftOut.length ? paragraph(`Left out: they would explain ${causes.length ? 'a little more' : 'some'}, ${whyLeftOut}: ${doubted(leftOut)}.`) : undefined,
    unconfirmed.length ? paragraph(`Left out, since the whole trials know ${unconfirmed.length === 1 ? 'it' : 'them'} in another size: ${unconfirmed.map(unconfirmedText).join(', ')}. What acts keeps its size; what stands in for an error of the model does not.`) : undefined,
    ...causes.flatMap((c) => list(c.varies).filter((v) => v.told ?? true).map((v) => details(`${causeText({...c, effect: c.name})}: in every trial, differently`,
      paragraph(variesText(v)),
      dataTable(['trial', v.name], v.trials.map((t) => [t.trial, quantity(t.value, v.unit, 3)]), 'lr')))),
    otherModelsPart(extension),
    causes.length ? paragraph(`Probability that the cause is outside the catalogue: ${chance(run.probability_unlisted)}.`) : undefined,
    left.length && extension ? paragraph(`What is left is a smooth error of ${left.map(([ch, l]) => `${splitUnit(ch).name} ${quantity(l.amplitude, unit(ch), 3)} over ${quantity(l.time_scale_s, 's', 2)}`).join(', ')}: ${shareText(run.left_share ?? 0)} of the misfit.`) : undefined,
    explained(...asked, 'share', 'probability', 'main-cause', 'discrepancy'));
}

// Models that are not told and not ruled out: what they are, and what they make of the told model's values.
function otherModelsPart(extension) {
  const others = list(extension?.other_models);
  if (!others.length) return undefined;
  const parameters = list(extension.parameters);
  const moved = (m, p) => (isNumber(m.moves[p.name]) && m.moves[p.name] !== 0 ? quantity(m.moves[p.name], p.unit, 2) : '');
  return details(`Not told and not ruled out: ${others.length} more ${others.length === 1 ? 'model' : 'models'} that the intervals hold, too`,
    paragraph('Each has a cause more, or another in the place of one. Odds against the told model; what lies below a twentieth is ruled out.'),
    dataTable(['with', 'in the place of', 'size', 'odds', ...parameters.map((p) => `${p.name} by`)], others.map((m) => [
      m.cause, m.instead_of ?? '', m.parameters.map((p) => quantity(p.value, p.unit, 2)).join('; '), significant(Math.exp(m.log_odds), 2),
      ...parameters.map((p) => moved(m, p))]), `lllr${'r'.repeat(parameters.length)}`));
}

function ladderTable(candidates) {
  return dataTable(['cause', 'judgement', 'size', 'gain [nats]', 'score', 'on held-out trials [nats a sample]'], candidates.map((c) => [
    causeText(c), el('span', {class: `status ${c.status}`}, words(c.status)), sizeText(c), significant(c.gain_nats, 4),
    significant(c.score, 4), significant(c.refit?.heldout_gain, 3)]), 'lllrrr', 'Every cause that was tried');
}

function localisationPlot(cells) {
  const order = {early: 0, middle: 1, late: 2};
  const modes = [...new Set(cells.map((c) => c.mode))];
  const places = modes.flatMap((mode) => [...new Set(cells.filter((c) => c.mode === mode).map((c) => c.phase))]
    .sort((a, b) => (order[a] ?? 9) - (order[b] ?? 9)).map((phase) => ({mode, phase})));
  const channels = [...new Set(cells.map((c) => c.channel))];
  const find = (place, channel) => cells.find((c) => c.mode === place.mode && c.phase === place.phase && c.channel === channel);
  return plot('Share of the misfit by phase of the motion and channel [%].', () => ({
    traces: [{type: 'heatmap', x: places.map((p) => `${p.mode}<br>${p.phase}`), y: channels.map((c) => splitUnit(c).name),
      z: channels.map((ch) => places.map((p) => (isNumber(find(p, ch)?.share) ? 100 * find(p, ch).share : null))), xgap: 2, ygap: 2,
      customdata: channels.map((ch) => places.map((p) => { const c = find(p, ch); return c ? `chi² ${significant(c.chi2, 4)} over ${c.rows} samples, ${significant(c.expected, 4)} expected` : ''; })),
      colorscale: sequential(), showscale: false, zmin: 0, texttemplate: '%{z:.2g}', hovertemplate: '%{y}, %{x}: %{z:.3g} %<br>%{customdata}<extra></extra>'}],
    layout: {yaxis: {autorange: 'reversed'}},
  }), {height: 130 + 46 * channels.length});
}

function misfitBars(parts, key, caption) {
  const most = 20;
  const shown = parts.filter((p) => isNumber(p.share));
  if (shown.length < 2) return undefined;
  const label = (p) => (key === 'hop' ? `hop ${p.hop + 1}` : p[key]);
  const many = shown.length > 6; // then across, the largest first
  const bars = many ? [...shown].sort((a, b) => b.share - a.share).slice(0, most) : shown;
  const [labels, shares] = [bars.map(label), bars.map((p) => 100 * p.share)];
  const axis = {title: {text: 'share of the misfit [%]'}, rangemode: 'tozero'};
  return plot(shown.length > most ? `${caption} The ${most} largest of ${shown.length}.` : caption, () => ({
    traces: [{type: 'bar', ...(many ? {orientation: 'h', x: shares, y: labels} : {x: labels, y: shares}), marker: {color: colour('one')},
      hovertemplate: many ? '%{y}: %{x:.3g} %<extra></extra>' : '%{x}: %{y:.3g} %<extra></extra>'}],
    layout: many ? {xaxis: axis, yaxis: {autorange: 'reversed'}, bargap: 0.4} : {yaxis: axis, bargap: 0.55},
  }), {height: many ? 90 + 18 * bars.length : 230});
}

function evidencePlot() {
  const evidence = table('evidence');
  if (!evidence?.has('running')) return undefined;
  const trials = evidence.values('trial');
  let trial = trials[0];
  const drawn = new Plot('Running evidence along a trial: where it climbs, the data speak for the cause; where it falls, against it.', () => {
    const labels = evidence.values('effect').flatMap((effect) => [...new Set(evidence.pick('parameter', evidence.where({effect, trial})))].map((parameter) => ({effect, parameter})));
    const kinds = ['one', 'two', 'three', 'four'];
    const traces = labels.map(({effect, parameter}, i) => {
      const rows = evidence.where({effect, parameter, trial});
      return {x: evidence.pick('time_s', rows), y: evidence.pick('running', rows), mode: 'lines', name: `${effect}.${parameter}`,
        line: {color: colour(kinds[i % 4]), width: 2, dash: i < 4 ? 'solid' : 'dash'}, hovertemplate: `%{x:.4f} s: %{y:.4g} of the score<extra>${effect}.${parameter}</extra>`};
    });
    const events = table('events');
    const rows = events ? events.where({trial, model: 'before'}) : [];
    const ends = traces.flatMap((t) => [t.x[0], t.x[t.x.length - 1]]);
    const {segments, marks} = rows.length ? segmentsOf(events, rows, Math.min(...ends), Math.max(...ends)) : {segments: [], marks: []};
    return {traces, layout: {xaxis: {title: {text: 'time [s]'}}, yaxis: {title: {text: 'score gathered'}, zeroline: true}, shapes: modeBands(segments, marks), showlegend: true}};
  }, {height: 320});
  const choice = choices('Trial', trials, (chosen) => {
    trial = chosen;
    if (drawn.shown) drawn.show();
  });
  return el('div', {}, choice, drawn.figure, traceLegend(), paragraph(evidence.thinning, 'note'));
}

function movementPart(movements) {
  if (!movements.length) return undefined;
  const shown = movements.filter((m) => isNumber(m.before) && isNumber(m.after) && m.before !== 0);
  return el('div', {}, dataTable(['parameter', 'before', 'after', 'moved by'], movements.map((m) => [m.name, quantity(m.before, m.unit), quantity(m.after, m.unit),
    isNumber(m.std_errors) ? `${m.std_errors > 0 ? '+' : '−'}${significant(Math.abs(m.std_errors), 3)} standard errors` : notComputed]), 'lrrr'),
  shown.length ? plot('What the missing cause had pushed into the fitted values [% of the value before].', () => ({
    traces: [
      {x: shown.flatMap((m) => [0, 100 * (m.after / m.before - 1), null]), y: shown.flatMap((m) => [m.name, m.name, null]), mode: 'lines', line: {color: colour('soft'), width: 2}, hoverinfo: 'skip', showlegend: false},
      {x: shown.map(() => 0), y: shown.map((m) => m.name), mode: 'markers', name: 'before', marker: {color: colour('two'), size: 11}, customdata: shown.map((m) => quantity(m.before, m.unit)), hovertemplate: '%{y} %{customdata}<extra>before</extra>'},
      {x: shown.map((m) => 100 * (m.after / m.before - 1)), y: shown.map((m) => m.name), mode: 'markers', name: 'after', marker: {color: colour('one'), size: 11}, customdata: shown.map((m) => quantity(m.after, m.unit)), hovertemplate: '%{y} %{customdata}<extra>after</extra>'},
    ],
    layout: {xaxis: {title: {text: 'change [%]'}, zeroline: true}, yaxis: {autorange: 'reversed'}},
  }), {height: 120 + 46 * shown.length}) : undefined);
}

function energyPlot(energy) {
  const hops = list(energy?.hops);
  if (!hops.length) return undefined;
  const labels = hops.map((_, i) => `hop ${i + 1}`);
  const series = [['measured', 'measured', 'ink'], ['before', 'simulated before', 'two'], ['after', 'simulated after', 'one']].filter(([key]) => hops.some((h) => h[key]));
  return plot(`Energy lost per hop of ${energy.trial}, in per cent of the energy at its first apex.`, () => ({
    traces: series.map(([key, name, kind]) => ({type: 'bar', name, x: labels, y: hops.map((h) => (isNumber(h[key]?.loss_share) ? 100 * h[key].loss_share : null)),
      customdata: hops.map((h) => `${quantity(h[key]?.begin_J, 'J')} to ${quantity(h[key]?.end_J, 'J')}`), marker: {color: colour(kind)},
      hovertemplate: `%{x}: %{y:.3g} %<br>%{customdata}<extra>${name}</extra>`})),
    layout: {barmode: 'group', bargap: 0.5, yaxis: {title: {text: 'lost [%]'}, rangemode: 'tozero'}},
  }), {height: 300});
}

function heldOutTable(before, after) {
  const {channels, cell} = errorTable(before);
  const extra = [['apex_height_rmse_m', 'apex height', 'm'], ['apex_time_rmse_s', 'apex time', 's'], ['touchdown_time_rmse_s', 'touch-down time', 's'], ['stance_time_rmse_s', 'stance time', 's']]
    .filter(([key]) => isNumber(before?.[key]) || isNumber(after?.[key]));
  return dataTable(['held-out error', 'before', 'after'], [
    ...channels.map((c) => [splitUnit(c).name, cell(before, c), after ? cell(after, c) : notComputed]),
    ...extra.map(([key, name, unit]) => [name, quantity(before?.[key], unit, 3), quantity(after?.[key], unit, 3)])], 'lrr');
}

function groupPart() {
  const groups = list(run.groups).filter((g) => g.length > 1);
  const proposed = run.separating_experiment;
  const search = run.experiment_search;
  if (!groups.length && !search) return undefined;
  return section('What cannot be told apart',
    ...groups.map((group) => dataTable(['cause', 'behind the best by [nats]', 'with'], group.map((m) => [whereText(m),
      significant(m.nats_behind, 3), list(m.with).join(', ')]), 'lrl', 'Causes that do equally well')),
    el('h3', {}, 'The trial to record next'),
    proposed ? paragraph(`${proposed.description.replace(/^./, (c) => c.toUpperCase())}: expected to set the best apart from ${proposed.closest_rival} by ${significant(proposed.expected_nats, 3)} nats.`)
      : paragraph(search ? `No trial was found that would settle it; the best of ${search.designs_tried} tried, ${search.description}, is expected to bring ${significant(search.expected_nats, 3)} nats.` : 'No trial was looked for.'),
    explained('indistinguishable', 'separating-experiment'));
}

function forcePlot(force, points) {
  const p = isNumber(force.p_value) ? `, p = ${significant(force.p_value, 2)}` : '';
  return plot(`${force.name.replace(/^./, (c) => c.toUpperCase())}${p}.`, () => ({
    traces: [{x: points.map((q) => q.at), y: points.map((q) => q.value), mode: 'lines+markers', line: {color: colour('one')},
      error_y: {type: 'data', array: points.map((q) => q.band95), color: colour('one'), thickness: 1.5},
      hovertemplate: `%{x:.4g}: %{y:.4g} ${force.unit}<extra>${force.name}</extra>`}],
    layout: {xaxis: {title: {text: force.against ?? ''}}, yaxis: {title: {text: `[${force.unit}]`}, zeroline: true}, showlegend: false},
  }), {height: 230});
}

function forcesPart() {
  const forces = list(run.free_forces).map((f) => ({...f, seen: list(f.points).filter((p) => isNumber(p.value))})).filter((f) => f.seen.length);
  if (!forces.length) return undefined;
  const curves = forces.filter((f) => f.seen.filter((p) => isNumber(p.at)).length > 1);
  const single = forces.filter((f) => !curves.includes(f));
  return section('What the missing part looks like', paragraph('Free forces, impulses and offsets, fitted to what the model leaves; the bands are 95 %.'),
    el('div', {class: 'pair'}, curves.slice(0, 8).map((f) => forcePlot(f, f.seen.filter((p) => isNumber(p.at))))),
    single.length ? dataTable(['', 'value', '95 %', 'p'], single.map((f) => [f.name, quantity(f.seen[0].value, f.unit, 3), `± ${quantity(f.seen[0].band95, f.unit, 2)}`, significant(f.p_value, 2)]), 'lrrr') : undefined,
    explained('free-force'));
}

function diagnosisReport() {
  const residuals = table('residuals');
  const extension = run.extension;
  const candidates = [...list(run.candidates)].sort((a, b) => (b.gain_nats ?? -Infinity) - (a.gain_nats ?? -Infinity));
  if (residuals) {
    const trials = residuals.values('trial');
    const roles = new Map(trials.map((t) => [t, residuals.pick('role', residuals.where({trial: t}))[0]]));
    const start = trials.find((t) => t === run.energy?.trial) ?? trials.find((t) => roles.get(t) === 'test') ?? trials[0];
    const motion = table('trajectories');
    const states = (trial, model) => ({mechanism: run.mechanism, motion: motionOf(motion, motion.where({trial, model}))});
    const models = [{column: 'before', name: extension ? 'simulated before' : 'simulated', kind: extension ? 'two' : 'one', model: 'before'},
      ...(extension ? [{column: 'after', name: 'simulated after', kind: 'one', model: 'after'}] : [])];
    section(extension ? 'Before and after' : 'Measured and simulated',
      extension ? heldOutTable(extension.test_before, extension.test_after) : undefined, explained('held-out', 'rmse', 'residual'),
      ...traceView({residuals, models, start,
        describe: (trial) => `${roles.get(trial) === 'test' ? 'Held out' : 'Fitted'}${extension ? `; after: with ${list(run.effects).join(', ')}` : ''}.`,
        caption: 'Each channel with its residual below it, simulated minus measured.',
        runsOf: (trial) => (motion && run.mechanism ? [...(extension ? [{label: 'after', kind: 'after', ...states(trial, 'after')}] : []),
          {label: extension ? 'before' : '', kind: extension ? 'before' : 'after', ...states(trial, 'before')}] : []),
      }));
  }
  causesPart(list(run.causes), extension);
  if (candidates.length) {
    const count = (status) => candidates.filter((c) => c.status === status).length;
    section('The evidence', paragraph(`${candidates.length} causes were tried: ${Object.keys(statusKinds).filter(count).map((s) => `${count(s)} ${words(s)}`).join(', ')}.`),
      ladderPlot(candidates), paragraph(`${Object.keys(statusKinds).filter(count).map((s) => `${words(s)}: ${judgement(s)}`).join('; ')}.`.replace(/^./, (c) => c.toUpperCase()), 'note'), details('Table of all causes', ladderTable(candidates)),
      explained(run.verdict, ...list(run.effects), 'candidate', 'score', 'penalty', 'likelihood'));
  }
  const cells = list(run.localisation);
  if (cells.length) {
    section('Where the misfit sits', localisationPlot(cells),
      el('div', {class: 'pair'}, misfitBars(list(run.misfit_by_hop), 'hop', 'The same by hop.'), misfitBars(list(run.misfit_by_trial), 'trial', 'The same by trial.')), evidencePlot());
  }
  groupPart();
  formulaPart();
  forcesPart();
  if (extension || run.energy) {
    section('What it does to the rest', movementPart(list(extension?.movements)), energyPlot(run.energy), explained('extension', 'standard-error', 'energy-ledger'));
  }
  const fitted = extension ? list(extension.parameters) : list(run.null?.parameters);
  // Where something remains, the noise alone makes the intervals too narrow.
  const apart = (extension ? extension.remainder?.p_value <= 0.01 : run.null?.misfit) && fitted.some((p) => Array.isArray(p.ci95_between_trials));
  if (fitted.length) {
    section(extension ? 'The extended model' : 'The model as it is', parameterTable(fitted, apart), intervalPlot(fitted, apart),
      paragraph(run.sentences?.determined ? `Determined, before: ${run.sentences.determined}.` : ''),
      paragraph(run.whole_trials ? `The whole trials: ${run.whole_trials.sentence}.` : ''),
      paragraph(run.sentences?.remainder ? `The remainder: ${run.sentences.remainder}.` : ''));
  }
  const tests = list(run.detection?.tests);
  runDetails(gradientPart(run.gradient_check, run.sentences?.gradients),
    list(run.gate?.checks).length ? details('What had to hold before a diagnosis', dataTable(['check', '', ''], run.gate.checks.map((c) => [c.name, c.passed ? 'passed' : 'failed', c.text]))) : undefined,
    tests.length ? details('Every test for a misfit', dataTable(['test', 'statistic', 'degrees of freedom', 'p'], tests.map((t) => [t.name, significant(t.statistic, 4), String(t.dof), significant(t.p_value, 2)]), 'lrrr')) : undefined);
}
