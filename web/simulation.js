// The report of a single simulation.

function channelPlot(trajectory, events, channel) {
  const {name, unit} = splitUnit(channel);
  const y = [...trajectory.column(channel)];
  const time = [...trajectory.column('time_s')];
  return {
    traces: [{x: time, y, mode: 'lines', line: {color: colour('one'), width: 1.5}, hovertemplate: `%{x:.4f} s: %{y:.5g} ${unit}<extra>${words(name)}</extra>`}],
    layout: {xaxis: {title: {text: 'time [s]'}}, yaxis: {title: {text: withUnit(words(name), unit)}}, showlegend: false,
      shapes: (() => {
        const rows = events?.where({}) ?? [];
        if (!rows.length || rows.length > 400) return [];
        const {segments, marks} = segmentsOf(events, rows, time[0], time[time.length - 1]);
        return modeBands(segments, rows.length < 40 ? marks : []);
      })()},
  };
}

function simulationReport() {
  const trajectory = table('trajectory');
  const events = table('events');
  if (trajectory?.rows > 1) {
    const channels = trajectory.names.filter((n) => !['time_s', 'mode', 'contact', 'contact_y_m'].includes(n) && !/^(contact_\d|leg_contact_)/.test(n) && [...trajectory.column(n)].some(isNumber));
    const labels = channels.map((c) => words(splitUnit(c).name));
    let channel = channels.includes('body_y_m') ? 'body_y_m' : channels[0];
    if (run.mechanism) {
      const shown = {label: '', kind: 'after', mechanism: run.mechanism, motion: motionOf(trajectory, trajectory.where({}))};
      section('In motion', animationOf([shown]), animationLegend(), paragraph(animationNote, 'note'),
        run.mechanism.type === 'robot' ? gaitDiagram(() => shown).figure : undefined);
    }
    const drawn = new Plot('Drag to zoom, double-click to see everything again.', () => channelPlot(trajectory, events, channel), {height: 340});
    section('Over time', choices('Quantity', labels, (label) => {
      channel = channels[labels.indexOf(label)];
      if (drawn.shown) drawn.show();
    }, labels[channels.indexOf(channel)]), drawn.figure, traceLegend(), paragraph(trajectory.thinning, 'note'));
    section('As dynamics', phasePlot([{name: 'run', kind: 'one', trajectory, rows: trajectory.where({}), faint: true}], 'Hip height against vertical speed.'));
  }
  const energies = list(run.apex_energies);
  if (energies.length > 1) {
    section('Energy', plot('Total energy at the start and at each apex.', () => ({
      traces: [{x: energies.map((e) => e.time_s), y: energies.map((e) => e.energy_J), mode: 'lines+markers', line: {color: colour('one')}, hovertemplate: '%{x:.4f} s: %{y:.6g} J<extra></extra>'}],
      layout: {xaxis: {title: {text: 'time [s]'}}, yaxis: {title: {text: 'energy [J]'}}, showlegend: false}}), {height: 260}));
  }
  const sensitivities = entries(run.sensitivities);
  if (sensitivities.length) {
    const names = Object.keys(sensitivities[0][1].final_state ?? {});
    section('Derivatives of the end', dataTable(['by', ...names], sensitivities.map(([by, s]) => [by, ...names.map((n) => (isNumber(s.final_state[n]) ? s.final_state[n].toExponential(5) : notComputed))]), 'l' + 'r'.repeat(names.length)));
  }
  runDetails(events?.rows ? details(`${plural(events.allRows, 'event')}`, dataTable(['time [s]', 'event', 'to', 'x [m]', 'y [m]', 'vx [m/s]', 'vy [m/s]'],
    events.where({}).slice(0, 300).map((r) => [events.column('time_s')[r].toFixed(4), words(events.column('event')[r]), events.column('mode_after')[r],
      ...['x_m', 'y_m', 'vx_after_m_per_s', 'vy_after_m_per_s'].map((n) => significant(events.column(n)[r]))]), 'rllrrrr')) : undefined);
}
