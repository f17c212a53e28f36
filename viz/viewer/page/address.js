// Settings in the address of the page.

/// The address can say what is shown: view.html#view=front&colour=slip&frame=3&amplification=10&hide=parapet&section=y:0.5
/// &click=X,Y,Z (m; the stone that is seen where that point is, may be given several times). measure=N writes how long N
/// pictures take.
function obey(viewer, words) {
  const { scene } = viewer;
  if (words.has("frame")) viewer.setFrame(Number(words.get("frame")));
  if (words.has("colour")) viewer.setColour(words.get("colour"));
  if (words.has("amplification")) viewer.steps[viewer.step] = Number(words.get("amplification")), viewer.setStep(viewer.step);
  for (const name of (words.get("hide") || "").split(",")) {
    const box = [...document.querySelectorAll("#components label")].find((l) => l.textContent.startsWith(name) && name);
    if (box) box.control.click();
  }
  if (words.has("section")) {
    const [axis, at] = words.get("section").split(":"), k = "xyz".indexOf(axis);
    element("axis").value = k;
    element("place").value = 1000 * ((Number(at) - scene.origin[k]) / scene.size[k] + 0.5);
    viewer.cut();
  }
  if (namedViews[words.get("view")]) viewer.orbit.see(words.get("view"));
  viewer.drawNow();
  for (const point of words.getAll("click")) clickAt(viewer, point.split(",").map((v, c) => Number(v) - scene.origin[c]));
  if (words.has("measure")) measure(viewer, Number(words.get("measure")));
}

/// Presses the pointer at the drawn position of a point (m, relative to the origin of the scene). The report gives the item found.
function clickAt(viewer, point) {
  const at = new THREE.Vector3(...point).project(viewer.orbit.camera), box = viewer.canvas.getBoundingClientRect();
  const where = { isPrimary: true, pointerId: 1, button: 0, bubbles: true,
    clientX: box.left + ((at.x + 1) / 2) * box.width, clientY: box.top + ((1 - at.y) / 2) * box.height };
  for (const event of ["pointerdown", "pointerup"]) viewer.canvas.dispatchEvent(new PointerEvent(event, where));
  element("report").textContent += viewer.picked < 0 ? "nothing; " : `${document.querySelector("#stone h2").textContent}; `;
}

/// Pictures of one frame after the other, each waited for.
function measure(viewer, count) {
  const pixel = new Uint8Array(4), gl = viewer.renderer.getContext(), began = Date.now();
  for (let k = 0; k < count; ++k) {
    viewer.setFrame(k % (viewer.last + 1));
    viewer.drawNow();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  }
  element("report").textContent += `${count} pictures in ${Date.now() - began} ms`;
}
