# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Ellipsoids at meshes by numpy: contacts by a look at every feature, passes by every chain of faces, and the weights of doc/notes/corners.md by
every set of bearing contacts. Overlaps are below the least radius of curvature."""
import itertools

import numpy as np

LESS, NARROW = 1e-6, 100
LEAST = 0.1    # eigenvalue: below, a matrix may not be positive but for rounding


def turned_by(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Ellipsoid:
    def __init__(self, half, quaternion, centre):
        self.half, self.turn, self.x = np.array(half), turned_by(quaternion), np.array(centre)
        self.least = self.half.min()
        self.rho = self.least**2 / self.half.max()

    def height(self, n):
        """The support function."""
        return np.linalg.norm(self.half * (self.turn.T @ n))

    def point(self, n):
        """Of the surface, from the centre, with the normal n."""
        u = self.half * (self.turn.T @ n)
        return self.turn @ (self.half * u) / np.linalg.norm(u)

    def radius(self, arm):
        """1 over the mean curvature at a point."""
        y = self.turn.T @ arm
        slope, bend = y / self.half**2, 1 / self.half**2
        size = np.linalg.norm(slope)
        return 2 * size**3 / (size**2 * bend.sum() - slope @ (bend * slope))

    def on_line(self, y, along):
        """The least overlap over the normals across a line through y, and the normal; 0 away from the sphere around the grain."""
        away = np.cross(along, self.x - y)
        if away @ away >= self.half.max()**2:
            return 0, None
        first = np.array([np.cross(along, np.eye(3)[np.abs(along).argmin()])])
        first = np.array([first[0], np.cross(along, first[0])]) / np.linalg.norm(first)
        angles = np.arange(256) * 2 * np.pi / 256
        normals = np.cos(angles)[:, None] * first[0] + np.sin(angles)[:, None] * first[1]
        overlap = np.linalg.norm(self.half * (normals @ self.turn), axis=1) - normals @ (y - self.x)
        angle = angles[overlap.argmin()]
        scaled = self.half[:, None] * (self.turn.T @ first.T)    # the support function is |scaled (cos, sin)|
        square, at = scaled.T @ scaled, first @ (y - self.x)
        for _ in range(12):
            n, t = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
            h = np.sqrt(n @ square @ n)
            slope = t @ square @ n / h - t @ at
            bend = (t @ square @ t - n @ square @ n) / h - (t @ square @ n)**2 / h**3 + n @ at
            angle -= slope / bend
        n = np.cos(angle) * first[0] + np.sin(angle) * first[1]
        return self.height(n) - n @ (y - self.x), n

    def at_point(self, y):
        """The overlap of a point, and the normal; 0 outside."""
        own = self.turn.T @ (y - self.x)
        if np.sum((own / self.half)**2) >= 1:
            return 0, None
        low, high = -self.least**2 + self.least * abs(own[self.half.argmin()]), 0.0
        for _ in range(200):
            t = (low + high) / 2
            low, high = (t, high) if np.sum((self.half * own / (t + self.half**2))**2) > 1 else (low, t)
        p = self.half**2 * own / (t + self.half**2)
        n = p / self.half**2
        return np.linalg.norm(p - own), self.turn @ (n / np.linalg.norm(n))


class Surface:
    def __init__(self, vertices, faces):
        self.vertices, self.faces = np.array(vertices), [tuple(f) for f in faces]
        self.faces_of = {}
        for i, f in enumerate(self.faces):
            for k in range(3):
                self.faces_of.setdefault(frozenset((f[k], f[(k + 1) % 3])), []).append(i)

    def inwards(self, face, edge):
        a, b = (self.vertices[v] for v in edge)
        c = self.vertices[next(v for v in self.faces[face] if v not in edge)]
        along = (b - a) / np.linalg.norm(b - a)
        return (c - a) - along * (along @ (c - a))

    def contacts(self, grain):
        """Of each: overlap, normal out of the grain, faces at it."""
        found = []
        for i, f in enumerate(self.faces):
            a, b, c = (self.vertices[v] for v in f)
            n = np.cross(b - a, c - a)
            n /= np.linalg.norm(n)
            n = n if n @ (a - grain.x) > 0 else -n
            overlap = grain.height(n) - n @ (a - grain.x)
            p = grain.x + grain.point(n)
            if overlap > 0 and all(np.cross(v - u, p - u) @ np.cross(b - a, c - a) > 0 for u, v in ((a, b), (b, c), (c, a))):
                found.append((overlap, n, [i]))
        self.depth = {}
        for edge, faces in self.faces_of.items():
            a, b = (self.vertices[v] for v in edge)
            length = np.linalg.norm(b - a)
            overlap, n = grain.on_line(a, (b - a) / length)
            at = (grain.x + grain.point(n) - a) @ (b - a) / length if overlap > 0 else 0
            is_here = overlap > 0 and 0 < at < length
            self.depth[edge] = max(overlap, 0) if is_here else max(grain.at_point(a)[0], grain.at_point(b)[0])
            if is_here and all(n @ self.inwards(face, edge) > 0 for face in faces):
                found.append((overlap, n, faces))
        for v, y in enumerate(self.vertices):
            overlap, n = grain.at_point(y)
            edges = [edge for edge in self.faces_of if v in edge]
            if overlap > 0 and all(n @ (self.vertices[next(iter(edge - {v}))] - y) > 0 for edge in edges):
                found.append((overlap, n, sorted({f for edge in edges for f in self.faces_of[edge]})))
        return found

    def passes(self, contacts):
        """The largest, over all chains of faces, of the least overlap of the edges that are crossed, by Kruskal's forest."""
        n, group = len(contacts), list(range(len(self.faces)))

        def of(face):
            while group[face] != face:
                face = group[face]
            return face

        highest = np.zeros((n, n))
        for depth, edge in sorted(((d, tuple(e)) for e, d in self.depth.items() if d > 0), reverse=True):
            first, *rest = self.faces_of[frozenset(edge)]
            for face in rest:
                group[of(face)] = of(first)
            for i, j in itertools.permutations(range(n), 2):
                if highest[i, j] == 0 and {of(f) for f in contacts[i][2]} & {of(f) for f in contacts[j][2]}:
                    highest[i, j] = depth
        return highest


class Shared:
    """How the contacts of a grain with one or more surfaces share, if that is sure."""

    def __init__(self, grain, surfaces):
        self.grain = grain
        of_each = [surface.contacts(grain) for surface in surfaces]
        self.surface = [k for k, found in enumerate(of_each) for _ in found]
        self.overlap = np.array([c[0] for found in of_each for c in found])
        self.normal = np.array([c[1] for found in of_each for c in found]).reshape(-1, 3)
        self.arm = np.array([grain.point(n) for n in self.normal]).reshape(-1, 3)
        n, self.is_sure = len(self.overlap), False
        if n == 0 or self.overlap.max() > 0.95 * grain.rho:
            return
        self.cover, self.couple = np.eye(n), np.zeros((n, n, 3))
        self.fade = np.zeros(n)
        first = 0
        for surface, found in zip(surfaces, of_each):
            highest = surface.passes(found)
            for i, j in itertools.permutations(range(len(found)), 2):
                if highest[i, j] > 0:
                    self.fade[first + i] = max(self.fade[first + i], self.fades(first + i, first + j, highest[i, j]))
            first += len(found)
        for i, j in itertools.permutations(range(n), 2):
            self.cover_of(i, j)
        self.matrix = self.cover + np.diag(self.fade)
        self.is_sure = np.linalg.eigvalsh(self.matrix)[0] > LEAST
        if self.is_sure:
            self.share()

    def fades(self, i, j, b):
        own, other = np.sqrt(self.overlap[[i, j]] - b)
        f = own / (own + other)
        return 0.3 * (0.2 / f - 1)**2 * (b / self.overlap[i])**2 if f < 0.2 else 0

    def cover_of(self, i, j):
        grain, a, b = self.grain, self.normal[i], self.normal[j]
        c, s = a @ b, a + b
        if c <= 0:
            return
        size, apart = np.linalg.norm(s), np.linalg.norm(a - b)
        r = (grain.height(a) + grain.height(b) - grain.height(s)) * (2 + size) / apart**2
        x = max(0, r - grain.rho) * apart
        g = c * np.exp(-x**2 / (2 * grain.least**2))
        u = 1 - g
        self.cover[i, j] = 1 - (u + LESS * (1 - u) * NARROW * u / (1 + NARROW * u))
        t = np.cross(grain.point(a), a) + np.cross(grain.point(b), b) - np.cross(grain.point(s), s)
        self.couple[i, j] = -g * x / grain.least**2 * (2 + size) / apart * t

    def share(self):
        d, n = self.overlap, len(self.overlap)
        # Where three and more share: s/2 m (l/d - 1/m)^2, with the least s.
        matrix, pull = self.matrix, d
        shares = (self.cover - np.eye(n)).any(axis=1)
        if shares.sum() > 2:
            s = 1e-12 * d[shares].max()**2
            covered = 1 + (self.cover - np.eye(n)) @ (d / (1 + self.fade)) / d
            matrix, pull = matrix + np.diag(shares * s * covered / d**2), d + shares * s / d
        for bearing in itertools.chain(*(itertools.combinations(range(n), m) for m in range(1, n + 1))):
            bearing = list(bearing)
            pressed = np.zeros(n)
            pressed[bearing] = np.linalg.solve(matrix[np.ix_(bearing, bearing)], pull[bearing])
            if (pressed >= 0).all() and (pull - matrix @ pressed <= 1e-13 * d.max()).all():
                self.pressed, self.weight = pressed, pressed / d
                return
        raise AssertionError("no set of contacts bears")

    def couples(self, stiffness):
        """The torque on the grain, half of each pair's at either contact."""
        at, n = np.zeros((len(self.overlap), 3)), len(self.overlap)
        for i, j in itertools.permutations(range(n), 2):
            at[i] += np.sqrt(stiffness[i] * stiffness[j]) * self.pressed[i] * self.pressed[j] * self.couple[i, j] / 2
        return at
