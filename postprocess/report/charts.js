// Draws the charts of the page from the JSON in #study with Chart.js. Colours come from style.css and
// are read again when the scheme changes and for print.
'use strict';
(() => {
  const study = JSON.parse(document.getElementById('study').textContent);
  const shapes = { sph: 'circle', fvm: 'rectRot' };
  const dashes = { sph: [], fvm: [7, 3] };
  const layers = {
    strain: 'strain energy', kinetic: 'kinetic energy',
    viscous: 'viscous dissipation', numerical: 'numerical dissipation',
  };
  const builders = [];  // one per chart: makes its configuration with the colours of the moment
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

  const options = (scales, tooltip, legend = {}) => ({
    responsive: true, maintainAspectRatio: false, animation: false,
    layout: { padding: { top: 6, right: 22 } },
    interaction: { mode: 'nearest', intersect: true },
    scales,
    plugins: {
      legend: {
        position: 'top', align: 'start', onClick: () => {},
        labels: { color: colour('ink'), usePointStyle: true, boxHeight: 7, padding: 16, ...legend },
      },
      tooltip: { callbacks: tooltip, displayColors: false, padding: 10 },
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

  // Points {x, y} of a method for a field, coarse to fine.
  const pointsOf = (method, field, x) => method.runs
    .map((run) => ({ x: run[x], y: run.errors[field], run }))
    .filter((point) => usable(point.x) && usable(point.y));

  const methodLine = (method, field, x, markSide) => {
    const points = pointsOf(method, field, x);
    return {
      label: method.title, data: points, type: 'line',
      borderColor: colourOf(method.name), backgroundColor: colourOf(method.name),
      borderDash: dashes[method.name] || [2, 2], borderWidth: 2,
      pointStyle: shapes[method.name] || 'rect', pointRadius: 5.5, pointHoverRadius: 8,
      marks: points.map((point) => String(point.run.level)), markColor: colourOf(method.name), markSide,
    };
  };

  // Seconds at which a method reaches an error: straight lines between its points in log-log.
  const secondsAt = (points, error) => {
    for (let i = 1; i < points.length; i += 1) {
      const [a, b] = [points[i - 1], points[i]];
      if (Math.max(a.y, b.y) >= error * (1 - 1e-12) && Math.min(a.y, b.y) <= error * (1 + 1e-12) && a.y !== b.y) {
        const part = Math.log(error / a.y) / Math.log(b.y / a.y);
        return a.x * (b.x / a.x) ** part;
      }
    }
    return NaN;
  };

  // What the same error costs by either method, at the smallest error that both reach: the caption
  // as pieces of text, the second in bold.
  const priceSentence = (field) => {
    const methods = study.methods.map((m) => ({ title: m.title, points: pointsOf(m, field, 'seconds') }))
      .filter((m) => m.points.length > 1);
    if (methods.length !== 2) return [];
    const error = Math.max(...methods.map((m) => Math.min(...m.points.map((p) => p.y))));
    const [a, b] = methods.map((m) => ({ title: m.title, seconds: secondsAt(m.points, error) }));
    if (!usable(a.seconds) || !usable(b.seconds)) return [];
    const [slow, fast] = a.seconds > b.seconds ? [a, b] : [b, a];
    const inside = (title) => (title === 'Finite volume' ? 'finite volume' : title);
    return [`At the same ${study.fields[field]} error, ${number(error)}, `,
      `${inside(slow.title)} takes ${number(slow.seconds / fast.seconds)} times the seconds`,
      ` of ${inside(fast.title)} (${number(slow.seconds)} s against ${number(fast.seconds)} s, `
      + 'between the points along straight lines).'];
  };
  const writePrice = (caption, field) => {
    const [before, bold, after] = priceSentence(field);
    const strong = document.createElement('strong');
    strong.textContent = bold;
    caption.replaceChildren(...(before ? [before, strong, after] : []));
  };

  // Slopes of order one and two under the points, up from the finest spacing.
  const slopes = (lines) => {
    const points = lines.flatMap((line) => line.data);
    const [h0, h1] = [Math.max(...points.map((p) => p.x)), Math.min(...points.map((p) => p.x))];
    const foot = 0.5 * Math.min(...points.filter((p) => p.x < 1.2 * h1).map((p) => p.y));
    return h0 > h1 * 1.01 ? [1, 2].map((order) => ({
      label: `order ${order}`, type: 'line', pointRadius: 0, pointHitRadius: 0, pointStyle: 'line',
      data: [{ x: h1, y: foot }, { x: h0, y: foot * (h0 / h1) ** order }],
      borderColor: colour('soft'), borderDash: [2, 4], borderWidth: 1,
      marks: ['', `order ${order}`], markColor: colour('soft'), markSide: 'right',
    })) : [];
  };

  const errorChart = (field, x, xText, withSlopes) => {
    const lines = study.methods.map((method) => methodLine(method, field, x, withSlopes ? 'left' : 'right'))
      .filter((line) => line.data.length);
    if (!lines.length) return null;
    const all = withSlopes ? [...lines, ...slopes(lines)] : lines;
    const points = all.flatMap((line) => line.data);
    return {
      type: 'line',
      data: { datasets: all },
      options: options({
        x: logAxis(xText, points.map((p) => p.x)),
        y: logAxis(`relative L₂ error of ${study.fields[field]}`, points.map((p) => p.y)),
      }, {
        title: (items) => `${items[0].dataset.label}, level ${items[0].raw.run.level}`,
        label: ({ raw }) => [`error ${number(raw.y)}`, `${number(raw.run.seconds)} s`,
          `spacing ${number(raw.run.spacing)} m`, `${raw.run.nodes.toLocaleString('en')} nodes`],
      }, { filter: (item) => !item.text.startsWith('order ') }),
      plugins: [pointMarks],
    };
  };

  const asPoints = (history, name) => history.time.map((t, i) => ({ x: t, y: history[name][i] }));

  const energyChart = (method, top) => ({
    type: 'line',
    data: {
      datasets: [
        ...Object.keys(layers).filter((name) => method.history[name].some((y) => y !== 0)).map((name) => ({
          label: layers[name], data: asPoints(method.history, name), stack: 'energy', fill: 'stack',
          borderColor: colour(name), backgroundColor: withAlpha(colour(name), 0.55), borderWidth: 1,
          pointRadius: 0, pointHitRadius: 8, pointStyle: 'rect',
        })),
        {
          label: 'start + work', data: asPoints(method.history, 'supplied'), stack: 'supplied', fill: false,
          borderColor: colour('ink'), backgroundColor: colour('ink'), borderDash: [5, 4], borderWidth: 1.5,
          pointRadius: 0, pointHitRadius: 8, pointStyle: 'line',
        },
      ],
    },
    options: options({
      x: timeAxis([method]),
      y: linearAxis('energy [J]', { stacked: true, suggestedMax: top }),
    }, {
      title: (items) => `t = ${number(items[0].raw.x)} s`,
      label: (item) => `${item.dataset.label}: ${number(item.raw.y)} J`,
    }),
  });

  const residualChart = (methods) => ({
    type: 'line',
    data: {
      datasets: methods.map((method) => ({
        label: method.title, data: asPoints(method.history, 'residual'),
        borderColor: colourOf(method.name), backgroundColor: colourOf(method.name),
        borderDash: dashes[method.name] || [2, 2], borderWidth: 1.75,
        pointStyle: shapes[method.name] || 'rect', pointRadius: method.history.time.length > 40 ? 0 : 2.5, pointHitRadius: 8,
      })),
    },
    options: options({ x: timeAxis(methods), y: linearAxis('relative residual') }, {
      title: (items) => `t = ${number(items[0].raw.x)} s`,
      label: (item) => `${item.dataset.label}: ${number(item.raw.y)}`,
    }),
  });

  const canvas = (id) => document.getElementById(id);
  const chosenField = (group) => document.querySelector(`input[name="${group}-field"]:checked`).value;

  if (canvas('cost-chart')) {
    builders.push(['cost-chart', () => {
      const field = chosenField('cost');
      writePrice(canvas('cost-chart-caption'), field);
      return errorChart(field, 'seconds', 'seconds in the time loop', false);
    }]);
    builders.push(['convergence-chart', () => errorChart(chosenField('convergence'), 'spacing', 'spacing [m]', true)]);
  }
  const histories = study.methods.filter((method) => method.history && method.history.time.length);
  const highest = Math.max(0, ...histories.flatMap((m) => m.history.time.map(
    (_, i) => Object.keys(layers).reduce((sum, name) => sum + m.history[name][i], 0))));
  histories.forEach((method) => {
    builders.push([`energy-${method.name}`, () => energyChart(method, highest)]);
  });
  if (canvas('residual-chart')) builders.push(['residual-chart', () => residualChart(histories)]);

  const draw = () => {
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    Chart.defaults.font.size = 12;
    charts.forEach((chart) => chart.destroy());
    charts = builders.map(([id, build]) => [canvas(id), build()])
      .filter(([, configuration]) => configuration)
      .map(([place, configuration]) => new Chart(place, configuration));
  };
  const drawForPrint = (printing) => {
    document.documentElement.classList.toggle('printing', printing);
    draw();
  };

  document.querySelectorAll('.choice').forEach((choice) => choice.addEventListener('change', draw));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
  addEventListener('beforeprint', () => drawForPrint(true));
  addEventListener('afterprint', () => drawForPrint(false));
  draw();
})();
