// The list of objects, with search; the chosen one shows what became of it. The legend of classes.

const mostRows = 300;

const filters = {
  targets: ["Objects to capture", object => object.role === "target"],
  missed: ["Not captured", object => captureOf(object) === "missed"],
  captured: ["Captured, not well", object => captureOf(object) === "captured"],
  well: ["Well captured", object => captureOf(object) === "well"],
  others: ["Building, excluded", object => object.role !== "target"],
  all: ["Everything", () => true],
};

function percent(share) {
  return `${(100 * share).toFixed(share < 0.1 ? 2 : 1)} %`;
}

/// What is known of an object, as [word, text] rows.
function factsOf(object) {
  const facts = [["Class", object.class]];
  const capture = captureOf(object);
  if (object.role === "structure") facts.push(["Role", "part of the building"]);
  if (object.role === "excluded") facts.push(["Role", "excluded by the user"]);
  if (object.role === "target") facts.push(["State", captureWords[capture]]);
  if (object.role === "target" && capture !== "well") {
    const why = object.reason || (capture === "missed"
      ? "the plan gives no reason; its frames show too little of it"
      : "the plan gives no reason; it takes too small a share of the picture");
    facts.push([capture === "missed" ? "Why not" : "Why not well", why]);
    if (object.remedy) facts.push(["What helps", object.remedy]);
  }
  if (object.best_frame >= 0) {
    const word = hasBestView(object) ? "Best frame" : "Most visible in";
    facts.push([word, hasBestView(object) ? String(object.best_frame)
      : `frame ${object.best_frame}, too little to count as captured`]);
    facts.push(["Visible share", `${percent(object.visible_fraction)} of its silhouette`]);
    facts.push(["In the picture", `box ${percent(object.box_share)}, mask ` +
      percent(object.mask_share)]);
  } else if (object.role === "target") {
    facts.push(["Visible share", "no frame shows it"]);
  }
  facts.push(["Size", object.size.map(side => side.toFixed(2)).join(" × ") + " m"]);
  facts.push(["Number", String(object.id)]);
  return facts;
}

function detailsOf(object) {
  const list = make("dl");
  for (const [word, text] of factsOf(object)) {
    list.append(make("dt", {textContent: word}), make("dd", {textContent: text}));
  }
  if (pictureKinds.some(kind => kind.modality === "instance")) {
    const swatch = make("span", {className: "color"});
    swatch.style.background = `rgb(${object.color.join(",")})`;
    list.append(make("dt", {textContent: "Image colour"}),
      make("dd", {}, swatch, " in the image “Objects”"));
  }
  if (!hasBestView(object)) return [list];
  const button = make("button",
    {type: "button", className: "go", textContent: `Show its best frame, ${object.best_frame}`});
  button.addEventListener("click", () => choose({frame: object.best_frame}));
  return [list, button];
}

/// The colour of an object's box for style sheets.
function boxStyle(object) {
  return state.colors === "capture" ? `var(--box-${captureOf(object)})` : classStyle(object.class);
}

function rowOf(object) {
  const capture = captureOf(object);
  const color = make("span", {className: "color", title: "Colour of its box"});
  if (object.role === "target") color.style.background = boxStyle(object);
  const row = make("button", {type: "button", className: "row"}, color,
    make("span", {className: "name", textContent: object.name}),
    make("span", {className: `state ${capture}`, textContent: captureWords[capture]}));
  row.addEventListener("click", () =>
    choose({object: state.object === object.id ? null : object.id}));
  const item = make("li", {}, row);
  item.dataset.id = object.id;
  return item;
}

/// Objects that have all the words of a search in their name or class.
function found(words, filter) {
  return objects.filter(object => {
    const text = `${object.name} ${object.class}`.toLowerCase();
    return filters[filter][1](object) && words.every(word => text.includes(word));
  });
}

class ObjectList {
  constructor() {
    this.list = document.getElementById("objects");
    this.search = document.getElementById("search");
    this.filter = document.getElementById("filter");
    for (const [value, [text, fits]] of Object.entries(filters)) {
      const count = objects.filter(fits).length;
      this.filter.append(make("option", {value, textContent: `${text} (${count})`}));
    }
    if (!objects.some(object => object.role === "target")) this.filter.value = "all";
    this.search.addEventListener("input", () => this.#fill());
    this.filter.addEventListener("change", () => this.#fill());
    watch(changed => {
      if (changed.has("colors")) this.#fill();
      if (changed.has("object")) this.#showChosen(true);
    });
    this.#fill();
  }

  #fill() {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(word => word !== "");
    const all = found(words, this.filter.value);
    this.list.replaceChildren(...all.slice(0, mostRows).map(rowOf));
    const count = document.getElementById("object-count");
    count.textContent = all.length === 0 ? "No object fits."
      : all.length > mostRows ? `${mostRows} of ${all.length} are listed; search for others.`
        : `${all.length} listed`;
    this.#showChosen(false);
  }

  /// Opens the chosen object's row; `bring` makes sure that it is listed and in sight.
  #showChosen(bring) {
    for (const item of this.list.querySelectorAll("li.chosen")) {
      item.classList.remove("chosen");
      item.replaceChildren(item.firstChild);
    }
    const object = objectById.get(state.object);
    if (!object) return;
    let item = this.list.querySelector(`li[data-id="${object.id}"]`);
    if (!item && bring) {
      item = rowOf(object);
      this.list.prepend(item);
    }
    if (!item) return;
    item.classList.add("chosen");
    item.append(...detailsOf(object));
    if (bring) {
      showList("object-list");
      item.scrollIntoView({block: "nearest"});
    }
  }
}

/// Classes of boxes with their colours and counts; a click hides or shows a class's boxes.
class ClassLegend {
  constructor() {
    this.list = document.getElementById("classes");
    this.rows = boxClasses.map(one => this.#rowOf(one));
    this.list.append(...this.rows.map(row => make("li", {}, row)));
    const names = boxClasses.map(one => one.name);
    document.getElementById("show-classes").addEventListener("click",
      () => choose({hidden: new Set()}));
    document.getElementById("hide-classes").addEventListener("click",
      () => choose({hidden: new Set(names)}));
    const colors = document.getElementById("colors");
    colors.addEventListener("change", () => choose({colors: colors.value}));
    document.getElementById("to-classes").addEventListener("click",
      () => showList("class-legend"));
    watch(changed => {
      if (changed.has("hidden")) this.#showHidden();
      if (changed.has("colors")) this.#showColors();
    });
    this.#showHidden();
    this.#showColors();
  }

  #rowOf({name, count, captured}) {
    const color = make("span", {className: "color"});
    color.style.borderColor = color.style.background = classStyle(name);
    const row = make("button", {type: "button", className: "row"}, color,
      make("span", {className: "name", textContent: name}),
      make("span", {className: "state none", textContent: `${captured} of ${count} captured`}));
    row.dataset.class = name;
    row.addEventListener("click", () => {
      const hidden = new Set(state.hidden);
      if (!hidden.delete(name)) hidden.add(name);
      choose({hidden});
    });
    return row;
  }

  #showHidden() {
    for (const row of this.rows) {
      const hidden = state.hidden.has(row.dataset.class);
      row.setAttribute("aria-pressed", String(!hidden));
      row.title = hidden ? "Show the boxes of this class" : "Hide the boxes of this class";
    }
    document.getElementById("show-classes").disabled = state.hidden.size === 0;
    document.getElementById("hide-classes").disabled = state.hidden.size === this.rows.length;
  }

  #showColors() {
    const by_class = state.colors === "class";
    document.getElementById("colors").value = state.colors;
    document.getElementById("to-classes").hidden = !by_class;
    for (const one of document.querySelectorAll(".by-capture")) one.hidden = by_class;
    this.list.classList.toggle("uncoloured", !by_class);
    document.getElementById("class-note").textContent = by_class
      ? "Colours of the boxes, not of the image “Classes”."
      : "The boxes are coloured by capture.";
  }
}

/// Shows one of the lists below the image: "object-list" or "class-legend".
function showList(id) {
  for (const button of document.querySelectorAll("[data-list]")) {
    button.setAttribute("aria-pressed", String(button.dataset.list === id));
    document.getElementById(button.dataset.list).hidden = button.dataset.list !== id;
  }
}

function startLists() {
  for (const button of document.querySelectorAll("[data-list]")) {
    button.addEventListener("click", () => showList(button.dataset.list));
  }
  showList("object-list");
  new ObjectList();
  new ClassLegend();
}
startLists();
