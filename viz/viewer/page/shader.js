// Stones move in the vertex shader: each vertex knows its item (a stone, or a node of the fill), whose place,
// displacement, rotation vector and colour are texels. x' = x + a (u + R (x - c) - (x - c)), as voussoir render draws it;
// of a mode R (x - c) - (x - c) is the rotation vector times (x - c).

const vertexShader = `
attribute float item;
uniform sampler2D centres, moves, turns, colours;
uniform vec2 texels;
uniform float amplification, nearer;
uniform bool small, naming;
varying vec3 place;
varying vec4 colour;

vec3 turned(vec3 p, vec3 r) {
  float angle = length(r);
  if (small || angle < 1e-7) return cross(r, p);
  vec3 axis = r / angle;
  float half_sine = sin(0.5 * angle);
  return sin(angle) * cross(axis, p) + 2.0 * half_sine * half_sine * cross(axis, cross(axis, p));
}

void main() {
  vec2 at = (vec2(mod(item, texels.x), floor(item / texels.x)) + 0.5) / texels;
  colour = texture2D(colours, at);
  place = texture2D(centres, at).xyz + position +
          amplification * (texture2D(moves, at).xyz + turned(position, texture2D(turns, at).xyz));
  gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
  gl_Position.z -= nearer * gl_Position.w;
  if (colour.a < 0.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // hidden
  if (naming) {
    float name = item + 1.0;
    colour = vec4(mod(name, 256.0), mod(floor(name / 256.0), 256.0), floor(name / 65536.0), 255.0) / 255.0;
  }
}`;

// The inside of cut stones is drawn in one colour, so that they look solid.
const fragmentShader = `
uniform vec4 section;
uniform bool naming, lines, inside;
uniform vec3 ink;
varying vec3 place;
varying vec4 colour;

void main() {
  if (dot(section.xyz, place) > section.w) discard;
  if (naming) {
    gl_FragColor = colour;
  } else if (lines) {
    gl_FragColor = vec4(mix(colour.rgb, ink, 0.6), 1.0);
  } else if (!inside) {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    float light = 0.72 + 0.20 * normal.z + 0.08 * dot(normal, normalize(vec3(0.4, -0.9, 0.1)));
    gl_FragColor = vec4(colour.rgb * min(1.0, light + 0.08), 1.0);
  } else {
    gl_FragColor = vec4(colour.rgb * 0.78, 1.0);
  }
}`;
