// Builds the report of whatever command the run was.

const reports = {
  check: checkReport, fit: fitReport, diagnose: diagnosisReport, discover: discoveryReport, gait: gaitReport, optimize: optimizeReport,
  sweep: sweepReport, simulate: simulationReport, reproduce: reproductionReport, design: designReport,
  report: comparisonReport,
};

// Draws every plot; the page says when all of them stand, and in which colours.
// A drawing that is overtaken by another stops.
let drawings = 0;
async function drawAll() {
  const drawing = ++drawings;
  const scheme = darkScheme.matches ? 'dark' : 'light';
  delete document.body.dataset.ready;
  for (const each of plots) {
    await each.show();
    await nextFrame();
    if (drawing !== drawings) return;
  }
  document.body.dataset.scheme = scheme;
  document.body.dataset.ready = 'yes';
}

async function start() {
  (reports[run.command] ?? runDetails)();
  for (const query of [darkScheme, narrow]) query.addEventListener('change', drawAll);
  const folded = () => [...document.querySelectorAll('details:not([open])')];
  let opened = [];
  addEventListener('beforeprint', () => {
    opened = folded().filter((d) => !d.closest('footer, .words')); // these are not printed
    for (const d of opened) d.open = true;
    document.documentElement.dataset.print = 'yes'; // dark colours do not go on paper
    for (const each of plots) each.show(); // at once: printing does not wait
  });
  addEventListener('afterprint', () => {
    for (const d of opened) d.open = false;
    delete document.documentElement.dataset.print;
    drawAll();
  });
  await drawAll();
}

start().catch((error) => {
  document.getElementById('report').prepend(paragraph(`This page could not be drawn in full: ${error.message}`, 'note'));
  throw error;
});
