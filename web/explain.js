// What the words of a report mean, in the sentences of `hoplab explain`.

const explanations = JSON.parse(document.getElementById('explanations').textContent);

// Folded: two paragraphs on each of these, of those the page knows.
function explained(...names) {
  const known = [...new Set(names.filter((name) => explanations[name]))];
  if (!known.length) return undefined;
  const spoken = known.map((name) => (explanations[name].kind === 'word' ? name.replaceAll('-', ' ') : name));
  return el('details', {class: 'words'}, el('summary', {}, `In words: ${spoken.join(', ')}`),
    el('dl', {}, known.map((name, i) => [el('dt', {}, spoken[i]),
      el('dd', {}, paragraph(explanations[name].what), paragraph(explanations[name].meaning))])));
}

// The judgement on a cause, without the words that say that it is one.
const judgement = (status) => explanations[status.replaceAll('_', '-')].what.replace(/^[^:]*: /, '').replace(/\.(\s.*)?$/s, '');
