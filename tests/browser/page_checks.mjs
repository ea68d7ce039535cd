// What is asked of a page, as functions that run in it.

// Texts whose contrast to what lies behind them is below WCAG's 4.5 (3 for large ones).
export function faintTexts() {
  const channels = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
  const over = (top, under) => {
    const a = top[3] ?? 1;
    return [0, 1, 2].map((i) => top[i] * a + under[i] * (1 - a));
  };
  const behind = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) {
      const colour = channels(getComputedStyle(e).backgroundColor);
      if ((colour[3] ?? 1) > 0) layers.push(colour);
    }
    return layers.reduceRight((under, top) => over(top, under), [255, 255, 255]);
  };
  const luminance = (rgb) => {
    const [r, g, b] = rgb.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const faint = [];
  const walker = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.textContent.trim() || !element.getClientRects().length || element.closest('.heatmap-label, .hoverlayer, .modebar, option, noscript, .gl-container')) continue;
    const style = getComputedStyle(element);
    const isSvg = element.namespaceURI.endsWith('svg');
    const under = behind(element);
    const text = over(channels(isSvg ? style.fill : style.color), under);
    const [a, b] = [luminance(text), luminance(under)].sort((x, y) => y - x);
    const size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.6 && Number(style.fontWeight) >= 600);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < (large ? 3 : 4.5)) faint.push(`${node.textContent.trim().slice(0, 40)}: ${ratio.toFixed(2)}`);
  }
  return faint;
}

// Plots without a single finite number, by their captions.
export function emptyPlots() {
  const numbers = (value) => (value && typeof value === 'object' ? Array.from(value.length === undefined ? [] : value).some((v) => (typeof v === 'object' && v !== null ? numbers(v) : Number.isFinite(v))) : false);
  return [...document.querySelectorAll('.plot')].filter((div) => !(div.data ?? []).some((trace) => ['x', 'y', 'z'].some((k) => numbers(trace[k]))))
    .map((div) => div.getAttribute('aria-label'));
}

// Where on the screen a point of a plot lies, of the `index`-th plot with points or cells.
export function placeToHover(index) {
  const div = [...document.querySelectorAll('.plot')].filter((d) => d.data?.some((t) => t.hovertemplate && t.type !== 'surface'))[index];
  if (!div) return null;
  div.scrollIntoView({block: 'center', behavior: 'instant'});
  // Points that are drawn, cells that have a value: their places in x and y.
  const drawn = (t) => (t.z ? t.z.flatMap((row, i) => Array.from(row).map((v, j) => [j, i, v])).filter(([, , v]) => Number.isFinite(v))
    : Array.from(t.y ?? []).map((v, k) => [k, k, v]).filter(([, , v]) => v !== null && !Number.isNaN(v)));
  const trace = div.data.findLast((t) => t.hovertemplate && drawn(t).length);
  if (!trace) return null;
  const layout = div._fullLayout;
  const axis = (letter) => layout[`${letter}axis${(trace[`${letter}axis`] ?? letter).slice(1)}`];
  const [xs, ys] = [Array.from(trace.x), Array.from(trace.y)];
  const places = drawn(trace);
  const [i, j] = places[Math.floor(places.length / 2)];
  const box = div.getBoundingClientRect();
  const pixel = (a, v) => a._offset + a.d2p(v);
  return {x: box.left + pixel(axis('x'), xs[i]), y: box.top + pixel(axis('y'), ys[j]), caption: div.getAttribute('aria-label')};
}

// The figures of the headline: what they point at and what they show.
export const headlineFigures = () => [...document.querySelectorAll('.figure')].map((figure) => ({
  pointer: figure.dataset.pointer, value: figure.dataset.value,
  number: figure.querySelector('.number').textContent, unit: figure.querySelector('.unit')?.textContent ?? '',
}));
