// A gait as dynamics: its closed curve, its multipliers.

// multipliers: [{name, kind, values: [[re, im], ...]}].
function multiplierPlot(sets, caption) {
  return plot(caption, () => {
    const circle = Array.from({length: 121}, (_, i) => (2 * Math.PI * i) / 120);
    return {
      traces: [
        {x: circle.map(Math.cos), y: circle.map(Math.sin), mode: 'lines', line: {color: colour('soft'), width: 1}, hoverinfo: 'skip', showlegend: false},
        ...sets.filter((s) => list(s.values).length).map((s) => ({
          x: s.values.map((m) => m[0]), y: s.values.map((m) => m[1]), mode: 'markers', name: s.name, marker: {color: colour(s.kind), size: 12, symbol: s.symbol ?? 'circle', line: {width: 1, color: colour('paper')}},
          customdata: s.values.map((m) => Math.hypot(m[0], m[1])),
          hovertemplate: `%{x:.5f} + %{y:.5f} i<br>modulus %{customdata:.5f} per hop<extra>${s.name}</extra>`})),
      ],
      layout: {xaxis: {title: {text: 'real part'}, zeroline: true, constrain: 'domain'}, yaxis: {title: {text: 'imaginary part'}, scaleanchor: 'x', zeroline: true}, showlegend: sets.length > 1},
    };
  }, {height: 360});
}

// Height against vertical speed: curves [{name, kind, trajectory, rows, faint}].
function phasePlot(curves, caption) {
  return plot(caption, () => ({
    traces: curves.map((c) => ({
      x: c.trajectory.pick('body_vy_m_per_s', c.rows), y: c.trajectory.pick('body_y_m', c.rows), mode: 'lines', name: c.name,
      line: {color: colour(c.kind), width: c.faint ? 1 : 2.5}, opacity: c.faint ? 0.7 : 1,
      hovertemplate: `hip %{y:.4g} m, %{x:.4g} m/s upward<extra>${c.name}</extra>`})),
    layout: {xaxis: {title: {text: 'vertical speed [m/s]'}, zeroline: true}, yaxis: {title: {text: 'hip height [m]'}}, showlegend: curves.length > 1},
  }), {height: 380});
}

const gaitRow = (name, gait) => (gait
  ? [name, quantity(gait.vx_m_per_s, 'm/s'), quantity(gait.y_m, 'm'), quantity(gait.period_s, 's'), significant(gait.spectral_radius, 5),
    gait.stable ? 'stable' : 'unstable', gait.events]
  : [name, notComputed, '', '', '', 'no steady hop found', '']);

const gaitTable = (rows) => dataTable(run.mechanism?.type === 'robot' ? ['', 'speed', 'height at the section', 'period', 'spectral radius', '', 'events of a stride']
  : ['', 'speed at apex', 'apex height', 'period', 'spectral radius', '', 'events of a hop'], rows.map(([name, gait]) => gaitRow(name, gait)), 'lrrrrll');
