// Legends as rows of buttons: each hides a series and shows it again. What is hidden stays so when a
// chart is drawn anew.
(() => {
  const hidden = new Map();  // canvas id: labels
  const marks = {
    circle: { d: 'M 7.5 6 a 4.5 4.5 0 1 0 9 0 a 4.5 4.5 0 1 0 -9 0', filled: true },
    rectRot: { d: 'M 12 1 L 17 6 L 12 11 L 7 6 Z', filled: true },
    rect: { d: 'M 4 1 H 20 V 11 H 4 Z', filled: true },
    triangle: { d: 'M 12 1 L 17 10 H 7 Z', filled: true },
    crossRot: { d: 'M 8 2 L 16 10 M 16 2 L 8 10' },
    star: { d: 'M 8 2 L 16 10 M 16 2 L 8 10 M 12 1 V 11' },
  };

  // A piece of the curve with its dashes and its mark; colours and shapes are ours, no text of the study.
  const sample = (set) => {
    const mark = marks[set.pointStyle];
    const hasLine = set.pointStyle !== 'rect' && set.showLine !== false;
    const line = `<path d="M 0 6 H 24" stroke="${set.borderColor}" stroke-width="2" stroke-dasharray="${(set.borderDash || []).join(' ')}"/>`;
    const paint = mark && (mark.filled ? `fill="${set.backgroundColor}"` : `fill="none" stroke="${set.borderColor}" stroke-width="2"`);
    const place = document.createElement('template');
    place.innerHTML = `<svg viewBox="0 0 24 12" width="24" height="12" aria-hidden="true">${hasLine ? line : ''}${
      mark ? `<path d="${mark.d}" ${paint}/>` : ''}</svg>`;
    return place.content.firstChild;
  };

  const button = (chart, set, index, off) => {
    const key = document.createElement('button');
    key.type = 'button';
    key.title = 'hide or show';
    key.setAttribute('aria-pressed', String(!off.has(set.label)));
    key.append(sample(set), set.label);
    key.addEventListener('click', () => {
      const show = off.delete(set.label);
      if (!show) off.add(set.label);
      key.setAttribute('aria-pressed', String(show));
      chart.setDatasetVisibility(index, show);
      chart.update('none');
    });
    return key;
  };

  plots.dressers.push((chart) => {
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
