// The report of a check: what a dataset can tell before anything is fitted.

function checkReport() {
  const warnings = list(run.warnings);
  if (warnings.length) section('Warnings', el('ul', {}, warnings.map((w) => el('li', {}, w))));
  section('What the data can determine', paragraph('At the nominal values, from the noise alone.'),
    dataTable(['parameter', 'nominal', 'standard error', 'relative'], list(run.parameters).map((p) => [p.name, quantity(p.initial, p.unit), quantity(p.std_error_at_initial, p.unit, 2),
      isNumber(p.std_error_at_initial) && p.initial ? percent(p.std_error_at_initial / p.initial, 2) : notComputed]), 'lrrr'), weakDirections(run.identifiability), explained('identifiability', 'standard-error', 'condition-number', 'weak-direction'));
  section('Trials', dataTable(['trial', 'for', 'rows', 'samples', 'seconds', 'hops seen', 'hops simulated', 'simulation'], list(run.trials).map((t) => [t.file, t.role, String(t.rows), String(t.samples),
    brief(t.duration_s), String(t.hops_in_data ?? notComputed), String(t.hops_in_simulation ?? notComputed), words(t.outcome)]), 'llrrrrrl'));
  section('Noise', dataTable(['channel', 'stated', 'in the traces'], list(run.noise).map((n) => {
    const {name, unit} = splitUnit(n.channel);
    return [name, isNumber(n.sigma_stated) ? quantity(n.sigma_stated, unit, 3) : 'estimated', quantity(n.sigma_in_traces, unit, 3)];
  }), 'lrr', 'One standard deviation'), explained('sigma'));
  runDetails(gradientPart(run.gradient_check));
}
