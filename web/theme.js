// Colours of plots and drawings: those of the style sheet, so that light, dark and print agree.

const style = () => getComputedStyle(document.documentElement);
const colour = (name) => style().getPropertyValue(`--${name}`).trim();

const darkScheme = matchMedia('(prefers-color-scheme: dark)');
// Without a pointer that hovers, a plot's tools would always lie on its legend.
const hovers = matchMedia('(hover: hover)');
const narrow = matchMedia('(max-width: 600px)');

const modeColours = {rolling: 'rolling', toe: 'toe', stance: 'rolling', flight: 'flight'};

// Sequential and diverging scales that read in black and white and with any colour vision.
const sequential = () => [[0, colour('paper')], [0.35, colour('heat-1')], [0.7, colour('heat-2')], [1, colour('heat-3')]];
// For what is to be small: blank cells stay apart from the palest colour.
const downward = () => [[0, colour('heat-3')], [0.4, colour('heat-2')], [1, colour('heat-1')]];
const upward = () => [[0, colour('heat-1')], [0.6, colour('heat-2')], [1, colour('heat-3')]];
const diverging = () => [[0, colour('one')], [0.5, colour('paper')], [1, colour('two')]];

function baseLayout() {
  const axis = {
    gridcolor: colour('line'), linecolor: colour('line'), zerolinecolor: colour('line'),
    tickcolor: colour('line'), automargin: true, title: {standoff: 8}, exponentformat: 'power', ticks: 'outside', ticklen: 4,
  };
  return {
    paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)',
    font: {family: style().fontFamily, size: 13, color: colour('ink')},
    margin: {l: 56, r: 12, t: 12, b: 44}, autosize: true,
    colorway: ['one', 'two', 'three', 'four'].map(colour),
    hoverlabel: {bgcolor: colour('paper'), bordercolor: colour('soft'), font: {color: colour('ink'), size: 13}},
    modebar: {bgcolor: colour('paper'), color: colour('soft'), activecolor: colour('ink')},
    legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom', bgcolor: 'rgba(0,0,0,0)'},
    xaxis: axis, yaxis: axis, hovermode: 'closest', dragmode: 'zoom',
  };
}

// `more` over `base`, object by object.
function merged(base, more) {
  const out = {...base};
  for (const [key, value] of Object.entries(more)) {
    const nested = value && typeof value === 'object' && !Array.isArray(value);
    out[key] = nested ? merged(base[key] && typeof base[key] === 'object' ? base[key] : {}, value) : value;
  }
  return out;
}
