// What is chosen. Every part of the page reads it, changes it by choose(), and is told of changes.
// It stands in the address, so that a link can point at a frame or an object; hidden classes do not.

const state = {
  frame: 0,
  object: null,    // id
  picture: pictureKinds.length > 0 ? pictureKinds[0].modality : null,
  colors: "class",           // of the boxes: by "class" or by "capture"
  hidden: new Set(),         // names of classes whose boxes are hidden; replaced, never changed
  storey: roomData ? roomData.storeys.length - 1 : 0,
  view: null,      // of the 3D view: "x,y,z,x,y,z" of eye and centre; null: as at first
};
const watchers = [];

/// Calls `watcher(changed)` after each change, with the set of changed keys.
function watch(watcher) {
  watchers.push(watcher);
}

function allowed(key, value) {
  switch (key) {
    case "frame": return Number.isInteger(value) && value >= 0 && value < frames.length;
    case "object": return value === null || objectById.has(value);
    case "picture": return pictureKinds.some(kind => kind.modality === value);
    case "storey": return roomData !== null && Number.isInteger(value) && value >= 0 &&
      value < roomData.storeys.length;
    case "colors": return value === "class" || value === "capture";
    case "hidden": return value instanceof Set;
    case "view": return value === null || /^-?[\d.]+(,-?[\d.]+){5}$/.test(value);
    default: return false;
  }
}

function choose(changes, fromAddress = false) {
  const changed = new Set();
  for (const [key, value] of Object.entries(changes)) {
    if (!allowed(key, value) || state[key] === value) continue;
    state[key] = value;
    changed.add(key);
  }
  if (changed.size === 0) return;
  for (const watcher of watchers) watcher(changed);
  if (!fromAddress) writeAddress();
}

let address_timer = 0;

/// A moment later: browsers refuse addresses that change many times a second.
function writeAddress() {
  clearTimeout(address_timer);
  address_timer = setTimeout(() => {
    const words = new URLSearchParams({frame: state.frame});
    if (state.object !== null) words.set("object", state.object);
    if (pictureKinds.length > 1) words.set("picture", state.picture);
    if (roomData && roomData.storeys.length > 1) words.set("storey", state.storey);
    if (state.colors !== "class") words.set("colors", state.colors);
    if (state.view !== null) words.set("view", state.view);
    history.replaceState(null, "", "#" + words);
  }, 250);
}

function readAddress() {
  const words = new URLSearchParams(location.hash.slice(1));
  const changes = {};
  for (const key of ["frame", "object", "storey"]) {
    if (words.has(key)) changes[key] = Number(words.get(key));
  }
  for (const key of ["picture", "colors", "view"]) {
    if (words.has(key)) changes[key] = words.get(key);
  }
  choose(changes, true);
}
