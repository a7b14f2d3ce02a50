// What the charts of the page share: the study from the JSON in #study, numbers, axes, and drawing
// with Chart.js. Colours come from style.css and are read again when the scheme changes and for print.
'use strict';
const plots = (() => {
  const study = JSON.parse(document.getElementById('study').textContent);
  const shapes = { sph: 'circle', fvm: 'rectRot' };
  const dashes = { sph: [], fvm: [7, 3] };
  const builders = [];  // one per chart: makes its configuration with the colours of the moment
  const painters = [];  // called whenever the page is drawn anew
  let charts = [];

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  const colourOf = (method) => colour(shapes[method] ? method : 'other');
  const withAlpha = (hex, alpha) => hex + Math.round(255 * alpha).toString(16).padStart(2, '0');
  const usable = (x) => Number.isFinite(x) && x > 0;

  const raised = (n) => String(n).replace(/./g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹⁻'['0123456789-'.indexOf(c)]);
  const isDecade = (x) => Math.abs(Math.log10(x) - Math.round(Math.log10(x))) < 1e-9;
  const powerOfTen = (x) => {
    const n = Math.round(Math.log10(x));
    return n === 0 ? '1' : n === 1 ? '10' : '10' + raised(n);
  };
  const number = (x) => {
    if (!Number.isFinite(x)) return 'n/a';
    if (x === 0) return '0';
    if (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e4) return String(+x.toPrecision(3)).replace('-', '−');
    const [mantissa, exponent] = x.toExponential(2).split('e');
    return `${+mantissa} × 10${raised(+exponent)}`.replace('-', '−');
  };

  // Axes that end at powers of ten and name only those.
  const logAxis = (text, values) => ({
    type: 'logarithmic',
    min: 10 ** Math.floor(Math.log10(Math.min(...values)) + 1e-9),
    max: 10 ** Math.ceil(Math.log10(Math.max(...values)) - 1e-9 + (isDecade(Math.max(...values)) ? 1 : 0)),
    title: { display: true, text, color: colour('soft') },
    ticks: {
      color: colour('soft'), autoSkip: false, maxRotation: 0,
      callback: (x) => (isDecade(x) ? powerOfTen(x) : ''),
    },
    grid: {
      drawBorder: false, drawTicks: false,
      color: (context) => colour(context.tick && isDecade(context.tick.value) ? 'grid' : 'grid-faint'),
    },
  });

  const linearAxis = (text, more = {}) => ({
    type: 'linear',
    title: { display: true, text, color: colour('soft') },
    ticks: { color: colour('soft'), maxTicksLimit: 6, maxRotation: 0, includeBounds: false, callback: number },
    grid: { color: colour('grid'), drawBorder: false, drawTicks: false },
    ...more,
  });

  // From the first output to the last.
  const timeAxis = (methods) => linearAxis('time [s]', {
    min: Math.min(...methods.map((method) => method.history.time[0])),
    max: Math.max(...methods.map((method) => method.history.time.at(-1))),
  });

  const inOrder = (a, b) => a.datasetIndex - b.datasetIndex;  // whichever is painted last

  const options = (scales, tooltip, legend = {}, interaction = { mode: 'nearest', intersect: true }) => ({
    responsive: true, maintainAspectRatio: false, animation: false,
    layout: { padding: { top: 6, right: 22 } },
    interaction,
    scales,
    plugins: {
      legend: {
        position: 'top', align: 'start', onClick: () => {},
        labels: { color: colour('ink'), usePointStyle: true, boxHeight: 7, padding: 16, sort: inOrder, ...legend },
      },
      tooltip: { callbacks: tooltip, displayColors: false, padding: 10, itemSort: inOrder },
    },
  });

  // Writes dataset.marks[i] beside point i.
  const pointMarks = {
    id: 'pointMarks',
    afterDatasetsDraw(chart) {
      chart.data.datasets.forEach((set, index) => {
        (set.marks || []).forEach((mark, i) => {
          const point = chart.getDatasetMeta(index).data[i];
          if (!point || !mark) return;
          const { ctx } = chart;
          ctx.save();
          ctx.fillStyle = set.markColor;
          ctx.font = `600 11px ${Chart.defaults.font.family}`;
          ctx.textAlign = set.markSide === 'left' ? 'right' : 'left';
          ctx.fillText(mark, point.x + (set.markSide === 'left' ? -8 : 8), point.y - 7);
          ctx.restore();
        });
      });
    },
  };

  // A curve of a method, with its colour, dashes and marks.
  const curveOf = (method, data, more = {}) => ({
    label: method.title, data, type: 'line',
    borderColor: colourOf(method.name), backgroundColor: colourOf(method.name),
    borderDash: dashes[method.name] || [2, 2], borderWidth: 2, pointStyle: shapes[method.name] || 'rect',
    ...more,
  });

  const canvas = (id) => document.getElementById(id);
  const add = (id, build) => { if (canvas(id)) builders.push([id, build]); };

  const draw = () => {
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    Chart.defaults.font.size = 12;
    charts.forEach((chart) => chart.destroy());
    charts = builders.map(([id, build]) => [canvas(id), build()])
      .filter(([, configuration]) => configuration)
      .map(([place, configuration]) => new Chart(place, configuration));
    painters.forEach((paint) => paint());
  };
  const drawForPrint = (printing) => {
    document.documentElement.classList.toggle('printing', printing);
    draw();
  };

  document.addEventListener('DOMContentLoaded', () => {
    document.querySelectorAll('.choice').forEach((choice) => choice.addEventListener('change', draw));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
    addEventListener('beforeprint', () => drawForPrint(true));
    addEventListener('afterprint', () => drawForPrint(false));
    draw();
  });
  return {
    study, canvas, add, painters, colour, colourOf, withAlpha, usable, number,
    logAxis, linearAxis, timeAxis, options, pointMarks, curveOf,
  };
})();
