// What the charts of the page share: the study from the JSON in #study, numbers, axes, and drawing
// with Chart.js. Colours come from style.css and are read again when the scheme changes and for print.
'use strict';
const plots = (() => {
  const study = JSON.parse(document.getElementById('study').textContent);
  const shapes = { sph: 'circle', fvm: 'rectRot' };
  const dashes = { sph: [], fvm: [7, 3] };
  const builders = [];  // one per chart: makes its configuration with the colours of the moment
  const painters = [];  // called whenever the page is drawn anew
  const dressers = [];  // called with every new chart
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
  const number = (x, digits = 3) => {
    if (!Number.isFinite(x)) return 'n/a';
    if (x === 0) return '0';
    if (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e4) return String(+x.toPrecision(digits)).replace('-', '−');
    const [mantissa, exponent] = x.toExponential(digits - 1).split('e');
    return `${+mantissa} × 10${raised(+exponent)}`.replace('-', '−');
  };

  // Round values from `least` to `most`, about five: steps of 1, 2 or 5 times a power of ten.
  const roundValues = (least, most) => {
    const raw = (most - least) / 5;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((k) => k * power >= raw * (1 - 1e-9));
    const values = [];
    for (let k = Math.ceil(least / step - 1e-9); k * step <= most + 1e-9 * step; k += 1) values.push({ value: k * step });
    return values;
  };

  // Axes that end at powers of ten and name only those; where less than two of them are in sight, as
  // after zooming, 1, 2 and 5 times powers of ten or, in a narrow range, round values.
  const isShort = ({ min, max }) => Math.floor(Math.log10(max) + 1e-9) - Math.ceil(Math.log10(min) - 1e-9) < 1;
  const shortValues = ({ min, max }) => {
    if (max / min < 5) return roundValues(min, max);
    const first = Math.floor(Math.log10(min));
    return [0, 1, 2].flatMap((k) => [1, 2, 5].map((m) => ({ value: m * 10 ** (first + k) })))
      .filter(({ value }) => value >= min && value <= max);
  };
  const logAxis = (text, values) => ({
    type: 'logarithmic',
    min: 10 ** Math.floor(Math.log10(Math.min(...values)) + 1e-9),
    max: 10 ** Math.ceil(Math.log10(Math.max(...values)) - 1e-9 + (isDecade(Math.max(...values)) ? 1 : 0)),
    title: { display: true, text, color: colour('soft') },
    afterBuildTicks: (axis) => { if (isShort(axis)) axis.ticks = shortValues(axis); },
    ticks: {
      color: colour('soft'), autoSkip: false, maxRotation: 0,
      callback(x, index, ticks) {
        if (isShort(this)) return this.max / this.min < 5 ? tickText(x, index, ticks) : number(x);
        return isDecade(x) ? powerOfTen(x) : '';
      },
    },
    grid: {
      drawBorder: false, drawTicks: false,
      color: (context) => colour(context.tick && isDecade(context.tick.value) ? 'grid' : 'grid-faint'),
    },
  });

  // With as many digits as it takes to tell neighbouring ticks apart.
  const tickText = (x, index, ticks) => {
    const step = ticks.length > 1 ? Math.abs(ticks[1].value - ticks[0].value) : 0;
    const size = Math.max(...ticks.map((tick) => Math.abs(tick.value)));
    const digits = step > 0 ? Math.ceil(Math.log10(size / step) - 1e-9) + 1 : 3;
    return number(Math.abs(x) < 1e-9 * step ? 0 : x, Math.max(3, Math.min(digits, 12)));
  };
  const linearAxis = (text, more = {}) => ({
    type: 'linear',
    title: { display: true, text, color: colour('soft') },
    ticks: { color: colour('soft'), maxTicksLimit: 6, maxRotation: 0, includeBounds: false, callback: tickText },
    grid: { color: colour('grid'), drawBorder: false, drawTicks: false },
    ...more,
  });

  // From the first output to the last.
  const timeAxis = (methods) => linearAxis('time [s]', {
    min: Math.min(...methods.map((method) => method.history.time[0])),
    max: Math.max(...methods.map((method) => method.history.time.at(-1))),
  });

  const inOrder = (a, b) => a.datasetIndex - b.datasetIndex;  // whichever is painted last

  const options = (scales, tooltip, interaction = { mode: 'nearest', intersect: true }) => ({
    responsive: true, maintainAspectRatio: false, animation: false,
    layout: { padding: { top: 6, right: 22 } },
    interaction,
    scales,
    plugins: {
      legend: { display: false },  // scripts/legend.js
      tooltip: { callbacks: tooltip, displayColors: false, padding: 10, itemSort: inOrder },
    },
  });

  // Paints what belongs between the axes and nothing beyond them.
  const inPlot = (chart, paint) => {
    const { ctx, chartArea: { left, top, width, height } } = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left - 12, top - 12, width + 24, height + 24);
    ctx.clip();
    paint();
    ctx.restore();
  };

  // Writes dataset.marks[i] beside point i.
  const pointMarks = {
    id: 'pointMarks',
    afterDatasetsDraw(chart) {
      inPlot(chart, () => chart.data.datasets.forEach((set, index) => {
        (set.marks || []).forEach((mark, i) => {
          const point = chart.getDatasetMeta(index).data[i];
          if (!point || !mark || !chart.isDatasetVisible(index)) return;
          const { ctx } = chart;
          ctx.fillStyle = set.markColor;
          ctx.font = `600 11px ${Chart.defaults.font.family}`;
          ctx.textAlign = set.markSide === 'left' ? 'right' : 'left';
          ctx.fillText(mark, point.x + (set.markSide === 'left' ? -8 : 8), point.y - 7);
        });
      }));
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
    charts.forEach((chart) => dressers.forEach((dress) => dress(chart)));
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
    study, canvas, add, painters, dressers, colour, colourOf, withAlpha, usable, number,
    logAxis, linearAxis, timeAxis, options, inPlot, pointMarks, curveOf,
  };
})();
