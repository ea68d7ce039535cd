// The parts a page is built of.

function el(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined) continue;
    if (name in element && typeof value !== 'string') element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== undefined && child !== null && child !== ''));
  return element;
}

const paragraph = (text, kind) => (text ? el('p', kind ? {class: kind} : {}, text) : undefined);

// A part of the report, with its line in the contents.
function section(title, ...children) {
  const id = title.toLowerCase().replace(/[^a-z0-9]+/g, '-');
  document.getElementById('contents').append(el('a', {href: `#${id}`}, title));
  const part = el('section', {id}, el('h2', {}, title), ...children);
  document.getElementById('report').append(part);
  return part;
}

// Closed until asked for, open in print.
function details(summary, ...children) {
  return el('details', {}, el('summary', {}, summary), ...children);
}

// rows of texts or elements; numeric columns are set right by `align`, as 'lrr'.
function dataTable(header, rows, align = '', caption) {
  const kind = (column) => (align[column] === 'r' ? 'right' : undefined);
  const line = (cells, tag) => el('tr', {}, cells.map((cell, i) =>
    el(tag, {class: kind(i), scope: tag === 'th' ? 'col' : undefined}, cell ?? '')));
  const body = el('table', {}, caption ? el('caption', {}, caption) : '',
    el('thead', {}, line(header, 'th')), el('tbody', {}, rows.map((row) => line(row, 'td'))));
  return el('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption ?? header.filter(Boolean).join(', ')}, body);
}

function definitionList(pairs) {
  return el('dl', {class: 'settings'}, pairs.map(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]));
}

// One of several choices; calls `choose` with it, at once with the first (or `start`).
function choices(label, names, choose, start = names[0]) {
  if (names.length < 2) {
    choose(start);
    return el('p', {class: 'only-choice'}, `${label}: ${start}`);
  }
  const select = el('select', {}, names.map((name) => el('option', {value: String(name)}, String(name))));
  select.value = String(start);
  select.addEventListener('change', () => choose(names[select.selectedIndex]));
  choose(start);
  return el('label', {class: 'choice'}, label, ' ', select);
}

// A colour and what it stands for, as in a legend.
const swatch = (kind, text) => el('span', {class: 'swatch'}, el('i', {class: kind}), text);

// A formula as the program typeset it; nothing else is taken for one.
function typeset(mathml) {
  if (typeof mathml !== 'string' || !mathml.startsWith('<math ')) return undefined;
  const parsed = new DOMParser().parseFromString(mathml, 'text/html').querySelector('math');
  return parsed ? el('div', {class: 'formula'}, document.importNode(parsed, true)) : undefined;
}

// Effects that were given, or found, as formulas.
function formulaPart() {
  const formulas = list(run.formulas);
  if (!formulas.length) return undefined;
  return section('Formulas', formulas.map((f) => [
    el('h3', {}, words(f.name)), paragraph(`${f.sentence.replace(/^./, (c) => c.toUpperCase())}.`), typeset(f.mathml),
    definitionList([['acts on', `${words(f.acts_as)} [${f.unit}]`], ['as written', el('code', {}, f.formula)]]),
  ]));
}
