// The deformed bodies: surfaces projected along the line of sight and painted from back to front.
(() => {
  const { study, canvas, number } = plots;
  const { shapes } = study;
  if (!shapes) return;

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const words = (text) => new Uint16Array(bytes(text).buffer);  // low byte first, as every browser's machine
  const onRange = ({ low, high }, word) => low + (high - low) * (word / 65535);
  const stops = [[62, 40, 128], [54, 94, 154], [36, 143, 141], [104, 190, 99], [250, 231, 85]];  // dark to light
  const shade = (part, light) => {
    const at = part * (stops.length - 1);
    const k = Math.min(Math.floor(at), stops.length - 2);
    return `rgb(${stops[k].map((c, i) => Math.round(light * (c + (stops[k + 1][i] - c) * (at - k)))).join()})`;
  };

  const { dimension, points } = shapes;
  const faces = words(shapes.faces);
  const n_faces = faces.length / 4;
  const methods = study.methods.flatMap(({ name, title }) => shapes.methods.filter((m) => m.name === name)
    .map((m) => ({ name, title, x: words(m.positions), values: m.values.map(words) })));
  const difference = shapes.difference && words(shapes.difference.values);
  const solid = dimension === 3;
  const view = { frame: 0, yaw: solid ? -0.6 : 0, pitch: solid ? 0.4 : 0 };
  const chosen = () => Number(document.querySelector('input[name="shape-field"]:checked').value);

  // One picture of each method, then that of the difference, on the shape of the first.
  const pictures = methods.map((method) => ({
    name: method.name, title: method.title, method, field: () => shapes.fields[chosen()], values: () => method.values[chosen()],
  }));
  if (difference) {
    pictures.push({
      name: 'difference', title: `${methods[0].title} − ${methods[1].title}`, method: methods[0],
      field: () => shapes.difference, values: () => difference,
    });
  }
  const part = (name, kind) => document.querySelector(`.${kind}[data-shape="${CSS.escape(name)}"]`);

  // The axis that points up is the last one; the eye looks along -y, turned by yaw and pitch.
  const turned = (x, y, z) => {
    if (!solid) return [x, y, 0];
    const [c, s] = [Math.cos(view.yaw), Math.sin(view.yaw)];
    const [across, away] = [c * x - s * y, s * x + c * y];
    const [cp, sp] = [Math.cos(view.pitch), Math.sin(view.pitch)];
    return [across, cp * z + sp * away, cp * away - sp * z];
  };

  // Ends of the box around all shapes at all times, in 16-bit units.
  const box = (() => {
    const ends = Array.from({ length: 3 }, () => [0, 0]);
    for (let i = 0; i < dimension; i += 1) {
      ends[i] = [65535, 0];
      methods.forEach(({ x }) => {
        for (let k = i; k < x.length; k += dimension) {
          ends[i] = [Math.min(ends[i][0], x[k]), Math.max(ends[i][1], x[k])];
        }
      });
    }
    return ends;
  })();
  const middle = box.map(([low, high]) => (low + high) / 2);

  // Pixels for a unit so that the box fits, whatever the view.
  const scaleFor = (width, height) => {
    let [across, up] = [1, 1];
    for (let corner = 0; corner < 8; corner += 1) {
      const [x, y] = turned(...box.map((ends, i) => ends[(corner >> i) & 1] - middle[i]));
      across = Math.max(across, Math.abs(x));
      up = Math.max(up, Math.abs(y));
    }
    return Math.min((width - 16) / (2 * across), (height - 16) / (2 * up));
  };

  // Screen positions [points][3] (third: depth) of a method at the frame that is shown.
  const projected = (method, width, height) => {
    const scale = scaleFor(width, height);
    const screen = new Float32Array(3 * points);
    const start = view.frame * points * dimension;
    for (let p = 0; p < points; p += 1) {
      const at = start + p * dimension;
      const [x, y, depth] = turned(method.x[at] - middle[0], method.x[at + 1] - middle[1],
        solid ? method.x[at + 2] - middle[2] : 0);
      screen.set([width / 2 + scale * x, height / 2 - scale * y, depth], 3 * p);
    }
    return screen;
  };

  const corners = (face) => faces.subarray(4 * face, 4 * face + 4);
  const mean = (face, of) => {
    let sum = 0;
    corners(face).forEach((p) => { sum += of(p); });
    return sum / 4;
  };

  // Share of light that a face turned towards the eye gets: 1 where it looks at it.
  const light = (screen, [a, b, c, d], scale) => {
    if (!solid) return 1;
    const edge = (p, q) => [0, 1, 2].map((i) => (screen[3 * q + i] - screen[3 * p + i]) * (i === 2 ? scale : 1));
    const [u, v] = [edge(a, c), edge(b, d)];
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    return 0.55 + 0.45 * Math.abs(n[2]) / (Math.hypot(...n) || 1);
  };

  // @return places of the points, and the faces from back to front
  const paintOn = (ctx, picture, width, height) => {
    const screen = projected(picture.method, width, height);
    const scale = scaleFor(width, height);
    const depth = Float32Array.from({ length: n_faces }, (_, f) => mean(f, (p) => screen[3 * p + 2]));
    const order = Uint32Array.from(depth.keys());
    if (solid) order.sort((f, g) => depth[g] - depth[f]);
    const values = picture.values();
    const start = view.frame * points;
    ctx.lineJoin = 'round';
    ctx.lineWidth = 0.6;
    order.forEach((f) => {
      const nodes = corners(f);
      ctx.beginPath();
      nodes.forEach((p, i) => ctx[i ? 'lineTo' : 'moveTo'](screen[3 * p], screen[3 * p + 1]));
      ctx.closePath();
      ctx.fillStyle = shade(mean(f, (p) => values[start + p]) / 65535, light(screen, nodes, scale));
      ctx.strokeStyle = ctx.fillStyle;  // closes the seams between faces
      ctx.fill();
      ctx.stroke();
    });
    return { screen, order };
  };

  const paint = (picture) => {
    const place = canvas(`shape-${picture.name}`);
    const [width, height] = [place.clientWidth, place.clientHeight];
    const ratio = Math.min(devicePixelRatio || 1, 2);
    place.width = width * ratio;
    place.height = height * ratio;
    const ctx = place.getContext('2d');
    ctx.scale(ratio, ratio);
    Object.assign(picture, paintOn(ctx, picture, width, height));
  };

  const writeScale = (picture) => {
    const field = picture.field();
    const bar = document.createElement('span');
    bar.className = 'bar';
    bar.style.background = `linear-gradient(90deg, ${stops.map((c) => `rgb(${c.join()})`).join()})`;
    const text = (value) => Object.assign(document.createElement('span'), { textContent: number(value) });
    const unit = field.unit === '-' ? '' : ` [${field.unit}]`;
    const name = Object.assign(document.createElement('span'), { className: 'name', textContent: field.name + unit });
    part(picture.name, 'scale').replaceChildren(name, text(field.low), bar, text(field.high));
  };

  const slider = canvas('shape-frame');
  slider.max = shapes.times.length - 1;
  const paintAll = () => {
    canvas('shape-time').textContent = `t = ${number(shapes.times[view.frame])} s`;
    pictures.forEach((picture) => {
      paint(picture);
      writeScale(picture);
      part(picture.name, 'reading').textContent = '';
    });
  };
  let waiting = false;  // many events, one painting for each refresh of the screen
  const repaint = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; paintAll(); });
  };

  const isInside = (screen, nodes, x, y) => {
    let inside = false;
    nodes.forEach((p, i) => {
      const q = nodes[(i + 3) % 4];
      const [px, py, qx, qy] = [screen[3 * p], screen[3 * p + 1], screen[3 * q], screen[3 * q + 1]];
      if ((py > y) !== (qy > y) && x < px + ((qx - px) * (y - py)) / (qy - py)) inside = !inside;
    });
    return inside;
  };
  // The face in front at a place of a picture.
  const faceAt = ({ screen, order }, x, y) => {
    for (let k = order.length - 1; k >= 0; k -= 1) {
      if (isInside(screen, corners(order[k]), x, y)) return order[k];
    }
    return -1;
  };

  const at = (field, values, face) => {
    const value = onRange(field, mean(face, (p) => values[view.frame * points + p]));
    return `${number(value)}${field.unit === '-' ? '' : ` ${field.unit}`}`;
  };
  const read = (picture, event) => {
    const face = faceAt(picture, event.offsetX, event.offsetY);
    let text = '';
    if (face >= 0) {
      const field = shapes.fields[chosen()];
      const all = methods.map((m) => `${m.title} ${at(field, m.values[chosen()], face)}`);
      text = `${field.name}: ${all.join(', ')}`;
      if (difference) text += `; apart ${at(shapes.difference, difference, face)}`;
    }
    part(picture.name, 'reading').textContent = text;
  };

  const listen = (picture) => {
    const place = canvas(`shape-${picture.name}`);
    let drag = null;  // where the pointer was last while it turns the body
    place.addEventListener('pointerdown', (event) => {
      if (!solid) return;
      drag = { x: event.clientX, y: event.clientY };
      place.setPointerCapture(event.pointerId);
    });
    place.addEventListener('pointermove', (event) => {
      if (!drag) { read(picture, event); return; }
      view.yaw += 0.01 * (event.clientX - drag.x);
      view.pitch = Math.max(-1.57, Math.min(1.57, view.pitch + 0.01 * (event.clientY - drag.y)));
      drag = { x: event.clientX, y: event.clientY };
      repaint();
    });
    ['pointerup', 'pointercancel'].forEach((end) => place.addEventListener(end, () => { drag = null; }));
    place.addEventListener('pointerleave', () => { part(picture.name, 'reading').textContent = ''; });
  };
  pictures.forEach(listen);

  const show = (frame) => {
    view.frame = frame;
    slider.value = frame;
    repaint();
  };
  const button = canvas('shape-play');
  let timer = 0;
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    button.textContent = 'Play';
  };
  button.addEventListener('click', () => {
    if (timer) { stop(); return; }
    button.textContent = 'Stop';
    timer = setInterval(() => show((view.frame + 1) % shapes.times.length), 4000 / Math.min(shapes.times.length, 100));
  });
  slider.addEventListener('input', () => { stop(); show(Number(slider.value)); });
  addEventListener('resize', repaint);
  show(shapes.times.length - 1);
  plots.painters.push(paintAll);

  // What scripts/save_body.js draws with.
  const gradient = (ctx, from, to) => {
    const paint = ctx.createLinearGradient(from, 0, to, 0);
    stops.forEach((c, i) => paint.addColorStop(i / (stops.length - 1), `rgb(${c.join()})`));
    return paint;
  };
  plots.bodies = { pictures, paintOn, gradient, instant: () => shapes.times[view.frame] };
})();
