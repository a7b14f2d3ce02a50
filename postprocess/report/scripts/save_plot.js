// Every plot as an SVG file, for papers: what is seen of it (zoomed, without hidden curves) on a sheet of its
// own size, in the colours of paper, with its texts as texts. Made in the page, so it works without a network.
(() => {
  const { study, svg, mark, sample, names, bars, pointsOf, colour, titleOf, onPaper, dressers } = plots;
  const [width, height] = [640, 400];  // of axes and curves; title and legend stand above
  const font = { family: 'Helvetica, Arial, sans-serif', size: 12 };

  const fileName = (title, ending) => [study.case || document.title, title].join(' ').toLowerCase().replace(/−/g, '-')
    .replace(/[^\p{L}\p{N}]+/gu, '-').replace(/^-|-$/g, '').slice(0, 120) + ending;
  const offer = (blob, name) => {
    const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  };
  const button = (text, what, save) => {
    const key = Object.assign(document.createElement('button'), { type: 'button', className: 'save', textContent: text });
    key.setAttribute('aria-label', `${text}: ${what}`);
    key.addEventListener('click', save);
    return key;
  };

  const text = (content, x, y, more = {}) => svg('text', { x, y, fill: colour('soft'), ...more }, content);
  const line = (x1, y1, x2, y2, ink) => svg('line', { x1, y1, x2, y2, stroke: ink });

  // Grid, numbers and name of an axis, and the axis itself.
  const axis = (chart, name) => {
    const scale = chart.scales[name];
    const { left, right, top, bottom } = chart.chartArea;
    const isX = name === 'x';
    const grid = scale.ticks.flatMap((tick, i) => {
      const at = scale.getPixelForTick(i);
      const ink = colour(tick.label === '' ? 'grid-faint' : 'grid');
      return isX ? [line(at, top, at, bottom, ink), text(tick.label, at, bottom + 17, { 'text-anchor': 'middle' })]
        : [line(left, at, right, at, ink), text(tick.label, left - 7, at + 4, { 'text-anchor': 'end' })];
    });
    const middle = isX ? (left + right) / 2 : (top + bottom) / 2;
    const centred = { 'text-anchor': 'middle' };
    const called = scale.options.title.text;
    const title = isX ? text(called, middle, scale.bottom - 3, centred) : text(called, 0, 0, {
      ...centred, transform: `translate(${(scale.left + 13).toFixed(2)} ${middle.toFixed(2)}) rotate(-90)`,
    });
    const [x1, y1] = isX ? [right, bottom] : [left, top];
    return svg('g', {}, ...grid, line(left, bottom, x1, y1, colour('soft')), title);
  };

  // Through points on the canvas, broken where one is missing.
  const path = (points) => points.map((point, i) => {
    if (point.skip) return '';
    return `${i === 0 || points[i - 1].skip ? 'M' : 'L'} ${point.x.toFixed(2)} ${point.y.toFixed(2)}`;
  }).filter((step) => step).join(' ');

  // The areas stand on each other: what is under one is the line of the one before.
  const area = (chart, index) => {
    const { data } = chart.getDatasetMeta(index);
    const below = chart.data.datasets.findLastIndex((set, i) => i < index && set.fill && chart.isDatasetVisible(i));
    const zero = chart.scales.y.getPixelForValue(0);
    const base = below < 0 ? data.map(({ x }) => ({ x, y: zero })) : chart.getDatasetMeta(below).data;
    return `${path([...data, ...[...base].reverse()])} Z`;
  };

  const curve = (chart, meta) => {
    const set = chart.data.datasets[meta.index];
    const dashes = (set.borderDash || []).join(' ');
    const shape = set.showLine === false ? [] : [svg('path', {
      d: path(meta.data), fill: 'none', stroke: set.borderColor, 'stroke-width': set.borderWidth, 'stroke-linejoin': 'round',
      'clip-path': 'url(#plot)', ...(dashes && { 'stroke-dasharray': dashes }),
    })];
    if (set.fill) shape.unshift(svg('path', { d: area(chart, meta.index), fill: set.backgroundColor, 'clip-path': 'url(#plot)' }));
    const marks = pointsOf(chart, meta.index).flatMap(({ point: { x, y, options: o } }) => (o.radius > 0
      ? mark(o.pointStyle, x, y, o.radius, { fill: o.backgroundColor, stroke: o.borderColor, width: o.borderWidth }) : []));
    return svg('g', { 'class': 'curve' }, svg('title', {}, set.label), ...shape, ...marks);
  };

  // Samples with names, in as many rows as it takes. @return [rows, height]
  const legend = (chart) => {
    const { ctx } = chart;
    ctx.font = `${font.size}px ${font.family}`;
    let [x, y] = [0, 0];
    const entries = chart.data.datasets.filter((set, i) => set.inLegend !== false && chart.isDatasetVisible(i)).map((set) => {
      const length = 32 + ctx.measureText(set.label).width + 18;
      if (x > 0 && x + length > width - 24) [x, y] = [0, y + 18];
      const picture = sample(set);
      picture.setAttribute('transform', `translate(${x.toFixed(2)} ${y - 10})`);
      const entry = svg('g', {}, picture, text(set.label, x + 32, y, { fill: colour('ink') }));
      x += length;
      return entry;
    });
    return [entries, y + 18];
  };

  const picture = (chart, title) => {
    const { left, right, top, bottom } = chart.chartArea;
    const [entries, legendHeight] = legend(chart);
    const head = 36 + legendHeight;
    const errorBars = bars(chart).flatMap(({ lines, ink }) => lines.map((ends) => svg('line', {
      x1: ends[0], y1: ends[1], x2: ends[2], y2: ends[3], stroke: ink, 'stroke-width': 1.5,
    })));
    return svg('svg', {
      xmlns: 'http://www.w3.org/2000/svg', width, height: head + height, viewBox: `0 0 ${width} ${head + height}`,
      'font-family': font.family, 'font-size': font.size,
    },
    svg('title', {}, `${document.title}: ${title}`),
    svg('defs', {}, svg('clipPath', { id: 'plot' }, svg('rect', {
      x: left, y: top - 1, width: right - left, height: bottom - top + 2,
    }))),
    svg('rect', { width: '100%', height: '100%', fill: 'white' }),
    text(title, 12, 20, { 'font-weight': 'bold', 'font-size': 14, fill: colour('ink') }),
    svg('g', { transform: 'translate(12 42)' }, ...entries),
    svg('g', { transform: `translate(0 ${head})` }, axis(chart, 'x'), axis(chart, 'y'), ...errorBars,
      ...chart.getSortedVisibleDatasetMetas().reverse().map((meta) => curve(chart, meta)),
      ...names(chart).map(({ text: name, x, y, anchor, ink }) => text(name, x, y, {
        fill: ink, 'font-size': 11, 'font-weight': 600, 'text-anchor': anchor,
      }))));
  };

  const save = (id) => {
    const chart = Chart.getChart(id);
    const title = titleOf(chart).replace(/^./, (c) => c.toUpperCase());
    const text = onPaper(chart, { width, height, font }, (copy) => new XMLSerializer().serializeToString(picture(copy, title)));
    offer(new Blob([`<?xml version="1.0" encoding="UTF-8"?>\n${text}\n`], { type: 'image/svg+xml' }), fileName(title, '.svg'));
  };

  dressers.push((chart) => {
    const { id } = chart.canvas;
    chart.canvas.closest('figure').querySelector('.legend').append(button('Save as SVG', titleOf(chart), () => save(id)));
  });
  Object.assign(plots, { saving: { button, offer, fileName } });
})();
