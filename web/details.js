// What every report ends with: how the run was set up, and how its derivatives were checked.

function settingText(value) {
  if (value === null || value === undefined) return 'none';
  if (Array.isArray(value)) return value.length ? value.map(settingText).join(', ') : 'none';
  if (typeof value === 'object') {
    const parts = Object.entries(value).map(([name, v]) => `${name} = ${settingText(v)}`);
    return parts.length ? parts.join(', ') : 'none';
  }
  if (isNumber(value)) return String(Number(value.toPrecision(12)));
  return String(value);
}

const settingRows = (object) => entries(object).map(([name, value]) => [words(name), settingText(value)]);

function gradientPart(check, sentence) {
  if (!check || !isNumber(check.max_relative_error)) return paragraph('Gradient certificate: not computed.');
  const columns = list(check.columns);
  const flags = list(check.flags);
  return el('div', {}, paragraph(`Gradient certificate: ${sentence ?? `the worst of ${plural(columns.length, 'column')} is off by ${check.max_relative_error.toExponential(1)} (${check.worst_parameter})`}.`),
    flags.length ? dataTable(['trial', 'flag'], flags.map((f) => [f.trial, f.text])) : undefined,
    columns.length ? details('Every derivative', dataTable(['by', 'trial', 'relative difference'],
      columns.map((c) => [c.name, c.trial, isNumber(c.relative_error) ? c.relative_error.toExponential(1) : notComputed]), 'llr')) : undefined, explained('gradient-certificate', 'sensitivity', 'grazing'));
}

function startsPart() {
  const starts = list(run.starts);
  if (!starts.length) return undefined;
  return details(`${starts.length} ${starts.length === 1 ? 'search' : 'searches'}`, dataTable(['', 'ended', 'cost', 'iterations', 'at'],
    starts.slice(0, 200).map((s, i) => [i === run.best_start ? 'best' : '', words(s.status), significant(s.cost, 6), s.iterations, settingText(s.to)]), 'llrrl'));
}

function runDetails(...more) {
  const options = run.options ?? {};
  const versions = [['hoplab', run.version], ...entries(run.tools)];
  const remarks = [...(run.command === 'check' ? [] : list(run.warnings)), ...list(run.notes), ...list(run.sentences?.remarks)];
  section('Details',
    remarks.length ? el('div', {class: 'remarks'}, el('h3', {}, 'Remarks'), el('ul', {}, remarks.map((r) => el('li', {}, r)))) : undefined,
    ...more,
    el('h3', {}, 'Settings'), definitionList([
      ...(run.law && !options.law ? [['law', words(run.law)]] : []), ...(isNumber(run.seed) && options.seed === undefined ? [['seed', String(run.seed)]] : []),
      ...settingRows(run.options), ['computed in', quantity(run.seconds, 's', 3)]]),
    el('h3', {}, 'Versions'), definitionList(versions),
    tables.size ? el('h3', {}, 'Tables behind the plots') : undefined,
    tables.size ? definitionList([...tables].map(([name, t]) => [`${name}.csv`, `${plural(t.allRows, 'row')}: ${t.names.join(', ')}`])) : undefined,
    paragraph('The exact numbers stand in run.json and these tables, in SI units, beside this page.', 'note'));
}
