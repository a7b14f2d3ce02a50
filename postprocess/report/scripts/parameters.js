// Pages of quantities against a parameter: one chart for each panel of the study.
(() => {
  const { study, colour, number, logAxis, linearAxis, options, room } = plots;
  const ink = (i) => colour(`curve-${i % 8}`);
  const isFvm = (name) => name.startsWith('FVM');

  const chartOf = (panel) => {
    const points = panel.curves.flatMap((curve) => curve.points);
    if (!points.length) return null;
    const x = panel.logarithmic ? logAxis(panel.x, points.map((p) => p.x)) : linearAxis(panel.x);
    return {
      type: 'line',
      title: panel.title,
      data: {
        datasets: panel.curves.map((curve, i) => ({
          label: curve.name, data: curve.points, borderColor: ink(i), backgroundColor: ink(i), borderWidth: 2,
          borderDash: isFvm(curve.name) ? [7, 3] : [], pointStyle: isFvm(curve.name) ? 'rectRot' : 'circle',
          pointRadius: 5, pointHoverRadius: 7, pointHitRadius: 10, clip: room,
        })),
      },
      options: options({ x, y: linearAxis(panel.y, { grace: '5%' }) }, {
        title: ([item]) => item.dataset.label,
        label: ({ raw }) => [`${panel.y} ${raw.y.toPrecision(5)}`, `${panel.x} ${number(raw.x)}`],
      }),
    };
  };
  study.panels.forEach((panel, k) => plots.add(`panel-${k}`, () => chartOf(panel)));
})();
