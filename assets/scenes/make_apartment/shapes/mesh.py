"""Triangle meshes grouped by material.

Everything here is in metres with z up. A piece of furniture faces -y and stands on z = 0, so
turning it by 90 degrees makes it face +x.
"""

import math

import numpy as np


class Part:
    """Triangles of one material; texture coordinates are in metres until the file is written."""

    def __init__(self, material, positions, normals, uvs, triangles):
        self.material = material
        self.positions = np.asarray(positions, dtype=np.float64)
        self.normals = np.asarray(normals, dtype=np.float64)
        self.uvs = np.asarray(uvs, dtype=np.float64)
        self.triangles = np.asarray(triangles, dtype=np.int64)


class Model:
    """A rigid thing made of parts. Every method returns a new model."""

    def __init__(self, parts=()):
        self.parts = list(parts)

    def __add__(self, other):
        return Model(self.parts + other.parts)

    def moved(self, x=0.0, y=0.0, z=0.0):
        offset = np.array([x, y, z])
        return Model(
            Part(p.material, p.positions + offset, p.normals, p.uvs, p.triangles)
            for p in self.parts
        )

    def turned(self, degrees, axis="z"):
        """Counter-clockwise seen against the axis."""
        matrix = rotation(degrees, axis)
        return Model(
            Part(p.material, p.positions @ matrix.T, p.normals @ matrix.T, p.uvs, p.triangles)
            for p in self.parts
        )

    def scaled(self, x=1.0, y=1.0, z=1.0):
        """Factors must be positive: a mirror image would turn the triangles inside out."""
        factors = np.array([x, y, z])
        parts = []
        for p in self.parts:
            normals = p.normals / factors
            normals /= np.linalg.norm(normals, axis=1, keepdims=True)
            parts.append(Part(p.material, p.positions * factors, normals, p.uvs, p.triangles))
        return Model(parts)

    def painted(self, material):
        return Model(Part(material, p.positions, p.normals, p.uvs, p.triangles) for p in self.parts)

    def grounded(self):
        """Moved so that its lowest point is at z = 0, as after tilting."""
        return self.moved(z=-self.low()[2])

    def low(self):
        return np.min([p.positions.min(axis=0) for p in self.parts], axis=0)

    def high(self):
        return np.max([p.positions.max(axis=0) for p in self.parts], axis=0)

    def top(self):
        return float(self.high()[2])

    def by_material(self):
        """One part a material, in order of first use."""
        groups = {}
        for part in self.parts:
            groups.setdefault(part.material, []).append(part)
        merged = []
        for material, parts in groups.items():
            starts = np.cumsum([0] + [len(p.positions) for p in parts[:-1]])
            merged.append(
                Part(
                    material,
                    np.concatenate([p.positions for p in parts]),
                    np.concatenate([p.normals for p in parts]),
                    np.concatenate([p.uvs for p in parts]),
                    np.concatenate([p.triangles + s for p, s in zip(parts, starts)]),
                )
            )
        return merged


def rotation(degrees, axis):
    angle = math.radians(degrees)
    c, s = math.cos(angle), math.sin(angle)
    return np.array(
        {
            "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis]
    )


def joined(models):
    return Model(part for model in models for part in model.parts)


def smooth_normals(positions, triangles):
    """Area-weighted vertex normals; vertices at the same place share theirs across seams."""
    corners = positions[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    _, place = np.unique(np.round(positions, 6), axis=0, return_inverse=True)
    place = place.reshape(-1)
    total = np.zeros((place.max() + 1, 3))
    for k in range(3):
        np.add.at(total, place[triangles[:, k]], face)
    normals = total[place]
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    # Where two sides meet back to back, as at a pillow's corners, they cancel: look up.
    return np.where(length > 1e-12, normals / np.maximum(length, 1e-12), [0.0, 0.0, 1.0])


def without_slivers(positions, triangles):
    """Drops triangles with two corners at one place (poles of round shapes)."""
    corners = positions[triangles]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return triangles[area > 1e-12]
