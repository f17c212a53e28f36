// The elements around the picture: controls, legend and the data of a stone.

const element = (id) => document.getElementById(id);

function make(tag, text, kind) {
  const node = document.createElement(tag);
  if (text !== undefined) node.textContent = text;
  if (kind) node.className = kind;
  return node;
}

/// Three significant digits, without an exponent if the number is readable without one.
function digits(value) {
  if (!Number.isFinite(value)) return "none";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-4 || size >= 1e7) return value.toExponential(1).replace("-", "−");
  return value.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(size))))).replace("-", "−");
}

const withUnit = (value, unit) => (unit ? `${digits(value)} ${unit}` : digits(value));

function tableOf(rows, heads) {
  const table = make("table");
  for (const [tag, cells] of [...(heads ? [["th", heads]] : []), ...rows.map((r) => ["td", r])]) {
    const row = table.appendChild(make("tr"));
    cells.forEach((cell, k) => row.appendChild(make(tag, cell, k > 0 ? "number" : "")));
  }
  return table;
}

/// "block 812 (spandrel, part 0)".
function nameOf(scene, item) {
  if (item >= scene.stones) return "the fill";
  return `block ${item} (${scene.components[scene.kinds[3 * item]]}, part ${scene.kinds[3 * item + 1]})`;
}

/// The value of a field at an item, in the field's unit.
function fieldValue(scene, field, frame, item) {
  if (field.value >= 0) return field.factor * valueIn(scene.values, frame, item, field.value);
  return field.factor * Math.hypot(...[0, 1, 2].map((c) => valueIn(scene.motion, frame, item, c)));
}

/// The frame whose forces are known: the same frame, or the last one if the page contains only its forces.
const kept = (scene, frame) => (scene.forces.frames === 1 ? 0 : frame);

/// Pairs with this stone, those with the largest forces first: { other, normal, shear, opening }.
function pairsOf(scene, frame, stone) {
  const found = [];
  const wanted = stone < scene.stones ? stone : 0xffffffff;
  for (let p = 0; 2 * p < scene.pairs.length; ++p) {
    const a = scene.pairs[2 * p], b = scene.pairs[2 * p + 1];
    if (a !== wanted && b !== wanted) continue;
    const [normal, shear, opening] = [0, 1, 2].map((c) => valueIn(scene.forces, kept(scene, frame), p, c));
    found.push({ other: a === wanted ? b : a, normal, shear, opening });
  }
  return found.sort((x, y) => Math.hypot(y.normal, y.shear) - Math.hypot(x.normal, x.shear));
}

function stoneRows(scene, frame, item) {
  const u = [0, 1, 2].map((c) => valueIn(scene.motion, frame, item, c));
  const turn = Math.hypot(...[3, 4, 5].map((c) => valueIn(scene.motion, frame, item, c)));
  const rows = [];
  if (scene.modes) {
    rows.push(["x, y, z (divided by the largest)", u.map(digits).join(", ")]);
    return rows;
  }
  if (scene.fields.some((f) => f.value < 0)) {
    rows.push(["displacement x, y, z, mm", u.map((v) => digits(1e3 * v)).join(", ")]);
    if (item < scene.stones) rows.push(["rotation", withUnit((turn * 180) / Math.PI, "°")]);
  }
  if (item < scene.stones)
    for (const field of scene.fields.filter((f) => f.value >= 0))
      rows.push([`largest ${field.name}`, withUnit(fieldValue(scene, field, frame, item), field.unit)]);
  return rows;
}

function showStone(scene, frame, item, close) {
  const box = element("stone");
  box.hidden = item < 0;
  document.body.classList.toggle("asked", item >= 0);
  box.replaceChildren();
  if (item < 0) return;
  const button = make("button", "×", "close");
  button.setAttribute("aria-label", "Close");
  button.addEventListener("click", close);
  const fixed = item < scene.stones && scene.kinds[3 * item + 2] ? ", moves with the ground" : "";
  box.append(button, make("h2", nameOf(scene, item) + fixed), tableOf(stoneRows(scene, frame, item)));
  if (!scene.bears) return;
  if (scene.forces.frames < scene.frames.length && frame + 1 < scene.frames.length)
    box.append(make("p", `Forces at the last frame, ${scene.frames[scene.frames.length - 1]}:`));
  const pairs = pairsOf(scene, frame, item), most = 12;
  box.append(tableOf(
    pairs.slice(0, most).map((p) => [
      p.other < scene.stones ? `${p.other} ${scene.components[scene.kinds[3 * p.other]]}` : "the fill",
      digits(p.normal / 1e3), digits(p.shear / 1e3), digits(p.opening * 1e3)]),
    ["joint with", "normal, kN", "shear, kN", "opening, mm"]));
  if (pairs.length > most) box.append(make("p", `and ${pairs.length - most} more with smaller forces`));
}

/// How many parts give a scale from 0 to `top` round numbers.
function roundParts(top) {
  const leading = Number((top / 10 ** Math.floor(Math.log10(top) + 1e-9)).toPrecision(6));
  if ([1.5, 3, 6].includes(leading)) return 3;
  return [1.2, 2, 4, 8].includes(leading) ? 4 : 5;
}

function showLegend(scene, field, top) {
  const legend = element("legend");
  legend.hidden = !field;
  legend.replaceChildren();
  if (!field) return;
  legend.append(make("div", field.unit ? `${field.title}, ${field.unit}` : field.title));
  const bar = legend.appendChild(make("div", "", "scale"));
  bar.style.background = `linear-gradient(to right, ${scene.colours.scale.join(", ")})`;
  const ticks = legend.appendChild(make("div", "", "ticks"));
  const parts = roundParts(top);
  for (let k = 0; k <= parts; ++k) ticks.append(make("span", String(Number(((top * k) / parts).toPrecision(4)))));
}

function listComponents(scene, hidden, changed) {
  const counts = new Map();
  for (let s = 0; s < scene.stones; ++s) counts.set(scene.kinds[3 * s], (counts.get(scene.kinds[3 * s]) || 0) + 1);
  const backfill = scene.components.indexOf("backfill");
  if (scene.items > scene.stones && !counts.has(backfill)) counts.set(backfill, 0);
  for (const [component, count] of [...counts].sort((a, b) => a[0] - b[0])) {
    const label = make("label", undefined, "check"), box = make("input"), swatch = make("span", "", "swatch");
    box.type = "checkbox";
    box.checked = !hidden.has(component);
    box.addEventListener("change", () => {
      if (box.checked) hidden.delete(component);
      else hidden.add(component);
      changed();
    });
    swatch.style.background = scene.colours.components[component];
    label.append(box, swatch, scene.components[component], make("span", count ? String(count) : "mesh", "count"));
    element("components").append(label);
  }
}

function say(words) {
  element("message").textContent = words;
  element("message").hidden = false;
}
