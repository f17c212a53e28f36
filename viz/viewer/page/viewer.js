// The page: its state, and the actions of keys, pointers and controls.

class Viewer {
  constructor(scene, context) {
    this.scene = scene;
    this.last = scene.frames.length - 1;
    this.frame = scene.modes ? 0 : this.last;
    this.picked = -1;
    this.hidden = new Set();
    this.phase = 1;  // of a mode that swings
    this.canvas = element("view");
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, context, antialias: true });
    this.renderer.setClearColor(0xf7f7f5, 1);
    this.model = buildModel(scene);
    this.names = new THREE.WebGLRenderTarget(1, 1);
    this.orbit = new OrbitCamera(this.canvas, scene.size, () => this.draw());
    this.tops = new Map(scene.fields.map((f) => [f.name, f.top]));
    this.reach = Math.hypot(...scene.size);
    this.chooseAmplifications();
    this.fillControls();
    this.listen();
    this.resize();
    this.setFrame(this.frame);
  }

  /// Steps of the amplification. The initial one makes the largest displacement a few per cent of the model size.
  chooseAmplifications() {
    if (this.scene.modes) {
      this.steps = [0.25, 0.5, 1, 2, 4, 8, 16].map((percent) => (percent / 100) * this.reach);
      this.step = 4;
      return;
    }
    this.steps = [0, 1];
    for (let ten = 1; ten < 1e5; ten *= 10) this.steps.push(2 * ten, 5 * ten, 10 * ten);
    const field = this.scene.fields.find((f) => f.value < 0);
    const fits = field ? (0.03 * this.reach) / (field.top / field.factor) : 1;
    this.step = 1;
    while (this.step + 1 < this.steps.length && this.steps[this.step + 1] <= fits) ++this.step;
  }

  field() { return this.scene.fields.find((f) => f.name === this.colour); }

  fillControls() {
    const scene = this.scene;
    element("title").textContent = scene.title;
    element("what").textContent = scene.what;
    for (const f of scene.fields) element("colour").append(new Option(f.name, f.name));
    element("colour").append(new Option("component", "component"), new Option("stone", "stone"));
    this.colour = scene.fields.length ? scene.fields[0].name : "component";
    element("amplification").max = this.steps.length - 1;
    element("frame").max = this.last;
    element("bar").hidden = !scene.modes && this.last === 0;
    element("amplification").parentElement.hidden = !scene.fields.some((f) => f.value < 0);
    listComponents(scene, this.hidden, () => this.paint());
  }

  listen() {
    const on = (id, event, act) => element(id).addEventListener(event, act);
    on("colour", "change", (e) => this.setColour(e.target.value));
    on("top", "change", (e) => this.setTop(Number(e.target.value)));
    on("amplification", "input", (e) => this.setStep(Number(e.target.value)));
    on("frame", "input", (e) => this.setFrame(Number(e.target.value)));
    on("play", "click", () => this.play(!this.playing));
    for (const id of ["axis", "place", "other"]) on(id, "input", () => this.cut());
    on("edges", "change", () => this.draw());
    on("helpbutton", "click", () => element("help").showModal());
    on("open", "click", () => {
      const shown = element("panel").classList.toggle("shown");
      element("open").setAttribute("aria-expanded", shown);
      element("open").textContent = shown ? "Close" : "Controls";
    });
    on("views", "click", (e) => e.target.dataset.view && this.orbit.see(e.target.dataset.view));
    window.addEventListener("resize", () => this.resize());
    window.addEventListener("keydown", (e) => this.key(e));
    let from = null;
    on("view", "pointerdown", (e) => { from = e.isPrimary ? [e.clientX, e.clientY] : null; });
    on("view", "pointerup", (e) => {
      if (from && e.button === 0 && Math.hypot(e.clientX - from[0], e.clientY - from[1]) < 6) this.click(e.clientX, e.clientY);
      from = null;
    });
  }

  key(event) {
    if (element("help").open || event.ctrlKey || event.metaKey || event.altKey) return;
    if (/^(INPUT|SELECT)$/.test(event.target.tagName) && event.key !== "Escape") return;
    const shift = event.shiftKey, views = ["front", "side", "plan", "oblique"], colours = element("colour").options;
    const acts = {
      " ": () => this.play(!this.playing),
      ArrowLeft: () => (shift ? this.orbit.turn(-0.1, 0) : this.setFrame(this.frame - 1)),
      ArrowRight: () => (shift ? this.orbit.turn(0.1, 0) : this.setFrame(this.frame + 1)),
      ArrowUp: () => this.orbit.turn(0, 0.1), ArrowDown: () => this.orbit.turn(0, -0.1),
      Home: () => this.setFrame(0), End: () => this.setFrame(this.last),
      PageUp: () => this.orbit.zoom(0.85), PageDown: () => this.orbit.zoom(1 / 0.85),
      "+": () => this.setStep(this.step + 1), "=": () => this.setStep(this.step + 1), "-": () => this.setStep(this.step - 1),
      c: () => this.setColour(colours[(element("colour").selectedIndex + 1) % colours.length].value),
      e: () => { element("edges").checked = !element("edges").checked; this.draw(); },
      h: () => element("help").showModal(), "?": () => element("help").showModal(), Escape: () => this.pick(-1),
    };
    views.forEach((view, k) => { acts[k + 1] = () => this.orbit.see(view); });
    if (event.key === " " && event.target.tagName === "BUTTON") return;  // which it presses
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }

  setFrame(frame) {
    this.frame = Math.max(0, Math.min(this.last, frame));
    element("frame").value = this.frame;
    element("label").textContent = this.scene.frames[this.frame];
    this.model.showFrame(this.frame);
    this.setStep(this.step);
    this.paint();
  }

  setStep(step) {
    this.step = Math.max(0, Math.min(this.steps.length - 1, step));
    element("amplification").value = this.step;
    const value = this.steps[this.step];
    element("amplified").textContent = this.scene.modes ? `largest drawn ${digits(value)} m` : `× ${value}`;
    this.draw();
  }

  setColour(name) {
    this.colour = name;
    this.paint();
  }

  setTop(top) {
    if (this.field() && top > 0) this.tops.set(this.colour, top);
    this.paint();
  }

  /// Colours of all items, the legend and the data of the stone.
  paint() {
    const { scene, frame, hidden } = this, field = this.field(), top = field ? this.tops.get(field.name) : 0;
    const bytes = (css) => [1, 3, 5].map((k) => parseInt(css.slice(k, k + 2), 16));
    const scale = scene.colours.scale.map(bytes), components = scene.colours.components.map(bytes);
    const fixed = bytes(scene.colours.fixed), stone = bytes(scene.colours.stone), picked = bytes(scene.colours.picked);
    const backfill = scene.components.indexOf("backfill");
    const varied = (c, i) => c.map((v) => v * (0.975 + 0.05 * (((i + 1) * 0.6180339887) % 1)));
    this.model.paint((i) => {
      const isStone = i < scene.stones, component = isStone ? scene.kinds[3 * i] : backfill;
      if (hidden.has(component)) return null;
      if (i === this.picked) return picked;
      if (isStone && scene.kinds[3 * i + 2] && this.colour !== "component") return fixed;
      if (field && (isStone || field.value < 0))
        return scale[Math.round(64 * Math.min(1, Math.max(0, fieldValue(scene, field, frame, i) / top)))];
      if (!isStone) return components[backfill];
      return varied(this.colour === "component" ? components[component] : stone, i);
    });
    element("colour").value = this.colour;
    element("toplabel").hidden = !field;
    if (field) element("top").value = Number(top.toPrecision(4)), element("unit").textContent = field.unit;
    showLegend(scene, field, top);
    showStone(scene, frame, this.picked, () => this.pick(-1));
    this.draw();
  }

  cut() {
    const axis = element("axis").value, section = this.model.uniforms.section.value;
    element("cut").hidden = axis === "";
    this.model.insides.visible = axis !== "";
    if (axis === "") section.set(0, 0, 0, 1);
    else {
      const share = element("place").value / 1000 - 0.5, at = share * this.scene.size[axis];
      // The part behind the plane is shown, as seen from the front, side or above.
      const sign = (element("other").checked ? -1 : 1) * (axis === "1" ? -1 : 1);
      section.set(...[0, 1, 2].map((c) => (c === Number(axis) ? sign : 0)), sign * at);
      element("cutplace").textContent = `${"xyz"[axis]} = ${(at + this.scene.origin[axis]).toFixed(2)} m`;
    }
    this.draw();
  }

  play(yes) {
    this.playing = yes;
    this.phase = 1;
    element("play").textContent = yes ? "❚❚" : "▶";
    element("play").setAttribute("aria-label", yes ? "Stop" : "Play");
    if (yes && !this.scene.modes && this.frame === this.last) this.setFrame(0);
    this.began = undefined;
    this.draw();
  }

  /// A mode oscillates once in two seconds. A run plays six frames a second.
  advance(now) {
    if (this.began === undefined) this.began = now, this.shownAt = now;
    if (this.scene.modes) this.phase = Math.cos((Math.PI * (now - this.began)) / 1000);
    else if (now - this.shownAt > 160) {
      this.shownAt = now;
      if (this.frame === this.last) this.play(false);
      else this.setFrame(this.frame + 1);
    }
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.setPixels();
    this.names.setSize(width, height);
    this.orbit.resize(width, height);
  }

  /// Draws in the next frame of the browser, so that several changes need one picture only.
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    const asked = performance.now();
    requestAnimationFrame((now) => {
      this.waiting = false;
      this.keepPace(performance.now() - asked);
      if (this.playing) this.advance(now);
      this.drawNow();
      if (this.playing) this.draw();
    });
  }

  /// If drawing is slow, moving pictures have fewer pixels and no edges until the motion ends.
  keepPace(late) {
    this.lateOnes = late > 60 ? (this.lateOnes || 0) + 1 : 0;
    if (this.lateOnes >= 3) this.setCoarse(true);
    clearTimeout(this.resting);
    if (this.coarse) this.resting = setTimeout(() => this.setCoarse(false), Math.max(500, 4 * late));
  }

  setCoarse(coarse) {
    if (coarse === this.coarse) return;
    this.coarse = coarse;
    this.lateOnes = 0;
    this.setPixels();
    if (!coarse) this.draw();
  }

  setPixels() {
    this.renderer.setPixelRatio(this.coarse ? 0.5 : Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
  }

  drawNow() {
    this.model.uniforms.amplification.value = this.steps[this.step] * this.phase;
    this.model.lines.visible = element("edges").checked && !this.coarse;
    this.renderer.render(this.model.world, this.orbit.camera);
  }

  /// The item visible at a place of the canvas (CSS pixels), −1 for none. A picture with item numbers as colours gives it.
  itemAt(x, y) {
    const { uniforms, lines } = this.model, pixel = new Uint8Array(4);
    uniforms.naming.value = true;
    lines.visible = false;
    this.renderer.setRenderTarget(this.names);
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.renderer.render(this.model.world, this.orbit.camera);
    this.renderer.readRenderTargetPixels(this.names, Math.floor(x), Math.floor(this.names.height - 1 - y), 1, 1, pixel);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(0xf7f7f5, 1);
    uniforms.naming.value = false;
    this.drawNow();
    return pixel[3] === 0 ? -1 : pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }

  click(clientX, clientY) {
    const box = this.canvas.getBoundingClientRect();
    this.pick(this.itemAt(clientX - box.left, clientY - box.top));
  }

  pick(item) {
    this.picked = item;
    this.paint();
  }
}

async function main() {
  const canvas = element("view");
  const context = canvas.getContext("webgl2", { antialias: true });
  if (!context)
    return say("This browser offers no WebGL 2, which the page needs to draw the model. Update the browser, or switch on hardware acceleration in its settings. Pictures by `voussoir render` need neither.");
  if (typeof DecompressionStream === "undefined")
    return say("This browser cannot unpack the numbers of the page (DecompressionStream). Use a recent Chrome, Edge, Firefox or Safari.");
  let scene;
  try {
    scene = await unpacked();
  } catch (error) {
    return say(`The numbers of the page cannot be read. The file may be damaged: ${error.message}`);
  }
  const viewer = new Viewer(scene, context);
  const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  viewer.play(scene.modes && !location.hash && !still);
  obey(viewer, new URLSearchParams(location.hash.slice(1)));
  document.body.dataset.ready = "yes";
}

main();
