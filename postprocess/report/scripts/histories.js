// Energies and probes over time.
(() => {
  const { study, colour, withAlpha, number, linearAxis, timeAxis, options, room, curveOf } = plots;
  const layers = {
    strain: 'strain energy', kinetic: 'kinetic energy',
    viscous: 'viscous dissipation', numerical: 'numerical dissipation',
  };
  const histories = study.methods.filter((method) => method.history && method.history.time.length);
  const atOneTime = { mode: 'index', intersect: false };  // all curves at the instant nearest to the pointer
  const asPoints = (history, values) => history.time.map((t, i) => ({ x: t, y: values[i] }));
  const timeTitle = (items) => `t = ${number(items[0].raw.x)} s`;
  const highest = Math.max(0, ...histories.flatMap((m) => m.history.time.map(
    (_, i) => Object.keys(layers).reduce((sum, name) => sum + m.history[name][i], 0))));

  const area = ({ history }, name) => ({
    label: layers[name], data: asPoints(history, history[name]), stack: 'energy', fill: 'stack',
    borderColor: colour(name), backgroundColor: withAlpha(colour(name), 0.55), borderWidth: 1,
    pointRadius: 0, pointStyle: 'rect',
  });
  const line = ({ history }, name, label, ink, dash) => ({
    label, data: asPoints(history, history[name]), stack: name, fill: false,
    borderColor: colour(ink), backgroundColor: colour(ink), borderDash: dash, borderWidth: 1.5,
    pointRadius: 0, pointStyle: 'line',
  });

  const energyChart = (method) => {
    const { history } = method;
    const fromRest = history.supplied[0] === 0;
    const lines = [line(method, 'supplied', fromRest ? 'external work' : 'start + work', 'ink', [5, 4])];
    if (history.projection.some((y) => y !== 0)) lines.push(line(method, 'projection', 'work of the projection', 'soft', [6, 3]));
    if (!fromRest && history.work.some((y) => y !== 0)) lines.push(line(method, 'work', 'external work', 'soft', [1, 3]));
    return {
      type: 'line',
      title: `Energies over time, ${method.title}`,
      data: {
        datasets: [
          ...Object.keys(layers).filter((name) => history[name].some((y) => y !== 0)).map((name) => area(method, name)),
          ...lines,
        ],
      },
      options: options({
        x: timeAxis([method]), y: linearAxis('energy [J]', { stacked: true, suggestedMax: highest }),
      }, {
        title: timeTitle,
        label: (item) => `${item.dataset.label}: ${number(item.raw.y)} J`,
        footer: ([item]) => `residual: ${number(history.residual[item.dataIndex])} J`,
      }, atOneTime),
    };
  };

  // What the curves are held against: the exact solution on top of them, values from elsewhere.
  const exactCurve = (values) => (values ? [{
    label: 'exact', data: study.exact.time.map((t, i) => ({ x: t, y: values[i] })), type: 'line',
    borderColor: colour('ink'), backgroundColor: colour('ink'), borderDash: [2, 4], borderWidth: 1.75,
    pointRadius: 0, pointStyle: 'line', order: -9, clip: room,
  }] : []);
  // Many of them are a history: a line without marks.
  const isHistory = (points) => points.length > 20;
  const referencePoints = (probe) => study.references.filter((one) => one.probe === probe)
    .map(({ points }, i, all) => ({
      label: all.length > 1 ? `reference ${i + 1}` : 'reference', type: 'line',
      ...(isHistory(points) ? { borderDash: [6, 3] } : { showLine: false }),
      data: points.map(([x, y]) => ({ x, y })),
      borderColor: colour('ink'), backgroundColor: colour('ink'), borderWidth: isHistory(points) ? 1.75 : 2,
      pointRadius: isHistory(points) ? 0 : 6, pointHoverRadius: 8, pointHitRadius: 10, pointStyle: ['crossRot', 'star', 'triangle'][i % 3], order: -10, clip: room,
    }));

  // Both methods in one picture; pointing tells all values at the nearest instant that has any.
  const overlaid = (values, title, yText, label, references = []) => {
    const methods = histories.filter((method) => values(method.history));
    return {
      type: 'line',
      title: `${title} over time`,
      data: {
        // dashes over the solid line: both are seen where they coincide
        datasets: [...methods.map((method, i) => curveOf(method, asPoints(method.history, values(method.history)), {
          order: -i, borderWidth: 2, pointRadius: method.history.time.length > 40 ? 0 : 2.5,
        })), ...references],
      },
      options: options({ x: timeAxis(methods), y: linearAxis(yText) }, { title: timeTitle, label },
        { mode: 'nearest', axis: 'x', intersect: false }),
    };
  };

  histories.forEach((method) => plots.add(`energy-${method.name}`, () => energyChart(method)));
  plots.add('residual-chart', () => overlaid((history) => history.relative, 'Relative energy residual', 'relative residual',
    (item) => `${item.dataset.label}: ${number(item.raw.y)}`));
  const seriesChart = (id, { name, unit }, values, references) => {
    const [suffix, brackets] = unit === '-' ? ['', ''] : [` ${unit}`, ` [${unit}]`];
    plots.add(id, () => overlaid(values, name, name + brackets,
      (item) => `${item.dataset.label}: ${item.raw.y.toPrecision(5)}${suffix}`, references()));
  };
  study.probes.forEach((probe, k) => seriesChart(`probe-${k}`, probe, (history) => history.probes[k],
    () => [...exactCurve(study.exact && study.exact.probes[probe.name]), ...referencePoints(probe.name)]));
  (study.exact ? study.exact.others : []).forEach(({ name, unit, values }, k) => seriesChart(
    `exact-${k}`, { name, unit }, (history) => history.others[k], () => exactCurve(values)));
})();
