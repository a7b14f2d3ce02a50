// Pages of curves: one chart for each panel of the study.
(() => {
  const { study, colour, number, logAxis, linearAxis, options, room } = plots;
  const ink = (i) => colour(`curve-${i % 8}`);
  const shape = (name) => (name.startsWith('FVM') ? 'rectRot' : 'circle');
  const dash = (name) => (name.startsWith('FVM') ? [7, 3] : []);

  const chartOf = (panel) => {
    const points = panel.curves.flatMap((curve) => curve.points);
    if (!points.length) return null;
    const x = panel.logarithmic ? logAxis(panel.x, points.map((p) => p.x)) : linearAxis(panel.x);
    const y = panel.logarithmic_y ? logAxis(panel.y, points.map((p) => p.y)) : linearAxis(panel.y, { grace: '5%' });
    const value = (v) => (panel.logarithmic_y ? number(v) : v.toPrecision(5));
    return {
      type: 'line',
      title: panel.title,
      data: {
        datasets: panel.curves.map((curve, i) => ({
          label: curve.name, data: curve.points, borderColor: ink(i), backgroundColor: ink(i), borderWidth: 2,
          borderDash: dash(curve.name), pointStyle: shape(curve.name), pointRadius: 5, pointHoverRadius: 7, pointHitRadius: 10, clip: room,
        })),
      },
      options: options({ x, y }, {
        title: ([item]) => item.dataset.label,
        label: ({ raw }) => [`${panel.y} ${value(raw.y)}`, `${panel.x} ${number(raw.x)}`],
      }),
    };
  };
  study.panels.forEach((panel, k) => plots.add(`panel-${k}`, () => chartOf(panel)));
})();
