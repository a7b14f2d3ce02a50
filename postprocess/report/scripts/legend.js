// Legends as rows of buttons: each hides a series and shows it again. What is hidden stays so when a
// chart is drawn anew.
(() => {
  const { svg, sample, dressers } = plots;
  const hidden = new Map();  // canvas id: labels
  const picture = (set) => svg('svg', { viewBox: '0 0 24 12', width: 24, height: 12, 'aria-hidden': true }, sample(set));

  const button = (chart, set, index, off) => {
    const key = document.createElement('button');
    key.type = 'button';
    key.title = 'hide or show';
    key.setAttribute('aria-pressed', String(!off.has(set.label)));
    key.append(picture(set), set.label);
    key.addEventListener('click', () => {
      const show = off.delete(set.label);
      if (!show) off.add(set.label);
      key.setAttribute('aria-pressed', String(show));
      chart.setDatasetVisibility(index, show);
      chart.update('none');
    });
    return key;
  };

  dressers.push((chart) => {
    const { id } = chart.canvas;
    const figure = chart.canvas.closest('figure');
    if (!hidden.has(id)) hidden.set(id, new Set());
    const off = hidden.get(id);
    let row = figure.querySelector('.legend');
    if (!row) {
      row = document.createElement('div');
      row.className = 'legend';
      row.setAttribute('role', 'group');
      row.setAttribute('aria-label', 'Series');
      figure.prepend(row);
    }
    row.replaceChildren();
    chart.data.datasets.forEach((set, index) => {
      if (set.inLegend === false) return;
      row.append(button(chart, set, index, off));
      if (off.has(set.label)) chart.setDatasetVisibility(index, false);
    });
    if (off.size) chart.update('none');
  });
})();
