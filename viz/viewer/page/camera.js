// A camera that goes around a point with z up: drag turns, a second finger or the right button shifts, wheel and pinch
// zoom.

const namedViews = { front: [-90, 0], side: [0, 0], plan: [-90, 89.9], oblique: [-60, 25] };  // degrees

class OrbitCamera {
  constructor(canvas, size, changed) {
    this.canvas = canvas;
    this.size = size;
    this.changed = changed;
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.1, 1000);
    this.camera.up.set(0, 0, 1);
    this.pointers = new Map();
    this.see("oblique");
    canvas.addEventListener("pointerdown", (e) => this.down(e));
    canvas.addEventListener("pointermove", (e) => this.move(e));
    for (const end of ["pointerup", "pointercancel"])
      canvas.addEventListener(end, (e) => this.pointers.delete(e.pointerId));
    canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.zoom(Math.exp(0.0012 * Math.max(-300, Math.min(300, e.deltaY * (e.deltaMode === 1 ? 30 : 1)))));
    }, { passive: false });
  }

  see(name) {
    [this.azimuth, this.elevation] = namedViews[name].map((d) => (d * Math.PI) / 180);
    this.target = new THREE.Vector3(0, 0, 0);
    this.fit();
  }

  /// Moves the camera to a distance at which the picture contains the box of the scene.
  fit() {
    this.distance = 1;
    this.place();
    const toEye = this.camera.matrixWorldInverse, tangent = Math.tan((this.camera.fov * Math.PI) / 360);
    let far = 0.1;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new THREE.Vector3(...this.size.map((s, c) => ((corner >> c) & 1 ? 0.5 : -0.5) * s)).applyMatrix4(toEye);
      const half = Math.max(Math.abs(p.y) / tangent, Math.abs(p.x) / (tangent * this.camera.aspect));
      far = Math.max(far, p.z + this.distance + 1.08 * half);
    }
    this.distance = far;
    this.place();
  }

  place() {
    const flat = Math.cos(this.elevation);
    const back = new THREE.Vector3(flat * Math.cos(this.azimuth), flat * Math.sin(this.azimuth), Math.sin(this.elevation));
    this.camera.position.copy(this.target).addScaledVector(back, this.distance);
    this.camera.lookAt(this.target);
    const reach = Math.hypot(...this.size);
    this.camera.near = Math.max(0.01 * this.distance, this.distance - 1.5 * reach);
    this.camera.far = this.distance + 3 * reach;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.changed();
  }

  resize(width, height) {
    this.camera.aspect = width / height;
    this.fit();
  }

  turn(right, up) {
    this.azimuth -= right;
    this.elevation = Math.max(-1.569, Math.min(1.569, this.elevation + up));
    this.place();
  }

  zoom(factor) {
    const reach = Math.hypot(...this.size);
    this.distance = Math.max(0.01 * reach, Math.min(20 * reach, this.distance * factor));
    this.place();
  }

  /// By pixels of the picture.
  shift(x, y) {
    const perPixel = (2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
    const e = this.camera.matrixWorld.elements;
    this.target.addScaledVector(new THREE.Vector3(e[0], e[1], e[2]), -x * perPixel);
    this.target.addScaledVector(new THREE.Vector3(e[4], e[5], e[6]), y * perPixel);
    this.place();
  }

  down(event) {
    try { this.canvas.setPointerCapture(event.pointerId); } catch (none) { /* a pointer made by a script */ }
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY], x = now[0] - before[0], y = now[1] - before[1];
    if (this.pointers.size === 2) {
      const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const apart = (p) => Math.max(10, Math.hypot(p[0] - other[0], p[1] - other[1]));
      this.zoom(apart(before) / apart(now));
      this.shift(x / 2, y / 2);
    } else if (event.buttons === 2 || event.shiftKey) {
      this.shift(x, y);
    } else {
      this.turn(0.006 * x, 0.006 * y);
    }
    this.pointers.set(event.pointerId, now);
  }
}
