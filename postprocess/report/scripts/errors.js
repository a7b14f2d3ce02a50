// Errors against cost and against spacing, and scalars with their error bars.
(() => {
  const { study, canvas, colour, colourOf, usable, number, logAxis, linearAxis, options, painting, curveOf } = plots;

  // Points {x, y} of a method for a field, coarse to fine.
  const pointsOf = (method, field, x) => method.runs
    .map((run) => ({ x: run[x], y: run.errors[field], run }))
    .filter((point) => usable(point.x) && usable(point.y));

  const methodLine = (method, field, x, namesAt) => {
    const points = pointsOf(method, field, x);
    return curveOf(method, points, {
      pointRadius: 5.5, pointHoverRadius: 8, pointHitRadius: 10,
      names: points.map((point) => String(point.run.level)), namesInk: colourOf(method.name), namesAt,
    });
  };

  // What the same error costs by either method, at the smallest error that both reach: the caption
  // as pieces of text, the second in bold.
  const priceSentence = (field) => {
    const price = study.prices[field];
    if (!price) return [];
    const [slow, fast] = study.methods.filter(({ name }) => price.seconds[name])
      .map(({ name, title }) => ({ title: title === 'Finite volume' ? 'finite volume' : title, seconds: price.seconds[name] }))
      .sort((a, b) => b.seconds - a.seconds);
    return [`At the same ${study.fields[field]} error, ${number(price.error)}, `,
      `${slow.title} takes ${number(slow.seconds / fast.seconds)} times the seconds`,
      ` of ${fast.title} (${number(slow.seconds)} s against ${number(fast.seconds)} s, `
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
      label: `order ${order}`, inLegend: false, type: 'line', pointRadius: 0, pointHitRadius: 0, pointStyle: 'line',
      data: [{ x: h1, y: foot }, { x: h0, y: foot * (h0 / h1) ** order }],
      borderColor: colour('soft'), borderDash: [2, 4], borderWidth: 1,
      names: ['', `order ${order}`], namesInk: colour('soft'), namesAt: 'right',
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
      title: `Error of ${study.fields[field]} against ${x}`,
      data: { datasets: all },
      options: options({
        x: logAxis(xText, points.map((p) => p.x)),
        y: logAxis(`relative L₂ error of ${study.fields[field]}`, points.map((p) => p.y)),
      }, {
        title: (items) => `${items[0].dataset.label}, level ${items[0].raw.run.level}`,
        label: ({ raw }) => [`error ${number(raw.y)}`, `${number(raw.run.seconds)} s`,
          `spacing ${number(raw.run.spacing)} m`, `${raw.run.nodes.toLocaleString('en')} nodes`],
      }),
      plugins: [painting],
    };
  };

  const quantityLines = (quantity) => quantity.series.map((series) => {
    const method = study.methods.find((m) => m.name === series.method);
    const points = series.points.map((p) => ({ x: p.spacing, y: p.value, bar: p.bar, level: p.level }));
    const { extrapolated } = series;
    if (Number.isFinite(extrapolated)) points.push({ x: 0, y: extrapolated });
    return curveOf(method, points, {
      pointRadius: 5, pointHoverRadius: 7, pointHitRadius: 10,
      pointBackgroundColor: points.map((p) => (p.x === 0 ? colour('paper') : colourOf(method.name))),
    });
  });

  const quantityChart = (quantity) => {
    const lines = quantityLines(quantity);
    const points = lines.flatMap((line) => line.data);
    const title = quantity.name + (quantity.unit === '-' ? '' : ` [${quantity.unit}]`);
    return {
      type: 'line',
      title: `${quantity.name} against spacing`,
      data: { datasets: lines },
      options: options({
        x: linearAxis('spacing [m]', { min: 0 }),
        y: linearAxis(title, {
          grace: '5%',
          suggestedMin: Math.min(...points.map((p) => p.y - (p.bar || 0))),
          suggestedMax: Math.max(...points.map((p) => p.y + (p.bar || 0))),
        }),
      }, {
        title: ([item]) => `${item.dataset.label}, ${item.raw.x === 0 ? 'extrapolated' : `level ${item.raw.level}`}`,
        label: ({ raw }) => [`${raw.y.toPrecision(6)}${raw.bar ? ` ± ${number(raw.bar)}` : ''}`, `spacing ${number(raw.x)} m`],
      }),
      plugins: [painting],
    };
  };

  const chosenField = (group) => document.querySelector(`input[name="${group}-field"]:checked`).value;
  plots.add('cost-chart', () => {
    const field = chosenField('cost');
    writePrice(canvas('cost-chart-caption'), field);
    return errorChart(field, 'seconds', 'seconds in the time loop', false);
  });
  plots.add('convergence-chart', () => errorChart(chosenField('convergence'), 'spacing', 'spacing [m]', true));
  plots.add('quantity-chart', () => quantityChart(study.quantities[canvas('quantity').value]));
})();
