"""The mesh of a room that was scanned only in part."""
import numpy


def write_partial_scan(path):
    """A room of 8 x 4 x 2.5 m as the fine mesh of a scan: without its ceiling; of the last 3 m,
    behind an inner wall with a doorway, only the end wall was scanned."""
    lines = []
    count = 0

    def surface(name, corner, edge_u, edge_v):
        """A rectangle of 0.125 m squares that faces along edge_u x edge_v."""
        nonlocal count
        steps = [round(8 * numpy.linalg.norm(edge)) for edge in (edge_u, edge_v)]
        lines.append(f"o {name}")
        for i in range(steps[0] + 1):
            for k in range(steps[1] + 1):
                at = (numpy.array(corner) + numpy.array(edge_u) * i / steps[0]
                      + numpy.array(edge_v) * k / steps[1])
                lines.append("v %g %g %g" % tuple(at))
        for i in range(steps[0]):
            for k in range(steps[1]):
                a = count + i * (steps[1] + 1) + k + 1
                b = a + steps[1] + 1
                lines.append(f"f {a} {b} {b + 1} {a + 1}")
        count += (steps[0] + 1) * (steps[1] + 1)

    up = (0, 0, 2.5)
    surface("floor", (0, 0, 0), (5, 0, 0), (0, 4, 0))
    surface("wall_south", (5, 0, 0), (-5, 0, 0), up)
    surface("wall_north", (0, 4, 0), (5, 0, 0), up)
    surface("wall_west", (0, 0, 0), (0, 4, 0), up)
    surface("wall_inner", (5, 4, 0), (0, -3, 0), up)
    surface("wall_far", (8, 1, 0), (0, -1, 0), up)
    for z in (0, 2):  # a strip of each wall of the rest
        strip = (0, 0, 0.5)
        surface(f"wall_a{z}", (8, 0, z), (-3, 0, 0), strip)
        surface(f"wall_b{z}", (5, 4, z), (3, 0, 0), strip)
        surface(f"wall_c{z}", (8, 4, z), (0, -3, 0), strip)
    surface("cabinet_top", (1.75, 0.75, 0.5), (0.5, 0, 0), (0, 0.5, 0))
    surface("picture", (4.97, 3, 1), (0, -0.5, 0), (0, 0, 0.5))
    path.write_text("\n".join(lines) + "\n")
