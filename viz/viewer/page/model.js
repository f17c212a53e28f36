// The stones and the fill on the graphics card.

const texelsAcross = 512;

/// A texture with a texel of four numbers for each item.
function itemTexture(items, type) {
  const rows = Math.max(1, Math.ceil(items / texelsAcross));
  const numbers = new (type === THREE.FloatType ? Float32Array : Uint8Array)(4 * texelsAcross * rows);
  const texture = new THREE.DataTexture(numbers, texelsAcross, rows, THREE.RGBAFormat, type);
  texture.magFilter = texture.minFilter = THREE.NearestFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}

/// Vertices of all stones and of the fill, with triangles and lines that share them.
function vertices(scene) {
  const corners = scene.corners.length / 3, count = corners + scene.fill_nodes.length / 3;
  const position = new Float32Array(3 * count), item = new Float32Array(count);
  const triangles = new Uint32Array(scene.triangles.length + scene.fill_triangles.length);
  const edges = new Uint32Array(scene.edges.length + scene.fill_edges.length);
  let first = 0, t = 0, e = 0;
  for (let s = 0; s < scene.stones; ++s) {
    const [own, ownTriangles, ownEdges] = scene.counts.subarray(3 * s, 3 * s + 3);
    for (let v = 3 * first; v < 3 * (first + own); ++v) position[v] = (scene.corners[v] / 32767) * scene.sizes[s];
    item.fill(s, first, first + own);
    for (const end = t + 3 * ownTriangles; t < end; ++t) triangles[t] = first + scene.triangles[t];
    for (const end = e + 2 * ownEdges; e < end; ++e) edges[e] = first + scene.edges[e];
    first += own;
  }
  // A node of the fill is an item of its own at its centre.
  for (let n = 0; first + n < count; ++n) item[first + n] = scene.stones + n;
  for (let k = 0; k < scene.fill_triangles.length; ++k) triangles[t + k] = first + scene.fill_triangles[k];
  for (let k = 0; k < scene.fill_edges.length; ++k) edges[e + k] = first + scene.fill_edges[k];
  return { position, item, triangles, edges };
}

function geometry(v, index) {
  const g = new THREE.BufferGeometry();
  g.setAttribute("position", new THREE.BufferAttribute(v.position, 3));
  g.setAttribute("item", new THREE.BufferAttribute(v.item, 1));
  g.setIndex(new THREE.BufferAttribute(index, 1));
  return g;
}

/// Everything that is drawn: { world, uniforms, lines, insides, showFrame, paint }.
function buildModel(scene) {
  const textures = {
    centres: itemTexture(scene.items, THREE.FloatType),
    moves: itemTexture(scene.items, THREE.FloatType),
    turns: itemTexture(scene.items, THREE.FloatType),
    colours: itemTexture(scene.items, THREE.UnsignedByteType),
  };
  const centres = textures.centres.image.data;
  for (let i = 0; i < scene.items; ++i)
    for (let c = 0; c < 3; ++c)
      centres[4 * i + c] = i < scene.stones ? scene.centres[3 * i + c] : scene.fill_nodes[3 * (i - scene.stones) + c];
  const uniforms = {
    texels: { value: new THREE.Vector2(texelsAcross, textures.centres.image.height) },
    amplification: { value: 1 },
    small: { value: scene.modes },
    naming: { value: false },
    section: { value: new THREE.Vector4(0, 0, 0, 1) },
    ink: { value: new THREE.Color(scene.colours.outline) },
  };
  for (const name of Object.keys(textures)) uniforms[name] = { value: textures[name] };
  const material = (lines, inside, options) =>
    new THREE.ShaderMaterial(Object.assign({
      vertexShader, fragmentShader,
      uniforms: Object.assign({ lines: { value: lines }, inside: { value: inside }, nearer: { value: lines ? 2e-5 : 0 } }, uniforms),
    }, options));
  const v = vertices(scene);
  const world = new THREE.Scene();
  const shape = geometry(v, v.triangles);
  const faces = new THREE.Mesh(shape, material(false, false));
  // The inside of stones that a section cuts. Where it coincides with the face of a neighbour, the inside is visible.
  const insides = new THREE.Mesh(shape, material(false, true, {
    side: THREE.BackSide, polygonOffset: true, polygonOffsetFactor: 0, polygonOffsetUnits: -100 }));
  insides.visible = false;
  const lines = new THREE.LineSegments(geometry(v, v.edges), material(true, false));
  for (const object of [faces, insides, lines]) {
    object.frustumCulled = false;  // three.js does not know where the shader puts the stones
    world.add(object);
  }
  const showFrame = (frame) => {
    const moves = textures.moves.image.data, turns = textures.turns.image.data;
    for (let i = 0; i < scene.items; ++i)
      for (let c = 0; c < 3; ++c) {
        moves[4 * i + c] = valueIn(scene.motion, frame, i, c);
        turns[4 * i + c] = valueIn(scene.motion, frame, i, 3 + c);
      }
    textures.moves.needsUpdate = textures.turns.needsUpdate = true;
  };
  /// `colourOf(item)` gives [red, green, blue] of 0 to 255, null for what is hidden.
  const paint = (colourOf) => {
    const data = textures.colours.image.data;
    for (let i = 0; i < scene.items; ++i) {
      const colour = colourOf(i);
      data[4 * i + 3] = colour ? 255 : 0;
      if (colour) data.set(colour, 4 * i);
    }
    textures.colours.needsUpdate = true;
  };
  return { world, uniforms, lines, insides, showFrame, paint };
}

/// Where the centre of an item is drawn (metres about the scene's origin).
function drawnPlace(scene, frame, item, amplification) {
  return [0, 1, 2].map((c) => {
    const at = item < scene.stones ? scene.centres[3 * item + c] : scene.fill_nodes[3 * (item - scene.stones) + c];
    return at + amplification * valueIn(scene.motion, frame, item, c);
  });
}
