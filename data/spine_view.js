// Turns a spine with its planned and placed screws. Plain WebGL: nothing is loaded.
"use strict";
(() => {
  const scene = JSON.parse(document.getElementById("spine-data").textContent);
  const canvas = document.getElementById("spine");
  const note = document.getElementById("spine-note");
  const gl = canvas.getContext("webgl", {alpha: false, antialias: true, preserveDrawingBuffer: true});
  if (!gl) {
    note.textContent = "This browser has no WebGL: what would turn here is not shown.";
    return;
  }
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;

  // Normals of a mesh: the sum of its faces', each as large as the face.
  const with_normals = (places, faces) => {
    const normals = new Float32Array(places.length);
    for (let f = 0; f < faces.length; f += 3) {
      const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
      const u = [0, 1, 2].map((i) => places[b + i] - places[a + i]);
      const v = [0, 1, 2].map((i) => places[c + i] - places[a + i]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const corner of [a, b, c]) {
        for (let i = 0; i < 3; ++i) normals[corner + i] += n[i];
      }
    }
    return {places, normals, faces};
  };

  const bone_of = (bone) => {
    const places = Float32Array.from(new Int16Array(bytes(bone.places)), (v) => v * 0.01);
    return with_normals(places, new Uint16Array(bytes(bone.faces)));
  };

  // A cylinder with flat ends: [x, y, z, x, y, z, radius], mm.
  const cylinder_of = (c) => {
    const along = [c[3] - c[0], c[4] - c[1], c[5] - c[2]];
    const length = Math.hypot(...along);
    const d = along.map((v) => v / length);
    const aside = Math.abs(d[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const u = cross(d, aside);
    const size = Math.hypot(...u);
    const p = u.map((v) => v / size);
    const q = cross(d, p);
    const places = [];
    const faces = [];
    const sides = 32;
    const ring = (end, radius) => {
      for (let k = 0; k < sides; ++k) {
        const [cos, sin] = [Math.cos((2 * Math.PI * k) / sides), Math.sin((2 * Math.PI * k) / sides)];
        for (let i = 0; i < 3; ++i) places.push(c[3 * end + i] + radius * (cos * p[i] + sin * q[i]));
      }
    };
    // Rings: a cap's middle, the cap, the side from end to end, the other cap.
    [[0, 0], [0, c[6]], [0, c[6]], [1, c[6]], [1, c[6]], [1, 0]].forEach(([end, r]) => ring(end, r));
    for (const r of [0, 2, 4]) {
      for (let k = 0; k < sides; ++k) {
        const n = (k + 1) % sides;
        const [a, b] = [r * sides + k, r * sides + n];
        faces.push(a, b, a + sides, b, b + sides, a + sides);
      }
    }
    return with_normals(Float32Array.from(places), Uint16Array.from(faces));
  };

  const shader = (kind, text) => {
    const out = gl.createShader(kind);
    gl.shaderSource(out, text);
    gl.compileShader(out);
    if (!gl.getShaderParameter(out, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(out));
    return out;
  };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `
    attribute vec3 place, normal; uniform mat3 turn; uniform vec2 scale;
    varying vec3 n;
    void main() { vec3 v = turn * place; n = turn * normal;
      gl_Position = vec4(v.xy * scale, -v.z / 400.0, 1.0); }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `
    precision mediump float; varying vec3 n; uniform vec4 colour;
    void main() { float light = 0.35 + 0.65 * abs(normalize(n).z);
      gl_FragColor = vec4(colour.rgb * light, colour.a); }`));
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const buffer = (target, data) => {
    const out = gl.createBuffer();
    gl.bindBuffer(target, out);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return out;
  };
  const uploaded = (mesh) => ({
    places: buffer(gl.ARRAY_BUFFER, mesh.places), normals: buffer(gl.ARRAY_BUFFER, mesh.normals),
    faces: buffer(gl.ELEMENT_ARRAY_BUFFER, mesh.faces), count: mesh.faces.length});
  const bones = scene.bones.map((bone) => uploaded(bone_of(bone)));
  const planned = scene.planned.map((c) => uploaded(cylinder_of(c)));
  const placed = scene.placed.map((c) => uploaded(cylinder_of(c)));

  const view = {yaw: 0, pitch: 0, zoom: 1, bone: 0.35};
  const turn = () => {
    // From behind at first: right is the patient's right, up is cranial (LPS: -x, z, +y to the viewer).
    const [cy, sy, cp, sp] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
    const right = [-cy, sy, 0];
    const toward = [sy * cp, cy * cp, sp];
    const up = [-sy * sp, -cy * sp, cp];
    return [right[0], up[0], toward[0], right[1], up[1], toward[1], right[2], up[2], toward[2]];
  };
  const draw_mesh = (mesh, colour) => {
    for (const [name, data] of [["place", mesh.places], ["normal", mesh.normals]]) {
      const at = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, data);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.faces);
    gl.uniform4fv(uniform("colour"), colour);
    gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_SHORT, 0);
  };
  const draw = () => {
    const [width, height] = [canvas.clientWidth * devicePixelRatio, canvas.clientHeight * devicePixelRatio];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.07, 0.12, 0.17, 1);
    gl.depthMask(true);  // or the depth of the last picture stays
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.uniformMatrix3fv(uniform("turn"), false, turn());
    const reach = scene.reach / view.zoom;
    gl.uniform2f(uniform("scale"), canvas.height / canvas.width / reach, 1 / reach);
    gl.disable(gl.BLEND);
    placed.forEach((mesh) => draw_mesh(mesh, [1.0, 0.69, 0.0, 1]));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(view.bone > 0.95);
    bones.forEach((mesh) => draw_mesh(mesh, [0.93, 0.88, 0.78, view.bone]));
    gl.depthMask(false);
    planned.forEach((mesh) => draw_mesh(mesh, [0.3, 0.76, 1.0, 0.5]));
    canvas.dataset.drawn = String(Number(canvas.dataset.drawn || 0) + 1);
  };

  canvas.addEventListener("pointerdown", (e) => canvas.setPointerCapture(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    if (!e.buttons) return;
    view.yaw -= 0.01 * e.movementX;
    view.pitch = Math.max(-1.5, Math.min(1.5, view.pitch + 0.01 * e.movementY));
    draw();
  });
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    view.zoom = Math.max(0.5, Math.min(8, view.zoom * Math.exp(-0.001 * e.deltaY)));
    draw();
  });
  const turn_to = {behind: [0, 0], left: [Math.PI / 2, 0], above: [0, 1.5]};
  for (const button of document.querySelectorAll("[data-turn]")) {
    button.addEventListener("click", () => { [view.yaw, view.pitch] = turn_to[button.dataset.turn]; draw(); });
  }
  document.getElementById("spine-bone").addEventListener("input", (e) => { view.bone = Number(e.target.value); draw(); });
  window.addEventListener("resize", draw);
  if (location.hash.slice(1) in turn_to) [view.yaw, view.pitch] = turn_to[location.hash.slice(1)];
  draw();
})();
