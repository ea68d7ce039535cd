// Builds the report of whatever command the run was.

const reports = {
  fit: fitReport, diagnose: diagnosisReport, gait: gaitReport, optimize: optimizeReport,
  sweep: sweepReport, simulate: simulationReport, reproduce: reproductionReport,
};

function redraw() {
  for (const each of plots) if (each.shown) each.show();
}

async function start() {
  (reports[run.command] ?? runDetails)();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
  const folded = () => [...document.querySelectorAll('details:not([open])')];
  let opened = [];
  addEventListener('beforeprint', () => {
    opened = folded().filter((d) => !d.closest('footer'));
    for (const d of opened) d.open = true;
    redraw();
  });
  addEventListener('afterprint', () => {
    for (const d of opened) d.open = false;
    redraw();
  });
  await showPlots();
  document.body.dataset.ready = 'yes';
}

start().catch((error) => {
  document.getElementById('report').prepend(paragraph(`This page could not be drawn in full: ${error.message}`, 'note'));
  throw error;
});
