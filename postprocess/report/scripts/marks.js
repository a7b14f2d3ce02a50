// What plots show besides curves: the shapes of marks, names of points, error bars. Chart.js paints them on
// the canvas, scripts/save.js writes them as SVG, scripts/legend.js shows them beside their names.
Object.assign(plots, (() => {
  // An element of SVG; numbers are given to a hundredth of a pixel.
  const svg = (name, attributes = {}, ...children) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', name);
    Object.entries(attributes).forEach(([key, value]) => element.setAttribute(
      key, typeof value === 'number' ? String(Math.round(100 * value) / 100) : value));
    element.append(...children);
    return element;
  };

  // Lines about the origin of the marks that Chart.js draws with radius 1: one that is closed, or crossing ones.
  const d = Math.SQRT1_2;
  const diagonals = [[[-d, -d], [d, d]], [[d, -d], [-d, d]]];
  const outlines = {
    rectRot: [[[0, -1], [1, 0], [0, 1], [-1, 0]]],
    rect: [[[-d, -d], [d, -d], [d, d], [-d, d]]],
    triangle: [[[0, -1], [0.866, 0.5], [-0.866, 0.5]]],
    crossRot: diagonals,
    cross: [[[0, -1], [0, 1]], [[-1, 0], [1, 0]]],
    star: [...diagonals, [[0, -1], [0, 1]], [[-1, 0], [1, 0]]],
  };
  const mark = (style, x, y, radius, { fill, stroke, width }) => {
    const paint = { stroke, 'stroke-width': width };
    if (style === 'circle') return [svg('circle', { cx: x, cy: y, r: radius, fill, ...paint })];
    const lines = outlines[style];
    if (!lines) return [];
    const corner = ([u, v]) => `${(x + radius * u).toFixed(2)} ${(y + radius * v).toFixed(2)}`;
    const path = lines.map((line) => `M ${line.map(corner).join(' L ')}`);
    return [svg('path', { d: path.join(' ') + (lines.length > 1 ? '' : ' Z'), fill: lines.length > 1 ? 'none' : fill, ...paint })];
  };

  // A piece of the curve of a dataset, 24 by 12: its line with its dashes and its mark, or its area.
  const sample = (set) => {
    const { borderColor: stroke, backgroundColor: fill } = set;
    if (set.fill) return svg('g', {}, svg('rect', { x: 4, y: 1, width: 16, height: 10, fill, stroke }));
    const dashes = (set.borderDash || []).join(' ');
    const line = set.showLine === false ? [] : [svg('path', {
      d: 'M 0 6 H 24', fill: 'none', stroke, 'stroke-width': 2, ...(dashes && { 'stroke-dasharray': dashes }),
    })];
    return svg('g', {}, ...line, ...mark(set.pointStyle, 12, 6, 5, { fill, stroke, width: 1.5 }));
  };

  // Points of a dataset, where it is visible, that lie between the axes; with the dataset and their number.
  const pointsOf = (chart, index) => {
    if (!chart.isDatasetVisible(index)) return [];
    const set = chart.data.datasets[index];
    const { left, right, top, bottom } = chart.chartArea;
    return chart.getDatasetMeta(index).data.map((point, i) => ({ set, point, i })).filter(
      ({ point: { x, y } }) => x >= left - 0.5 && x <= right + 0.5 && y >= top - 0.5 && y <= bottom + 0.5);
  };

  // What dataset.names calls its points, beside them; on the other side where there is no room.
  const names = (chart) => chart.data.datasets.flatMap((_, index) => pointsOf(chart, index)).filter(
    ({ set, i }) => set.names && set.names[i]).map(({ set, point, i }) => {
    const text = set.names[i];
    const length = 7 * text.length + 8;
    const onLeft = set.namesAt === 'left' ? point.x - length > chart.chartArea.left : point.x + length > chart.width;
    return {
      text, x: point.x + (onLeft ? -8 : 8), y: point.y - 7, anchor: onLeft ? 'end' : 'start', ink: set.namesInk,
    };
  });

  // Ends of the error bars of the points that have one, as far as they are within the axes, and of the caps
  // at those ends that are: [x0, y0, x1, y1].
  const bars = (chart) => chart.data.datasets.flatMap((set, index) => {
    if (!chart.isDatasetVisible(index)) return [];
    const { chartArea: { left, right, top, bottom }, scales: { y } } = chart;
    return chart.getDatasetMeta(index).data.flatMap(({ x }, i) => {
      const { y: value, bar } = set.data[i];
      if (!bar || x < left - 0.5 || x > right + 0.5) return [];
      const ends = [y.getPixelForValue(value + bar), y.getPixelForValue(value - bar)];
      if (ends[0] > bottom || ends[1] < top) return [];
      const caps = ends.filter((end) => end >= top - 1 && end <= bottom + 1).map((end) => [x - 5, end, x + 5, end]);
      const lines = [[x, Math.max(ends[0], top), x, Math.min(ends[1], bottom)], ...caps];
      return [{ lines, ink: set.borderColor }];
    });
  });

  const painting = {
    id: 'painting',
    beforeDatasetsDraw(chart) {
      const { ctx } = chart;
      bars(chart).forEach(({ lines, ink }) => {
        ctx.strokeStyle = ink;
        ctx.lineWidth = 1.5;
        ctx.beginPath();
        lines.forEach(([x0, y0, x1, y1]) => {
          ctx.moveTo(x0, y0);
          ctx.lineTo(x1, y1);
        });
        ctx.stroke();
      });
    },
    afterDatasetsDraw(chart) {
      const { ctx } = chart;
      names(chart).forEach(({ text, x, y, anchor, ink }) => {
        ctx.fillStyle = ink;
        ctx.font = `600 11px ${Chart.defaults.font.family}`;
        ctx.textAlign = anchor;
        ctx.fillText(text, x, y);
      });
    },
  };
  return { svg, mark, sample, pointsOf, names, bars, painting };
})());
