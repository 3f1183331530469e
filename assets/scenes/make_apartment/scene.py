"""Collects named objects with their place, and the truth about them for tests."""

import math

import numpy as np

STRUCTURE = {"wall", "floor", "ceiling", "door", "window", "otherstructure"}


class Thing:
    def __init__(self, name, nyu40, room, model, position, turn, on, how):
        self.name, self.nyu40, self.room = name, nyu40, room
        self.model, self.position, self.turn = model, position, turn
        self.on, self.how = on, how

    def bounds(self):
        placed = self.model.turned(self.turn).moved(*self.position)
        return placed.low(), placed.high()


class Scene:
    def __init__(self):
        self.things = {}
        self.room = ""

    def add(self, name, nyu40, model, x=0.0, y=0.0, z=None, turn=0.0, on=None, how="stands"):
        """Puts a model into the current room. Without z it stands on top of what `on` names."""
        if name in self.things:
            raise ValueError(f"two objects are called {name}")
        if z is None:
            z = 0.0 if on is None else float(self.things[on].bounds()[1][2])
        if on is None and nyu40 not in STRUCTURE:
            on = f"floor_{self.room}"
        self.things[name] = Thing(name, nyu40, self.room, model, (x, y, z), turn, on, how)

    def truth(self):
        """The answer sheet: sizes and places in metres, z up."""
        objects = []
        for thing in self.things.values():
            low, high = thing.bounds()
            own = thing.model.high() - thing.model.low()
            objects.append(
                {
                    "name": thing.name,
                    "nyu40": thing.nyu40,
                    "structure": thing.nyu40 in STRUCTURE,
                    "room": thing.room,
                    "on": thing.on,
                    "how": None if thing.on is None else thing.how,
                    "size_m": _rounded(own),
                    "centre_m": _rounded((low + high) / 2),
                    "low_m": _rounded(low),
                    "high_m": _rounded(high),
                    "front": _rounded(
                        [
                            math.sin(math.radians(thing.turn)),
                            -math.cos(math.radians(thing.turn)),
                            0.0,
                        ]
                    ),
                }
            )
        return objects


def _rounded(values):
    return [round(float(v), 4) + 0.0 for v in np.asarray(values)]
