#!/usr/bin/python3
"""Trains a small object detector with a segmentation head on a planner's frames; tests in other scenes.

Protocol, the same for every planner and every kind of test:
- One model is trained from scratch for each planner and plan seed, on its frames of all training scenes.
- 600 steps of 16 images whatever the number of frames (option `steps`), AdamW, learning rate 3e-3 after 40
  steps, then falling along a cosine to 0; weight decay 1e-4; the weights of the last step are tested.
- Images wider than 192 pixels (option `width_px`) are scaled down to this width.
- Augmentation: mirrored with probability 1/2, scaled by 0.7 to 1.4, shifted by up to 15 %, brightness and
  contrast changed by up to 20 %.
- Boxes are those of the visible pixels of target objects. Objects with fewer than 480 pixels (of 640 x 480;
  option `least_px`) are ignored in training and tests; predictions on them count as neither right nor wrong.
- Classes are those of the training scenes' objects that the tests also show. A class that a planner never
  shows counts in its means like any other, so that showing fewer classes is no advantage.
- mAP is COCO's: 101 recall levels, at most 100 boxes per image, mean over the classes in the test.
- `ap50_any` is the class-agnostic AP at IoU 0.5: localization without classification.
- mIoU is the mean over the classes of the test's pixels; pixels of other classes do not count.
- Option `trainings` (1) repeats the training with further seeds; values are means, `_spread` their standard
  deviation. Option `folds` (0) adds cross-validation on the planner's own frames, in consecutive blocks.
- Option `device` (cpu) may be `cuda`: faster, but results vary slightly between runs.

The network has 0.5 million weights: residual blocks at strides 4, 8 and 16, merged at stride 4, with a head for
class heatmaps and box borders (TTFNet, AAAI 2020) and a head for pixel classes.
"""
import json
import math
import pathlib

from dataset import BadOption, Dataset, digest_of, finite, mean, need, progress, read_json, run, text_of, write_result
from detection_scores import mean_average_precision, mean_iou

import cv2
import numpy as np

try:
    import torch
    from torch import nn
    from torch.nn import functional
except ImportError:
    torch = None

NAME = "detector"
OPTIONS = {"steps": 600, "batch": 16, "width_px": 192, "least_px": 480, "trainings": 1, "folds": 0,
           "threads": 2, "device": "cpu"}
SCORES = ("map50", "map", "ap50_any", "miou")
DISTRIBUTIONS = ("uniform", "object_facing", "close")
STRIDE = 4
VOID = 255
NO_TESTS = ("There are no test views of unseen scenes; give --test-scene SCENE or "
            "--judge-option detector.folds=5.")
MOST_BOXES = 100


# --- frames -------------------------------------------------------------------------------------

def read_frames(data, options):
    """Frames of a dataset as (rgb, semantic, boxes, labels, ignored); labels are the dataset's class ids."""
    scale = min(1.0, options["width_px"] / data.width)
    size = (round(data.width * scale), round(data.height * scale))
    least = options["least_px"] * data.width * data.height / (640 * 480)
    frames = []
    for index in range(len(data)):
        found = data.boxes(index, 1)
        boxes = np.array([[b["x"], b["y"], b["x"] + b["width"], b["y"] + b["height"]] for b in found])
        frames.append((cv2.resize(data.rgb(index), size, interpolation=cv2.INTER_AREA),
                       cv2.resize(data.semantic(index), size, interpolation=cv2.INTER_NEAREST).astype(int),
                       boxes.reshape(-1, 4).astype(float) * scale, np.array([b["label"] for b in found], int),
                       np.array([b["px"] < least for b in found], bool)))
    return frames


def classes_shown(frames):
    """The box classes and the pixel classes that occur in frames."""
    boxes = {int(label) for frame in frames for label in frame[3][~frame[4]]}
    pixels = {int(label) for frame in frames for label in np.unique(frame[1])}
    return boxes - {0}, pixels - {0}


def classes_of_scene(data):
    """The classes of the scene's targets and of all its objects, visible in frames or not."""
    labels = {i: int(one.get("nyu40") or 0) for i, one in data.objects.items()}
    return {label for i, label in labels.items() if i in data.targets} - {0}, set(labels.values()) - {0}


class Table:
    """Maps the dataset's class ids to numbers from 0; other ids become VOID."""

    def __init__(self, ids):
        self.ids = sorted(ids)
        self.lookup = np.full(65536, VOID, np.uint8)
        self.lookup[self.ids] = np.arange(len(self.ids))

    def __len__(self):
        return len(self.ids)


def prepare(frames, box_table, pixel_table):
    """Frames with labels in the model's numbering, without boxes of other classes."""
    ready = []
    for rgb, semantic, boxes, labels, ignored in frames:
        numbers = box_table.lookup[labels].astype(int)
        known = numbers != VOID
        ready.append((rgb, pixel_table.lookup[semantic], boxes[known], numbers[known], ignored[known]))
    return ready


def augment(frame, random):
    """One augmented frame: mirrored, scaled, shifted, with other brightness; same image size."""
    rgb, semantic, boxes, labels, ignored = frame
    height, width = semantic.shape
    scale = math.exp(random.uniform(math.log(0.7), math.log(1.4)))
    mirror = -1.0 if random.random() < 0.5 else 1.0
    shift = random.uniform(-0.15, 0.15, 2) * (width, height)
    centre = np.array([width, height]) / 2
    factor = np.array([scale * mirror, scale])
    move = centre + shift - factor * centre        # new = factor * old + move, in pixels from the corner
    pixel = np.column_stack([np.diag(factor), move + 0.5 * factor - 0.5])   # the same from pixel centres
    gain, offset = random.uniform(0.8, 1.2), random.uniform(-25, 25)
    rgb = cv2.warpAffine(rgb, pixel, (width, height), flags=cv2.INTER_LINEAR)
    rgb = np.clip((rgb.astype(np.float32) - 128) * gain + 128 + offset, 0, 255)
    semantic = cv2.warpAffine(semantic, pixel, (width, height), flags=cv2.INTER_NEAREST, borderValue=VOID)
    corners = np.sort(boxes.reshape(-1, 2, 2) * factor + move, axis=1).reshape(-1, 4)
    whole = np.prod(corners[:, 2:] - corners[:, :2], axis=1)
    clipped = np.clip(corners, 0, [width, height, width, height])
    left = np.prod(clipped[:, 2:] - clipped[:, :2], axis=1)
    kept = left > 0
    return rgb, semantic, clipped[kept], labels[kept], (ignored | (left < 0.4 * whole))[kept]


def targets_of(frame, classes):
    """Training targets: heatmaps, box borders with weights, and a mask of ignored positions."""
    _, semantic, boxes, labels, ignored = frame
    rows, columns = (-(-side // STRIDE) for side in semantic.shape)
    heat = np.zeros((classes, rows, columns), np.float32)
    border = np.zeros((4, rows, columns), np.float32)
    weight = np.zeros((rows, columns), np.float32)
    asked = np.ones((classes, rows, columns), np.float32)
    x, y = np.arange(columns) * STRIDE + STRIDE / 2, np.arange(rows) * STRIDE + STRIDE / 2
    areas = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    for i in np.argsort(-areas, kind="stable"):    # small objects last, so that they overwrite larger ones
        x0, y0, x1, y1 = boxes[i]
        if ignored[i]:
            inside = ((y >= y0 - 2) & (y <= y1 + 2))[:, None] & ((x >= x0 - 2) & (x <= x1 + 2))[None, :]
            asked[labels[i]][inside] = 0
            continue
        column = min(int((x0 + x1) / 2 / STRIDE), columns - 1)
        row = min(int((y0 + y1) / 2 / STRIDE), rows - 1)
        sigma_x, sigma_y = (max(0.54 * side / 6, STRIDE / 3) for side in (x1 - x0, y1 - y0))
        across, down = ((x - x[column]) / sigma_x)[None, :], ((y - y[row]) / sigma_y)[:, None]
        bump = np.exp(-(across ** 2 + down ** 2) / 2)
        heat[labels[i]] = np.maximum(heat[labels[i]], bump)
        near = bump > 0.25
        sides = np.broadcast_arrays((x - x0)[None, :], (y - y0)[:, None], (x1 - x)[None, :], (y1 - y)[:, None])
        border[:, near] = np.stack(sides)[:, near]
        weight[near] = bump[near] * math.log(max(areas[i], 2)) / bump[near].sum()
    asked[heat == 1] = 1
    coarse = semantic[STRIDE // 2::STRIDE, STRIDE // 2::STRIDE]
    return heat, border, weight, asked, coarse.astype(np.int64)


# --- model --------------------------------------------------------------------------------------

def convolution(before, after, stride=1, size=3):
    return nn.Sequential(nn.Conv2d(before, after, size, stride, size // 2, bias=False),
                         nn.BatchNorm2d(after), nn.ReLU())


class Block(nn.Module if torch else object):
    """A residual block of two convolutions, the first with a stride."""

    def __init__(self, before, after, stride):
        super().__init__()
        self.first = convolution(before, after, stride)
        self.second = nn.Sequential(nn.Conv2d(after, after, 3, 1, 1, bias=False), nn.BatchNorm2d(after))
        self.side = nn.Sequential() if before == after and stride == 1 else convolution(before, after, stride, 1)

    def forward(self, x):
        return functional.relu(self.side(x) + self.second(self.first(x)))


class Network(nn.Module if torch else object):
    def __init__(self, box_classes, pixel_classes):
        super().__init__()
        self.stem = convolution(3, 16, 2)
        self.quarter = Block(16, 32, 2)
        self.eighth = nn.Sequential(Block(32, 64, 2), Block(64, 64, 1))
        self.sixteenth = nn.Sequential(Block(64, 96, 2), Block(96, 96, 1))
        self.sides = nn.ModuleList(nn.Conv2d(width, 48, 1) for width in (32, 64, 96))
        self.join = convolution(48, 48)
        self.objects = convolution(48, 48)
        self.heat = nn.Conv2d(48, box_classes, 1)
        self.border = nn.Conv2d(48, 4, 1)
        self.pixels = nn.Conv2d(48, pixel_classes, 1)
        nn.init.constant_(self.heat.bias, -4.0)
        nn.init.constant_(self.border.bias, 1.0)

    def forward(self, images):
        quarter = self.quarter(self.stem(images / 64.0 - 2.0))
        eighth = self.eighth(quarter)
        joined = self.sides[2](self.sixteenth(eighth))
        for side, features in ((self.sides[1], eighth), (self.sides[0], quarter)):
            wide = functional.interpolate(joined, size=features.shape[2:], mode="nearest")
            joined = side(features) + wide
        joined = self.join(joined)
        objects = self.objects(joined)
        border = torch.exp(torch.clamp(self.border(objects), -4, 5)) * STRIDE
        return self.heat(objects), border, self.pixels(joined)


def heat_loss(logits, heat, asked):
    """CenterNet's focal loss, averaged over objects."""
    chance = torch.clamp(torch.sigmoid(logits), 1e-4, 1 - 1e-4)
    centre = (heat == 1).float()
    right = torch.log(chance) * (1 - chance) ** 2 * centre
    wrong = torch.log(1 - chance) * chance ** 2 * (1 - heat) ** 4 * (1 - centre)
    return -((right + wrong) * asked).sum() / torch.clamp(centre.sum(), min=1)


def border_loss(found, true, weight):
    """Generalised IoU of boxes given by distances from the same pixel."""
    shared = torch.minimum(found, true)
    around = torch.maximum(found, true)

    def area(sides):
        return (sides[:, 0] + sides[:, 2]) * (sides[:, 1] + sides[:, 3])

    both = area(found) + area(true) - area(shared)
    hull = torch.clamp(area(around), min=1e-6)
    loss = 1 - area(shared) / torch.clamp(both, min=1e-6) + (hull - both) / hull
    return (loss * weight).sum() / torch.clamp(weight.sum(), min=1)


def train(frames, box_classes, pixel_classes, seed, options):
    """Trains the network on prepared `frames` and returns it."""
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    device = torch.device(options["device"])
    network = Network(box_classes, pixel_classes).to(device)
    network.train()
    steps, batch = options["steps"], options["batch"]
    optimizer = torch.optim.AdamW(network.parameters(), lr=3e-3, weight_decay=1e-4)
    warm = min(40, max(1, steps // 10))
    schedule = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda step: min(
        (step + 1) / warm, 0.5 + 0.5 * math.cos(math.pi * min(1.0, step / steps))))
    order = []
    for _ in range(steps):
        while len(order) < batch:
            order.extend(random.permutation(len(frames)))
        chosen, order = order[:batch], order[batch:]
        changed = [augment(frames[i], random) for i in chosen]
        asked_for = [targets_of(frame, box_classes) for frame in changed]
        heat, border, weight, asked, pixels = (torch.from_numpy(np.stack(part)).to(device)
                                               for part in zip(*asked_for))
        images = torch.from_numpy(np.stack([frame[0] for frame in changed])).to(device).permute(0, 3, 1, 2)
        found_heat, found_border, found_pixels = network(images)
        loss = heat_loss(found_heat, heat, asked) + 2.0 * border_loss(found_border, border, weight)
        if (pixels != VOID).any():
            loss = loss + functional.cross_entropy(found_pixels, pixels, ignore_index=VOID)
        optimizer.zero_grad()
        loss.backward()
        nn.utils.clip_grad_norm_(network.parameters(), 10.0)
        optimizer.step()
        schedule.step()
    network.eval()
    return network


def predict(network, images):
    """Boxes, scores, labels and pixel classes of each image (height x width x 3 uint8)."""
    with torch.no_grad():
        device = next(network.parameters()).device
        batch = torch.from_numpy(np.stack(images).astype(np.float32)).to(device).permute(0, 3, 1, 2)
        heat, border, pixels = network(batch)
        heat = torch.sigmoid(heat)
        heat = heat * (functional.max_pool2d(heat, 3, 1, 1) == heat)
        pixels = functional.interpolate(pixels, scale_factor=STRIDE, mode="bilinear", align_corners=False)
        pixels = pixels.argmax(dim=1).cpu().numpy()
        height, width = images[0].shape[:2]
        found = []
        for one, sides in zip(heat.cpu(), border.cpu().numpy()):
            scores, places = torch.topk(one.flatten(), min(MOST_BOXES, one.numel()))
            labels, cells = np.divmod(places.numpy(), one.shape[1] * one.shape[2])
            row, column = np.divmod(cells, one.shape[2])
            x, y = (column + 0.5) * STRIDE, (row + 0.5) * STRIDE
            left, above, right, below = sides[:, row, column]
            boxes = np.stack([np.clip(x - left, 0, width), np.clip(y - above, 0, height),
                              np.clip(x + right, 0, width), np.clip(y + below, 0, height)], axis=1)
            found.append((boxes, scores.numpy(), labels))
    return found, pixels[:, :height, :width]


def test(network, frames, box_classes, pixel_classes):
    """Scores of a network on prepared frames."""
    predictions = []
    confusion = np.zeros((pixel_classes, pixel_classes), np.int64)
    for start in range(0, len(frames), 16):
        part = frames[start:start + 16]
        found, pixels = predict(network, [frame[0] for frame in part])
        predictions += found
        for frame, seen in zip(part, pixels):
            known = frame[1] != VOID
            both = frame[1][known].astype(int) * pixel_classes + seen[known]
            confusion += np.bincount(both, minlength=pixel_classes ** 2).reshape(confusion.shape)
    truths = [frame[2:] for frame in frames]
    half, all_of_them = mean_average_precision(predictions, truths, box_classes)
    found = [(boxes, scores, np.zeros_like(labels)) for boxes, scores, labels in predictions]
    objects = [(boxes, np.zeros_like(labels), ignored) for boxes, labels, ignored in truths]
    return {"map50": half, "map": all_of_them, "ap50_any": mean_average_precision(found, objects, 1)[0],
            "miou": mean_iou(confusion)}


# --- judge --------------------------------------------------------------------------------------

def metrics_of(distributions, options):
    metrics = {}
    kinds = [*distributions, "mean"] + (["folds"] if options["folds"] else [])
    for score in SCORES:
        for kind in kinds:
            metrics[f"{score}_{kind}"] = {"unit": "", "better": "higher"}
    metrics["map50_spread"] = metrics["miou_spread"] = {"unit": "", "better": ""}
    for count in ("frames", "boxes", "boxes_per_frame", "classes", "classes_trained"):
        metrics[count] = {"unit": "", "better": ""}
    return metrics


def cross_validate(parts, seed, sizes, options):
    """Mean scores over folds, each a block of consecutive frames of each scene in `parts`."""
    results = []
    for fold in range(options["folds"]):
        training, tested = [], []
        for frames in parts:
            block = np.arange(len(frames)) * options["folds"] // max(1, len(frames))
            training += [frame for frame, its in zip(frames, block) if its != fold]
            tested += [frame for frame, its in zip(frames, block) if its == fold]
        if training and tested:
            results.append(test(train(training, *sizes, seed, options), tested, *sizes))
    return {f"{score}_folds": mean([one[score] for one in results]) for score in SCORES}


def judge_group(parts, tests, seed, sizes, options):
    """Values of one planner and plan seed: trains on the frames in `parts` (by scene), tests on `tests`."""
    frames = [frame for part in parts for frame in part]
    boxes = sum(int((~frame[4]).sum()) for frame in frames)
    values = {"frames": len(frames), "boxes": boxes, "boxes_per_frame": boxes / max(1, len(frames)),
              "classes": sizes[0],
              "classes_trained": len({int(label) for frame in frames for label in frame[3][~frame[4]]})}
    if not frames:
        return values
    runs = []
    for k in range(options["trainings"]):
        network = train(frames, *sizes, seed + k, options)
        scores = {kind: test(network, its, *sizes) for kind, its in tests.items()}
        one = {f"{score}_{kind}": scores[kind][score] for kind in tests for score in SCORES}
        for score in SCORES:
            one[f"{score}_mean"] = mean([scores[kind][score] for kind in tests])
        runs.append(one)
    for name in runs[0]:
        values[name] = mean([one[name] for one in runs])
    for score in ("map50", "miou"):
        known = [one[f"{score}_mean"] for one in runs if one[f"{score}_mean"] is not None]
        values[f"{score}_spread"] = float(np.std(known, ddof=1)) if len(known) > 1 else None
    if options["folds"]:
        values.update(cross_validate(parts, seed, sizes, options))
    return values


def usable_tests(request):
    """The sets of test views of scenes that are not training scenes."""
    trained = {entry["scene"] for entry in request["entries"]}
    return [test for test in request.get("tests", [])
            if test["distribution"] in DISTRIBUTIONS and test["scene"] not in trained]


def read_request(request, options, notes):
    """Frames of each planner and seed by scene, test frames by distribution, and the classes of both.

    If a dataset cannot be read, its planner has None for its frames, because training on fewer scenes
    would not be comparable.
    """
    groups, tests, in_scenes = {}, {}, (set(), set())
    for entry in request["entries"]:
        key = (entry["planner"], entry.get("seed", 1))
        try:
            data = Dataset(entry["dataset"])
            frames = read_frames(data, options)
        except Exception as error:  # pylint: disable=broad-except  # measure the other planners
            notes.append(f"{entry['scene']} {entry['planner']}: {text_of(error)}")
            groups[key] = None
            continue
        for known, more in zip(in_scenes, classes_of_scene(data)):
            known.update(more)
        if groups.setdefault(key, []) is not None:
            groups[key].append(frames)
    for entry in usable_tests(request):
        tests.setdefault(entry["distribution"], []).extend(read_frames(Dataset(entry["dataset"]), options))
    if not tests:
        notes.append("There are no test views of unseen scenes; only cross-validation has values.")
        return groups, tests, [Table(ids) for ids in in_scenes]
    shown = classes_shown([frame for frames in tests.values() for frame in frames])
    return groups, tests, [Table(ids & its) for ids, its in zip(in_scenes, shown)]


def kept_values(request, options, tables, key):
    """The file that caches the values of a planner and seed; its name has a hash of what they depend on."""
    digest = digest_of(request)
    mine = [one for one in request["entries"] if (one["planner"], one.get("seed", 1)) == key]
    for one in mine + usable_tests(request):
        digest.update((pathlib.Path(one["dataset"]) / "dataset.json").read_bytes())
        digest.update(one.get("distribution", "").encode())
    digest.update(json.dumps([options, [table.ids for table in tables]]).encode())
    folder = pathlib.Path(request["work"])
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{NAME}.{digest.hexdigest()[:24]}.json"


def judge(request):
    options = request["options"]
    seed, notes, rows = int(request.get("seed", 1)), [], []
    if not usable_tests(request) and not options["folds"]:
        metrics = metrics_of([], options)
        keys = dict.fromkeys((entry["planner"], entry.get("seed", 1)) for entry in request["entries"])
        rows = [{"planner": planner, "scene": "all", "seed": number, "values": dict.fromkeys(metrics)}
                for planner, number in keys]
        return {"judge": NAME, "rows": rows, "metrics": metrics, "notes": [NO_TESTS]}
    torch.set_num_threads(options["threads"])
    torch.use_deterministic_algorithms(True, warn_only=options["device"] != "cpu")
    groups, tests, tables = read_request(request, options, notes)
    sizes = tuple(len(table) for table in tables)
    if 0 in sizes:
        notes.append("The training scenes and the tests share no class; "
                     "give tests with the same kinds of objects.")
    tests = {kind: prepare(frames, *tables) for kind, frames in tests.items()}
    metrics = metrics_of([kind for kind in DISTRIBUTIONS if kind in tests], options)
    for key, parts in groups.items():
        values = dict.fromkeys(metrics)
        if parts is not None and 0 not in sizes:
            kept = kept_values(request, options, tables, key)
            found = read_json(kept)
            if found is None:
                found = judge_group([prepare(part, *tables) for part in parts], tests, seed, sizes, options)
                found = {name: finite(value) for name, value in found.items()}
                write_result(kept, found)
            values.update({name: value for name, value in found.items() if name in metrics})
        rows.append({"planner": key[0], "scene": "all", "seed": key[1], "values": values})
        progress(f"{NAME}: {key[0]} seed {key[1]} done")
    notes.append(f"Trained {options['steps']} steps of {options['batch']} images on {sizes[0]} classes of boxes "
                 f"and {sizes[1]} of pixels.")
    return {"judge": NAME, "rows": rows, "metrics": metrics, "notes": notes}


def check():
    found = need("torch", "python3-torch")
    return f"torch {found.__version__}, OpenCV {cv2.__version__}, NumPy {np.__version__}"


def check_device(request):
    """Raises BadOption unless the device is cpu, or cuda and PyTorch finds a graphics card."""
    device = request["options"]["device"]
    if device not in ("cpu", "cuda"):
        raise BadOption(f"The option detector.device must be cpu or cuda, not '{device}'.")
    if device == "cuda" and not torch.cuda.is_available():
        raise BadOption("PyTorch finds no graphics card; leave out the option detector.device=cuda.")


if __name__ == "__main__":
    run(check, judge, OPTIONS, check_device)
