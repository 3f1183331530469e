// The chosen frame's pictures.

const pictureOf = (kind, frame) => kind.files[frame] || "";

/// Whether the page has any picture of a frame.
function isPictured(frame) {
  return pictureKinds.some(kind => pictureOf(kind, frame) !== "");
}

/// The nearest frame that has a picture; -1 without any.
function nearestPictured(frame) {
  for (let step = 1; step < frames.length; ++step) {
    if (frame - step >= 0 && isPictured(frame - step)) return frame - step;
    if (frame + step < frames.length && isPictured(frame + step)) return frame + step;
  }
  return -1;
}

function frameLink(frame, text) {
  const link = make("button", {type: "button", className: "link", textContent: text});
  link.addEventListener("click", () => choose({frame}));
  return link;
}

function objectLink(object) {
  const link = make("button", {type: "button", className: "link", textContent: object.name});
  link.addEventListener("click", () => choose({object: object.id}));
  return link;
}

function showPicture() {
  const picture = document.getElementById("picture");
  const missing = document.getElementById("no-picture");
  const kind = pictureKinds.find(one => one.modality === state.picture);
  const file = kind ? pictureOf(kind, state.frame) : "";
  picture.hidden = file === "";
  missing.hidden = file !== "";
  if (file !== "") {
    picture.src = `data:${kind.type};base64,${file}`;
    picture.alt = `${kind.text} of frame ${state.frame}`;
    return;
  }
  picture.removeAttribute("src");
  missing.replaceChildren();
  if (!kind) {
    missing.append("The dataset has no pictures.");
  } else if (isPictured(state.frame)) {
    missing.append("This image of the dataset is missing or damaged.");
  } else {
    missing.append("The page has no picture of this frame. ");
    const near = nearestPictured(state.frame);
    if (near >= 0) missing.append(frameLink(near, `Nearest: frame ${near}`));
  }
}

function showFrameFacts() {
  const facts = document.getElementById("frame-facts");
  const best = document.getElementById("best-of");
  if (frames.length === 0) {
    facts.textContent = "The dataset has no frames.";
    return;
  }
  const frame = frames[state.frame];
  const place = frame.position.map(value => value.toFixed(2)).join(", ");
  facts.textContent = `Frame ${frame.index} · ${frame.time_s.toFixed(2)} s · at ${place} m` +
    (dataset.unusable.includes(frame.index) ? " · too dark, white or flat to be used" : "");
  best.replaceChildren();
  const shown = bestOfFrame.get(frame.index) || [];
  if (shown.length === 0) {
    best.append("No object has its best view here.");
    return;
  }
  best.append("Best view of ");
  shown.forEach((object, i) => best.append(i > 0 ? ", " : "", objectLink(object)));
}

/// Folds the image away, so that the lists below get its room.
function startFolding() {
  const button = document.getElementById("fold");
  const show = open => {
    document.getElementById("picture-place").hidden = !open;
    button.setAttribute("aria-expanded", String(open));
    button.textContent = open ? "Hide image" : "Show image";
    button.title = open ? "Gives the list more room" : "";
  };
  button.addEventListener("click", () => show(button.getAttribute("aria-expanded") !== "true"));
  document.getElementById("kinds").addEventListener("click", () => show(true));
  show(true);
}

function startPictures() {
  const place = document.getElementById("picture-place");
  place.style.aspectRatio = `${dataset.lens.width} / ${dataset.lens.height}`;
  const kinds = document.getElementById("kinds");
  const buttons = pictureKinds.map(kind => {
    const button = make("button", {type: "button", textContent: kind.text});
    button.dataset.modality = kind.modality;
    button.addEventListener("click", () => choose({picture: kind.modality}));
    return button;
  });
  kinds.append(...buttons);
  kinds.hidden = buttons.length === 0;
  const show = () => {
    for (const button of buttons) {
      button.setAttribute("aria-pressed", String(button.dataset.modality === state.picture));
    }
    showPicture();
  };
  watch(changed => {
    if (changed.has("frame") || changed.has("picture")) show();
    if (changed.has("frame")) showFrameFacts();
  });
  show();
  showFrameFacts();
}
startPictures();
startFolding();
