// What the charts of the page share: the study from the JSON in #study, numbers, axes, and drawing
// with Chart.js. Colours come from style.css and are read again when the scheme changes and for print.
'use strict';
const plots = (() => {
  const study = JSON.parse(document.getElementById('study').textContent);
  const shapes = { sph: ['circle', 'triangle', 'rect', 'star'], fvm: ['rectRot', 'crossRot', 'cross', 'triangle'] };
  const dashes = { sph: [[], [14, 3], [14, 3, 2, 3], [10, 2]], fvm: [[7, 3], [2, 3], [7, 3, 2, 3], [4, 2]] };
  const builders = [];  // one per chart: [id, what makes its configuration with the colours of the moment]
  const painters = [];  // called whenever the page is drawn anew
  const dressers = [];  // called with every new chart
  let charts = [];

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  // How the columns look: a method at the settings of its case, or one of three looks of its variants.
  const looks = new Map();
  (study.methods || []).forEach(({ name, method = name }, i, all) => {
    const before = all.slice(0, i).filter((other) => other.method === method).length;
    const number = method === name ? 0 : 1 + (before % 3);
    looks.set(name, {
      ink: !shapes[method] ? 'other' : number ? `${method}-${number}` : method,
      shape: shapes[method] ? shapes[method][number] : 'rect', dash: dashes[method] ? dashes[method][number] : [2, 2],
    });
  });
  const colourOf = (name) => colour(looks.get(name).ink);
  const withAlpha = (hex, alpha) => hex + Math.round(255 * alpha).toString(16).padStart(2, '0');
  const usable = (x) => Number.isFinite(x) && x > 0;

  const raised = (n) => String(n).replace(/./g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹⁻'['0123456789-'.indexOf(c)]);
  const isDecade = (x) => Math.abs(Math.log10(x) - Math.round(Math.log10(x))) < 1e-9;
  const powerOfTen = (x) => {
    const n = Math.round(Math.log10(x));
    return n === 0 ? '1' : n === 1 ? '10' : '10' + raised(n);
  };
  const withPower = (x, digits) => {
    const [mantissa, exponent] = x.toExponential(digits - 1).split('e');
    return `${+mantissa} × 10${raised(+exponent)}`.replace('-', '−');
  };
  const isPlain = (x) => x === 0 || (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e4);
  const number = (x, digits = 3) => {
    if (!Number.isFinite(x)) return 'n/a';
    return isPlain(x) ? String(+x.toPrecision(digits)).replace('-', '−') : withPower(x, digits);
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

  // Axes that name powers of ten only; where less than two of them are in sight, 1, 2 and 5 times powers
  // of ten or, in a narrow range as after zooming, round values.
  const isShort = ({ min, max }) => Math.floor(Math.log10(max) + 1e-9) - Math.ceil(Math.log10(min) - 1e-9) < 1;
  const shortValues = ({ min, max }) => {
    if (max / min < 5) return roundValues(min, max);
    const first = Math.floor(Math.log10(min));
    return [0, 1, 2].flatMap((k) => [1, 2, 5].map((m) => ({ value: m * 10 ** (first + k) })))
      .filter(({ value }) => value >= min && value <= max);
  };
  // 1, 2 or 5 times powers of ten around the values, with room so that none of them lies on the edge.
  const logEnds = (values) => {
    const [low, high] = [Math.log10(Math.min(...values)), Math.log10(Math.max(...values))];
    const margin = 0.04 * Math.max(high - low, 0.5);
    const steps = [0, Math.log10(2), Math.log10(5), 1];
    const [first, last] = [Math.floor(low - margin), Math.floor(high + margin)];
    return {
      min: 10 ** (first + steps.findLast((step) => step <= low - margin - first)),
      max: 10 ** (last + steps.find((step) => step >= high + margin - last)),
    };
  };
  const logAxis = (text, values) => ({
    type: 'logarithmic',
    ...logEnds(values),
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

  // With as many digits as it takes to tell neighbouring ticks apart; all with a power where one has it.
  const tickText = (x, index, ticks) => {
    const step = ticks.length > 1 ? Math.abs(ticks[1].value - ticks[0].value) : 0;
    const size = Math.max(...ticks.map((tick) => Math.abs(tick.value)));
    const digits = step > 0 ? Math.ceil(Math.log10(size / step) - 1e-9) + 1 : 3;
    const value = Math.abs(x) < 1e-9 * step ? 0 : x;
    const isOne = value === 0 || ticks.every((tick) => isPlain(tick.value) || Math.abs(tick.value) < 1e-9 * step);
    return (isOne ? number : withPower)(value, Math.max(3, Math.min(digits, 12)));
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

  // Marks on the edge of a plot are seen whole: pixels beyond the axes that a curve may use.
  const room = 8;

  // A curve of a column, with its colour, dashes and marks.
  const curveOf = (method, data, more = {}) => ({
    label: method.title, data, type: 'line',
    borderColor: colourOf(method.name), backgroundColor: colourOf(method.name),
    borderDash: looks.get(method.name).dash, borderWidth: 2, pointStyle: looks.get(method.name).shape,
    clip: room, ...more,
  });

  // Of a plot where it stands alone, as a file: what its configuration says, or else what is read out.
  const titles = new Map();
  const titleOf = ({ canvas: { id } }) => titles.get(id);

  const canvas = (id) => document.getElementById(id);
  const add = (id, build) => { if (canvas(id)) builders.push([id, build]); };

  const withPaperColours = (use) => {
    const { classList } = document.documentElement;
    classList.add('printing');
    try {
      return use();
    } finally {
      classList.remove('printing');
    }
  };
  // Gives `use` a copy of a chart in the colours of paper that shows the same ranges and curves.
  const onPaper = (shown, { width, height, font }, use) => withPaperColours(() => {
    const { title, ...configuration } = builders.find(([id]) => id === shown.canvas.id)[1]();
    const layout = { padding: { top: 6, right: 22, bottom: 8, left: 6 } };
    Object.assign(configuration.options, { responsive: false, devicePixelRatio: 1, font, layout });
    ['x', 'y'].forEach((name) => {
      const { min, max } = shown.scales[name];
      Object.assign(configuration.options.scales[name], { min, max });
    });
    const copy = new Chart(Object.assign(document.createElement('canvas'), { width, height }), configuration);
    shown.data.datasets.forEach((_, i) => copy.setDatasetVisibility(i, shown.isDatasetVisible(i)));
    copy.update('none');
    try {
      return use(copy);
    } finally {
      copy.destroy();
    }
  });

  const draw = () => {
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    Chart.defaults.font.size = 12;
    charts.forEach((chart) => chart.destroy());
    charts = builders.map(([id, build]) => [canvas(id), build()])
      .filter(([, configuration]) => configuration)
      .map(([place, { title, ...configuration }]) => {
        titles.set(place.id, title || place.getAttribute('aria-label'));
        return new Chart(place, configuration);
      });
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
    logAxis, linearAxis, timeAxis, options, room, curveOf, titleOf, withPaperColours, onPaper,
  };
})();
