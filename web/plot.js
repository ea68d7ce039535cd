// Plots: drawn one after the other, drawn anew when the colours change.

const plots = [];

const exportIcon = {
  width: 24, height: 24,
  path: 'M12 3v10.2l3.6-3.6L17 11l-5 5-5-5 1.4-1.4L11 13.2V3zM5 19h14v2H5z',
};

function plotConfig(name, withImages) {
  const svg = {
    name: 'svg', title: 'Download as SVG', icon: exportIcon,
    click: (div) => withImages.downloadImage(div, {format: 'svg', filename: name}),
  };
  return {
    responsive: true, displaylogo: false, displayModeBar: hovers.matches ? 'hover' : false, doubleClick: 'reset+autosize',
    toImageButtonOptions: {format: 'png', filename: name, scale: 2},
    modeBarButtonsToRemove: ['select2d', 'lasso2d', 'autoScale2d'],
    modeBarButtonsToAdd: [svg],
  };
}

// A plot under its caption. `draw()` gives {traces, layout}; it is called again for other colours.
// Surfaces are drawn by the library's part for three dimensions.
class Plot {
  constructor(caption, draw, {height = 340, surfaces = false} = {}) {
    this.draw = draw;
    this.library = surfaces ? window.Plotly : window.flatPlots;
    this.height = height;
    this.div = el('div', {class: 'plot', role: 'img', 'aria-label': caption});
    this.div.style.minHeight = `${height}px`;
    this.figure = el('figure', {class: 'plotted'}, this.div, el('figcaption', {}, caption));
    plots.push(this);
  }

  async show() {
    const {traces, layout = {}, height = this.height} = this.draw();
    this.div.style.minHeight = `${height}px`;
    const base = baseLayout();
    // Further axes look like the first ones.
    for (const key of Object.keys(layout)) {
      if (/^[xy]axis\d+$/.test(key)) base[key] = key[0] === 'x' ? base.xaxis : base.yaxis;
    }
    const name = `${(run.dataset ?? run.scenario ?? 'run')}-${run.command}`;
    await this.library.react(this.div, traces, merged({...base, height}, layout), plotConfig(name, this.library));
    this.shown = true;
  }
}

function plot(caption, draw, options) { return new Plot(caption, draw, options).figure; }

const nextFrame = () => new Promise((resolve) => { setTimeout(resolve, 0); });

// Where the panels of a plot lie: side by side, in a narrow window one below the other.
function panelDomains(count, gap) {
  const share = (1 - gap * (count - 1)) / count;
  return Array.from({length: count}, (_, i) => {
    const from = i * (share + gap);
    return narrow.matches ? {x: [0, 1], y: [Math.max(0, 1 - from - share), 1 - from]} : {x: [from, from + share], y: [0, 1]};
  });
}

// Bands of the modes and lines of the events of a run, as shapes of a plot.
function modeBands(segments, events) {
  const bands = segments.filter((s) => s.mode !== 'flight').map((s) => ({
    type: 'rect', layer: 'below', xref: 'x', yref: 'paper', x0: s.begin, x1: s.end, y0: 0, y1: 1,
    line: {width: 0}, fillcolor: colour(`${modeColours[s.mode] ?? 'rolling'}-band`),
  }));
  const marks = events.map((e) => ({
    type: 'line', layer: 'below', xref: 'x', yref: 'paper', x0: e.time, x1: e.time, y0: 0, y1: 1,
    line: {width: 1, dash: 'dot', color: colour('soft')},
  }));
  return [...bands, ...marks];
}
