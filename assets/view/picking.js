// Clicks and the pointer's place in the 3D view, and its switches.

const pickRadius_px = 8;
const farthestClick_px = 4;  // what moves more is a drag

/// The distance on the screen between a position and a frame's camera, from its eye to the middle of
/// its image plane; null where it is not in view.
function cameraDistance(view, frame, x, y) {
  const eye = new THREE.Vector3(...frame.position);
  const ahead = new THREE.Vector3(0, 0, view.trajectory.length)
    .applyQuaternion(new THREE.Quaternion(...frame.rotation)).add(eye);
  const [from, to] = [view.toScreen(eye), view.toScreen(ahead)];
  if (!from) return null;
  if (!to) return Math.hypot(from.x - x, from.y - y);
  const [across, down] = [to.x - from.x, to.y - from.y];
  const along = ((x - from.x) * across + (y - from.y) * down) /
    Math.max(across * across + down * down, 1e-9);
  const share = Math.min(Math.max(along, 0), 1);
  return Math.hypot(from.x + share * across - x, from.y + share * down - y);
}

/// What is at a position in the view: {frame}, {object}, or null. Labels are in front of the rest.
function pickAt(view, x, y) {
  const labelled = view.labels.hit(x, y);
  if (labelled !== null) return {object: labelled};
  let nearest = null;
  if (view.layers.cameras.visible) {
    for (const frame of frames) {
      if (!view.isFrameShown(frame)) continue;
      const distance = cameraDistance(view, frame, x, y);
      if (distance === null || distance > pickRadius_px) continue;
      if (nearest && distance >= nearest.distance) continue;
      nearest = {distance, frame: frame.index};
    }
  }
  if (nearest) return {frame: nearest.frame};
  const caster = new THREE.Raycaster();
  caster.setFromCamera({
    x: 2 * x / view.place.clientWidth - 1, y: 1 - 2 * y / view.place.clientHeight,
  }, view.camera);
  const hit = view.room && view.layers.room.visible ? view.room.hit(caster.ray) : null;
  if (hit && objectById.has(hit.id)) return {object: hit.id};
  const box = view.layers.boxes.visible ? view.boxes.hit(caster.ray) : null;
  return box === null ? null : {object: box};
}

/// The words beside the pointer.
function hoverText(picked) {
  if ("frame" in picked) return `Frame ${picked.frame}: click to show it`;
  const object = objectById.get(picked.object);
  return `${object.name}: ${object.class}, ${captureWords[captureOf(object)]}`;
}

function startPicking(view) {
  const hover = document.getElementById("hover");
  let asked = 0;
  const leave = () => {
    cancelAnimationFrame(asked);
    hover.hidden = true;
    view.highlight(null);
  };
  const placeOf = event => {
    const box = view.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  let pressed = null;
  view.canvas.addEventListener("pointerdown", event => {
    pressed = event.button === 0 ? placeOf(event) : null;
    leave();
  });
  view.canvas.addEventListener("pointerup", event => {
    if (!pressed) return;
    const [x, y] = placeOf(event);
    const moved = Math.hypot(x - pressed[0], y - pressed[1]);
    pressed = null;
    if (moved > farthestClick_px) return;
    document.getElementById("hint").hidden = true;
    const picked = pickAt(view, x, y);
    if (picked) choose(picked); else choose({object: null});
  });
  view.canvas.addEventListener("pointerleave", leave);
  view.canvas.addEventListener("pointermove", event => {
    if (event.buttons !== 0) return;
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(() => {
      const [x, y] = placeOf(event);
      const picked = pickAt(view, x, y);
      hover.hidden = picked === null;
      view.highlight(picked);
      if (!picked) return;
      hover.textContent = hoverText(picked);
      const right = x > view.place.clientWidth - 320;
      hover.style.left = right ? "" : `${x + 14}px`;
      hover.style.right = right ? `${view.place.clientWidth - x + 14}px` : "";
      hover.style.top = `${Math.min(y + 14, view.place.clientHeight - 28)}px`;
    });
  });
}

function startSwitches(view) {
  const layers = document.getElementById("layers");
  const words = {room: "Room", path: "Path", cameras: "Cameras", boxes: "Boxes", labels: "Names"};
  for (const [name, layer] of Object.entries(view.layers)) {
    if (!layer) continue;
    const box = make("input", {type: "checkbox", checked: true, id: `show-${name}`});
    box.addEventListener("change", () => {
      layer.visible = box.checked;
      view.draw();
    });
    layers.append(make("label", {}, box, words[name]));
  }
  document.getElementById("reset").addEventListener("click", () => view.reset());
  const storeys = roomData ? roomData.storeys : [];
  document.getElementById("storeys").hidden = storeys.length < 2;
  const select = document.getElementById("storey");
  storeys.forEach((storey, i) => {
    const words = i + 1 === storeys.length ? "all" : `up to ${i + 1}`;
    select.append(make("option", {value: i, textContent: words}));
  });
  const show = () => { select.value = state.storey; };
  show();
  watch(changed => { if (changed.has("storey")) show(); });
  select.addEventListener("change", () => choose({storey: Number(select.value)}));
}

function startView() {
  const ramp = [0, 0.25, 0.5, 0.75, 1].map(share =>
    `rgb(${timeColor(share).map(value => Math.round(255 * value)).join(",")})`);
  document.getElementById("ramp").style.background = `linear-gradient(90deg, ${ramp.join(",")})`;
  let view = null;
  try {
    view = new View3d(document.getElementById("canvas-place"), document.getElementById("labels"));
  } catch (error) {
    for (const id of ["over", "legend"]) document.getElementById(id).hidden = true;
    document.getElementById("no-webgl").hidden = false;
    return;
  }
  startPicking(view);
  startSwitches(view);
  // For programs that look at the page, as its tests do: where something is in the window.
  window.datasetView = {
    frameAt: index => placeInWindow(view, new THREE.Vector3(...frames[index].position)),
    objectAt: id => placeInWindow(view, new THREE.Vector3().applyMatrix4(
      boxMatrix(objectById.get(id)))),
    under: (x, y) => {
      const box = view.canvas.getBoundingClientRect();
      return pickAt(view, x - box.left, y - box.top);
    },
  };
}

function placeInWindow(view, point) {
  const at = view.toScreen(point);
  const box = view.canvas.getBoundingClientRect();
  return at && {x: at.x + box.left, y: at.y + box.top};
}
startView();
