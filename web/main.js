// Builds the report of whatever command the run was.

const reports = {
  fit: fitReport, diagnose: diagnosisReport, gait: gaitReport, optimize: optimizeReport,
  sweep: sweepReport, simulate: simulationReport, reproduce: reproductionReport,
};

// Draws every plot; the page says when all of them stand, and in which colours.
async function drawAll() {
  delete document.body.dataset.ready;
  await showPlots();
  document.body.dataset.scheme = darkScheme.matches ? 'dark' : 'light';
  document.body.dataset.ready = 'yes';
}

async function start() {
  (reports[run.command] ?? runDetails)();
  for (const query of [darkScheme, narrow]) query.addEventListener('change', drawAll);
  const folded = () => [...document.querySelectorAll('details:not([open])')];
  let opened = [];
  addEventListener('beforeprint', () => {
    opened = folded().filter((d) => !d.closest('footer'));
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
