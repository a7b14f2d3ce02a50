"""Random scenes: what `run` beside this file tries. A scene is drawn once from its number, free of units and of the names
of axes, and written as a case file in any system of units (factors that are powers of ten) and along any axes."""

import math
import random
from dataclasses import dataclass
from pathlib import Path

MESHES = Path(__file__).resolve().parent / "meshes"
AXES = "xyz"
#: of files: element, dimensions, groups that are plane, groups that are curved or have corners, spacing at level 0
FILES = {
    "annulus": ("quadrilateral", 2, (), ("inner", "outer"), 0.22),
    "graded": ("triangle", 2, ("left", "right"), ("rest",), 0.2),
    "l_blocks": ("quadrilateral", 2, ("tip", "foot"), ("rest",), 0.125),
    "octant": ("tetrahedron", 3, ("px", "py", "pz"), ("sphere",), 0.35),
    "plate": ("triangle", 2, ("left", "right"), ("rest", "hole"), 0.12),
    "prism": ("hexahedron", 3, ("bottom", "top"), ("side",), 0.25),
    "quarter_ring": ("quadrilateral", 2, ("xs", "ys"), ("inner", "outer"), 0.12),
    "rod": ("tetrahedron", 3, ("left", "right"), ("side",), 0.2),
}


@dataclass(frozen=True)
class Units:
    """Factors of a system of units over SI; powers of ten, so that the digits of a case file stay."""

    length: float = 1
    stress: float = 1
    density: float = 1

    def energy(self, dim):
        """Of bodies in space and of slices one metre thick."""
        return self.stress * self.length**dim

    @property
    def time(self):
        return self.length * math.sqrt(self.density / self.stress)


def number(value, digits=4):
    return float(f"%.{digits}g" % value)


def plain(value, factor=1):
    return "%.8g" % (value * factor)


class Scene:
    """What a number stands for: lengths over metres, stresses over the shear modulus, times over the duration."""

    def __init__(self, seed):
        r = random.Random(seed)
        self.seed = seed
        self.file = r.choice(list(FILES)) if r.random() < 0.3 else None
        if self.file:
            self.element, self.dim, plane, other, self.spacing = FILES[self.file]
            self.sides = [(group, True) for group in plane] + [(group, False) for group in other]
            self.lengths, self.lower = [1] * self.dim, [0] * self.dim
        else:
            self.element = r.choice(["hexahedron", "hexahedron", "tetrahedron", "quadrilateral", "quadrilateral", "triangle"])
            self.dim = 3 if self.element in ("hexahedron", "tetrahedron") else 2
            self.sides = [((axis, side), True) for axis in range(self.dim) for side in ("min", "max")]
            unit = r.choice([1, 1, 1, 1e-3, 1e-6, 1e3])
            self.lengths = [number(unit * r.uniform(0.4, 2)) for _ in range(self.dim)]
            self.lower = [r.choice([0, 0, 3 * length]) for length in self.lengths]
            across = min(self.lengths) / r.choice([2, 3, 4, 5] if self.dim == 3 else [3, 4, 6, 8])
            self.cells = [min(14, max(2, round(length / across / r.choice([1, 1, 1.5])))) for length in self.lengths]
        self.moved = 0 if self.file or r.random() < 0.7 else r.choice([0.1, 0.2, 0.3])
        self.draw_material(r)
        self.draw_loads(r)
        self.draw_options(r)

    def draw_material(self, r):
        self.model = r.choice(["mooney-rivlin", "mooney-rivlin", "neo-hookean", "neo-hookean-isochoric", "neo-hookean-isochoric-j2"])
        self.mu, self.rho = r.choice([1e6, 1e6, 1e3, 8e10]), r.choice([1000, 1100, 7800])
        nu = r.choice([0.1, 0.2, 0.3, 0.3, 0.4, 0.45, 0.49, 0.499])
        lame = 2 * self.mu * nu / (1 - 2 * nu)
        self.bulk = number(lame + 2 * self.mu / 3, 8)
        self.zeta_ratio = 0
        if self.model == "mooney-rivlin":
            self.zeta_ratio = number(r.choice([0, 0.25, 0.5, 0.8]) * min(0.9, 0.9 * lame / (2 * self.mu)))
        crossing = max(self.lengths) * math.sqrt(self.rho / (self.bulk + 4 * self.mu / 3))
        self.end = number(crossing * r.choice([2, 4, 8]) * (3 if nu > 0.48 else 1))
        self.branches = []
        for _ in range(r.choice([0, 0, 1, 1, 2])):
            branch = {"beta_C": r.choice([0.3, 1, 3]), "tau_C": number(self.end * 10 ** r.uniform(-5, 1))}
            if self.zeta_ratio > 0 and r.random() < 0.5:
                branch |= {"beta_G": r.choice([0.3, 1]), "tau_G": number(self.end * 10 ** r.uniform(-4, 1))}
            self.branches.append(branch)

    def draw_loads(self, r):
        self.amplitude = r.choice([1e-6, 1e-3, 0.02, 0.1, 0.3])
        speed = self.amplitude * math.sqrt(self.mu / self.rho)
        in_time = r.choice(["1", "sin(pi*t/T)^2", "(t < T/2 ? sin(2*pi*t/T)^2 : 0)", "(t < 0.3*T ? 1 : 0)", "sin(20*t/T)"])

        def vector(size):
            return [number(size * r.uniform(-1, 1)) for _ in range(self.dim)]

        def in_place(group):
            axis = r.randrange(self.dim)
            if not isinstance(group, str) and axis == group[0]:  # where it may be zero
                axis = (axis + 1) % self.dim
            return r.choice([lambda at: "1", lambda at: "1", lambda at: f"(1 + cos(pi*{at(axis)}))/2"])

        self.boundary = []
        is_driven = False
        for group, is_plane in self.sides:
            kind = r.choice(["", "", "fixed", "symmetry", "traction", "traction", "pressure", "velocity", "rigid-wall"])
            if not kind or (kind == "symmetry" and not is_plane) or (kind == "rigid-wall" and isinstance(group, str)):
                continue
            entry = {"group": group, "type": kind}
            if kind == "traction":
                entry |= {"vector": vector(self.amplitude * self.mu), "time": in_time, "place": in_place(group), "of": "stress"}
            elif kind == "pressure":
                entry |= {"scalar": number(self.amplitude * self.mu * r.uniform(-0.5, 1.5)), "time": in_time}
            elif kind == "velocity":
                entry |= {"vector": vector(0.3 * speed), "time": r.choice(["1", "sin(2*pi*t/T)^2", "sin(4*pi*t/T)"]),
                          "place": lambda at: "1", "of": "speed"}
            elif kind == "rigid-wall":
                entry["gap"] = r.choice([0, 0, 0.1 * self.amplitude])
            is_driven = is_driven or kind not in ("fixed", "symmetry", "rigid-wall")
            self.boundary.append(entry)
        self.velocity, self.relaxed = None, False
        if not is_driven or r.random() < 0.3:
            shape = r.choice([lambda at, a, b: f"sin(pi*{at(a)})", lambda at, a, b: f"cos(pi*{at(a)})", lambda at, a, b: f"{at(a)}^2",
                              lambda at, a, b: f"sin(pi*{at(a)})*sin(pi*{at(b)})"])
            self.velocity = [(number(0.5 * speed * r.uniform(-1, 1)), r.randrange(self.dim), r.randrange(self.dim), shape)
                             for _ in range(self.dim)]
            self.relaxed = r.random() < 0.3
        self.displacement = None
        if r.random() < 0.15:
            self.displacement = [(number(0.2 * self.amplitude * max(self.lengths) * r.uniform(-1, 1)), r.randrange(self.dim))
                                 for _ in range(self.dim)]
        self.body_force = vector(self.amplitude * self.mu / max(self.lengths)) if r.random() < 0.2 else None
        self.body_force_time = in_time

    def draw_options(self, r):
        """Half of all scenes keep the library's defaults."""
        self.integrator = r.choice(["ssp-rk3", "ssp-rk2", "ssp-rk43"]) if r.random() < 0.2 else None
        self.scheme = {}
        if r.random() < 0.15:
            self.scheme["unknowns"] = r.choice(["F", "FJ"])
        if r.random() < 0.1:
            self.scheme["volumes"] = r.choice(["cells", "nodes"])
        if r.random() < 0.1:
            self.scheme["precision"] = r.choice(["mixed", "single"])
        if r.random() < 0.07:
            self.scheme["limiter"] = r.choice(["venkatakrishnan", "sign-preserving"])
        if r.random() < 0.05:
            self.scheme["reconstruction"] = r.choice(["none", "linear", "objective"])
        self.projection = r.random() < 0.05

    @property
    def has_equal_axes(self):
        """Whether nodes and cells are the same along other axes: no diagonals, no random shift."""
        return not self.file and not self.moved and self.element in ("hexahedron", "quadrilateral")

    def wall(self, entry, units, axes):
        """Plane and normal of a wall in front of a side of a box."""
        axis, side = entry["group"]
        out = 1 if side == "max" else -1
        length, low = self.lengths[axis], self.lower[axis]
        point, normal = ["0"] * self.dim, ["0"] * self.dim
        point[axes[axis]] = plain(low + (length if out > 0 else 0) + out * entry["gap"] * length, units.length)
        normal[axes[axis]] = str(-out)
        return [f"point = [{', '.join(point)}]", f"normal = [{', '.join(normal)}]"]

    def text(self, units=Units(), axes=None, frames=8):
        """The case file.
        axes: where each axis of the scene lies, a permutation of 0 to dim - 1"""
        axes = axes or range(self.dim)

        def along(values):
            """A list of the scene as one of the case file."""
            placed = [None] * self.dim
            for axis, value in zip(axes, values):
                placed[axis] = value
            return "[" + ", ".join(placed) + "]"

        def at(axis):
            return f"(({AXES[axes[axis]]} - {plain(self.lower[axis], units.length)})/{plain(self.lengths[axis], units.length)})"

        speed = units.length / units.time
        lines = [f'title = "Scene {self.seed}"', "[parameters]", f"T = {plain(self.end, units.time)}", "[mesh]", f'element = "{self.element}"']
        if self.file:
            lines += [f'file = "{MESHES / self.file}.geo"', f"size = {self.spacing}"]
        else:
            upper = [low + length for low, length in zip(self.lower, self.lengths)]
            lines += ["lower = " + along([plain(value, units.length) for value in self.lower]),
                      "upper = " + along([plain(value, units.length) for value in upper]),
                      "cells = " + along([str(n) for n in self.cells]), f"perturbation = {self.moved}"]
        lines += ["[material]", f'model = "{self.model}"', f"density = {plain(self.rho, units.density)}",
                  f"shear_modulus = {plain(self.mu, units.stress)}", f"bulk_modulus = {plain(self.bulk, units.stress)}"]
        if self.model == "mooney-rivlin":
            lines.append(f"zeta_ratio = {self.zeta_ratio}")
        for branch in self.branches:
            lines.append("[[material.branch]]")
            lines += [f"{key} = {plain(value, units.time if key.startswith('tau') else 1)}" for key, value in branch.items()]
        for entry in self.boundary:
            group = entry["group"]
            name = group if isinstance(group, str) else f"{AXES[axes[group[0]]]}_{group[1]}"
            lines += ["[[boundary]]", f'group = "{name}"', f'type = "{entry["type"]}"']
            if "vector" in entry:
                factor = units.stress if entry["of"] == "stress" else speed
                lines.append("value = " + along([f'"{plain(value, factor)}*{entry["time"]}*{entry["place"](at)}"' for value in entry["vector"]]))
            if "gap" in entry:
                lines += self.wall(entry, units, axes)
            if "scalar" in entry:
                lines.append(f'value = "{plain(entry["scalar"], units.stress)}*{entry["time"]}"')
        if self.velocity or self.displacement:
            lines.append("[initial]")
        if self.displacement:
            lines.append("displacement = " + along([f'"{plain(value, units.length)}*sin(pi*{at(a)})"' for value, a in self.displacement]))
        if self.velocity:
            lines += ["velocity = " + along([f'"{plain(value, speed)}*{shape(at, a, b)}"' for value, a, b, shape in self.velocity])]
            lines += ['internal = "relaxed"'] if self.relaxed else []
        if self.body_force:
            lines += ["[load]", "body_force = " + along([f'"{plain(value, units.stress / units.length)}*{self.body_force_time}"'
                                                         for value in self.body_force])]
        lines += ["[time]", 'end = "T"'] + ([f'integrator = "{self.integrator}"'] if self.integrator else [])
        lines += ["[output]", f"frames = {frames}", "fields = false", "[scheme]"]
        lines += [f'{key} = "{value}"' for key, value in self.scheme.items()]
        lines += ["angular_momentum_projection = true"] if self.projection else []
        for axis in AXES[: self.dim]:
            lines += ["[[probe]]", f'name = "mean u{axis}"', 'unit = "m"', 'kind = "mean"', f'quantity = "u{axis}"']
        return "\n".join(lines) + "\n"
