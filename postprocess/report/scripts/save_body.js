// Every picture of the body as a PNG file: what is seen, with what it shows, its instant and its colours.
(() => {
  const { bodies, colour, number, withPaperColours, saving } = plots;
  if (!bodies) return;
  const { pictures, paintOn, instant, gradient } = bodies;
  const width = 1600;  // pixels of the file
  const [head, foot] = [30, 30];  // of the page, above and below the body

  const draw = (picture, place) => {
    const [w, h] = [place.clientWidth, place.clientHeight];
    const canvas = Object.assign(document.createElement('canvas'), { width, height: Math.round(width * (h + head + foot) / w) });
    const ctx = canvas.getContext('2d');
    const field = picture.field();
    ctx.scale(width / w, width / w);
    ctx.fillStyle = 'white';
    ctx.fillRect(0, 0, w, h + head + foot);
    ctx.fillStyle = colour('ink');
    ctx.font = '600 13px Helvetica, Arial, sans-serif';
    ctx.fillText(`${picture.title}, t = ${number(instant())} s`, 8, 20, w - 16);
    ctx.save();
    ctx.translate(0, head);
    paintOn(ctx, picture, w, h);
    ctx.restore();
    ctx.font = '12px Helvetica, Arial, sans-serif';
    ctx.fillStyle = colour('ink');
    const name = field.name + (field.unit === '-' ? '' : ` [${field.unit}]`);
    const texts = [name, number(field.low), number(field.high)];
    const lengths = texts.map((text) => ctx.measureText(text).width);
    const [y, left, right] = [head + h + 18, 8 + lengths[0] + 10 + lengths[1] + 8, w - 8 - lengths[2] - 8];
    ctx.fillText(texts[0], 8, y);
    ctx.fillText(texts[1], 8 + lengths[0] + 10, y);
    ctx.fillText(texts[2], right + 8, y);
    ctx.fillStyle = gradient(ctx, left, right);
    ctx.fillRect(left, y - 9, right - left, 10);
    return canvas;
  };

  pictures.forEach((picture) => {
    const place = document.getElementById(`shape-${picture.name}`);
    const save = () => withPaperColours(() => draw(picture, place)).toBlob((blob) => saving.offer(
      blob, saving.fileName(`${picture.title} ${picture.field().name} t ${number(instant())} s`, '.png')), 'image/png');
    place.after(saving.button('Save as PNG', picture.title, save));
  });
})();
