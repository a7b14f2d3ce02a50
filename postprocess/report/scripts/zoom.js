// Zooming of every chart: a part dragged over with the mouse, two fingers, the wheel (with Ctrl, or on a
// chart that was clicked, so that the page still scrolls), or + - and arrows. A double click, 0, Escape
// or the button in the corner shows everything again. What is seen stays when a chart is drawn anew with
// the same axes.
(() => {
  const { dressers, room } = plots;
  const names = ['x', 'y'];
  const views = new Map();  // canvas id: { axes, whole, shown } of a zoomed chart
  const deepest = 1e-6;  // of the whole range

  const inUnits = (scale, value) => (scale.type === 'logarithmic' ? Math.log(value) : value);
  const fromUnits = (scale, value) => (scale.type === 'logarithmic' ? Math.exp(value) : value);
  const axesOf = (chart) => names.map((name) => chart.options.scales[name].title.text).join();

  const show = (chart, shown) => {
    const view = views.get(chart.canvas.id);
    names.forEach((name) => Object.assign(chart.options.scales[name], shown[name]));
    chart.data.datasets.forEach((set) => { if (set.clip !== undefined) set.clip = view ? 1 : room; });
    chart.update('none');
    chart.canvas.parentNode.querySelector('.whole').hidden = !view;
  };
  const showWhole = (chart) => {
    const view = views.get(chart.canvas.id);
    if (!view) return;
    views.delete(chart.canvas.id);
    show(chart, view.asked);
  };

  // Makes the chart show what lies between these pixels: { x: [from, to], y: [from, to] }, as far as
  // it has something there.
  const zoomTo = (chart, pixels) => {
    const view = views.get(chart.canvas.id) || { axes: axesOf(chart), asked: {}, whole: {}, shown: {} };
    const isNew = !views.has(chart.canvas.id);
    const shown = {};
    let isWhole = true;
    for (const name of names) {
      const scale = chart.scales[name];
      if (isNew) {
        const { min, max } = chart.options.scales[name];
        view.asked[name] = { min, max };
        view.whole[name] = [inUnits(scale, scale.min), inUnits(scale, scale.max)];
      }
      const [least, most] = view.whole[name];
      const [a, b] = pixels[name].map((p) => inUnits(scale, scale.getValueForPixel(p))).sort((p, q) => p - q);
      const width = Math.min(b - a, most - least);
      if (!(width > deepest * (most - least))) return;
      const from = Math.min(Math.max(a, least), most - width);
      if (width < (1 - 1e-9) * (most - least)) isWhole = false;
      shown[name] = { min: fromUnits(scale, from), max: fromUnits(scale, from + width) };
    }
    if (isWhole) {
      showWhole(chart);
      return;
    }
    views.set(chart.canvas.id, Object.assign(view, { shown }));
    show(chart, shown);
  };

  const ends = (chart) => {
    const { left, right, top, bottom } = chart.chartArea;
    return { x: [left, right], y: [top, bottom] };
  };
  // What was under `from` goes to `to`, `factor` times as large.
  const moveAndScale = (chart, from, to, factor) => {
    const all = ends(chart);
    zoomTo(chart, Object.fromEntries(names.map(
      (name) => [name, all[name].map((p) => from[name] + (p - to[name]) / factor)])));
  };
  const middle = (chart) => {
    const all = ends(chart);
    return { x: (all.x[0] + all.x[1]) / 2, y: (all.y[0] + all.y[1]) / 2 };
  };

  const onKey = (canvas, event) => {
    const chart = Chart.getChart(canvas);
    const centre = middle(chart);
    const step = 0.2 * Math.min(chart.chartArea.width, chart.chartArea.height);
    const shifted = (x, y) => moveAndScale(chart, centre, { x: centre.x + x * step, y: centre.y + y * step }, 1);
    const actions = {
      '+': () => moveAndScale(chart, centre, centre, 1.5), '-': () => moveAndScale(chart, centre, centre, 1 / 1.5),
      ArrowLeft: () => shifted(1, 0), ArrowRight: () => shifted(-1, 0), ArrowUp: () => shifted(0, 1), ArrowDown: () => shifted(0, -1),
      0: () => showWhole(chart), Escape: () => showWhole(chart),
    };
    const action = actions[event.key === '=' ? '+' : event.key];
    const moves = event.key.startsWith('Arrow');
    // arrows scroll the page until there is something to move
    if (!action || event.ctrlKey || event.metaKey || event.altKey || (moves && !views.has(canvas.id))) return;
    event.preventDefault();
    action();
  };

  const placeOf = (canvas, { clientX, clientY }) => {
    const box = canvas.getBoundingClientRect();
    return { x: clientX - box.left, y: clientY - box.top };
  };

  // The part between two corners; all of an axis along which they are close together.
  const partOf = (chart, a, b) => {
    const all = ends(chart);
    return Object.fromEntries(names.map((name, i) => {
      const [low, high] = [Math.min(a[name], b[name]), Math.max(a[name], b[name])];
      const other = names[1 - i];
      const isFlat = high - low < Math.max(8, 0.08 * Math.abs(a[other] - b[other]));
      return [name, isFlat ? all[name] : [Math.max(low, all[name][0]), Math.min(high, all[name][1])]];
    }));
  };

  const followMouse = (canvas, frame) => {
    let corner = null;
    const isDrag = (place) => corner && Math.hypot(place.x - corner.x, place.y - corner.y) > 8;
    canvas.addEventListener('pointerdown', (event) => {
      if (event.pointerType === 'touch' || event.button !== 0) return;
      corner = placeOf(canvas, event);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      const place = placeOf(canvas, event);
      frame.hidden = !isDrag(place);
      if (frame.hidden) return;
      const { x, y } = partOf(Chart.getChart(canvas), corner, place);
      Object.assign(frame.style, {
        left: `${x[0]}px`, top: `${y[0]}px`, width: `${x[1] - x[0]}px`, height: `${y[1] - y[0]}px`,
      });
    });
    const end = (event) => {
      const place = placeOf(canvas, event);
      if (event.type === 'pointerup' && isDrag(place)) {
        const chart = Chart.getChart(canvas);
        zoomTo(chart, partOf(chart, corner, place));
      }
      corner = null;
      frame.hidden = true;
    };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
    canvas.addEventListener('pointerleave', (event) => { if (event.pointerType === 'mouse' && !corner) canvas.blur(); });
  };

  const followFingers = (canvas) => {
    const fingers = new Map();
    const pinch = () => {
      const [a, b] = [...fingers.values()];
      return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.max(Math.hypot(a.x - b.x, a.y - b.y), 10) };
    };
    canvas.addEventListener('pointerdown', (event) => {
      if (event.pointerType === 'touch') fingers.set(event.pointerId, placeOf(canvas, event));
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!fingers.has(event.pointerId)) return;
      const before = fingers.size === 2 ? pinch() : null;
      fingers.set(event.pointerId, placeOf(canvas, event));
      if (!before) return;
      const after = pinch();
      moveAndScale(Chart.getChart(canvas), before, after, after.size / before.size);
    });
    ['pointerup', 'pointercancel', 'pointerleave'].forEach((type) => canvas.addEventListener(
      type, (event) => fingers.delete(event.pointerId)));
  };

  const prepare = (canvas) => {
    canvas.tabIndex = 0;
    canvas.setAttribute('aria-describedby', 'plot-hint');
    const frame = document.createElement('div');
    frame.className = 'selection';
    frame.hidden = true;
    const whole = document.createElement('button');
    whole.type = 'button';
    whole.className = 'whole';
    whole.textContent = 'Show all';
    whole.hidden = true;
    whole.addEventListener('click', () => showWhole(Chart.getChart(canvas)));
    canvas.after(frame, whole);
    followMouse(canvas, frame);
    followFingers(canvas);
    canvas.addEventListener('keydown', (event) => onKey(canvas, event));
    canvas.addEventListener('dblclick', () => showWhole(Chart.getChart(canvas)));
    canvas.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && document.activeElement !== canvas) return;
      event.preventDefault();
      const place = placeOf(canvas, event);
      moveAndScale(Chart.getChart(canvas), place, place, Math.exp(-Math.max(-100, Math.min(100, event.deltaY)) / 300));
    }, { passive: false });
  };

  dressers.push((chart) => {
    if (!chart.canvas.hasAttribute('tabindex')) prepare(chart.canvas);
    const view = views.get(chart.canvas.id);
    if (!view) return;
    if (view.axes === axesOf(chart)) {
      show(chart, view.shown);
    } else {
      views.delete(chart.canvas.id);  // another field with ranges of its own
      chart.canvas.parentNode.querySelector('.whole').hidden = true;
    }
  });
})();
