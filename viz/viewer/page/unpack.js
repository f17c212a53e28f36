// The numbers of the page: base64, deflate, sections, series of differences (viz/viewer/viewer_pack.h).

async function inflated(text) {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/// Function that gives a section by its name.
function reader(buffer, sections) {
  const kinds = { u4: Uint32Array, f4: Float32Array, i2: Int16Array, series: Uint8Array };
  return (name) => new kinds[sections[name].type](buffer, sections[name].offset, sections[name].count);
}

/// A series as { items, groups, width, frames, steps, scale, shares }: shares holds column by column, frame by frame,
/// item by item how many of the steps up to the scale a value is.
function series(read, sections, name) {
  const { items, groups, width, frames, steps } = sections[name];
  const bytes = read(name);
  const all = items * groups * width * frames;
  const shares = new Int16Array(all);
  let at = 0;
  for (let column = 0; column < groups * width; ++column)
    for (let frame = 0; frame < frames; ++frame)
      for (let item = 0; item < items; ++item, ++at) {
        const code = bytes[at] | (bytes[all + at] << 8);
        const difference = (code >>> 1) ^ -(code & 1);
        shares[at] = difference + (frame > 0 ? shares[at - items] : 0);
      }
  return { items, groups, width, frames, steps, scale: read(name + "_scale"), shares };
}

function valueIn(s, frame, item, column) {
  const share = s.shares[(column * s.frames + frame) * s.items + item];
  return (share / s.steps) * s.scale[item * s.groups + Math.floor(column / s.width)];
}

async function unpacked() {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const read = reader(await inflated(document.getElementById("numbers").textContent), scene.sections);
  for (const name of ["motion", "values", "forces"]) scene[name] = series(read, scene.sections, name);
  for (const name of ["centres", "sizes", "corners", "counts", "triangles", "edges", "kinds", "pairs"])
    scene[name] = read(name);
  for (const name of ["fill_nodes", "fill_triangles", "fill_edges"]) scene[name] = read(name);
  scene.stones = scene.sizes.length;
  scene.items = scene.motion.items;  // stones, then the nodes of the fill
  return scene;
}
