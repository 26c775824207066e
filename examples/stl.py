"""Write triangles as a binary STL file."""
import math
import struct


def write_stl(path, triangles, title):
    """`triangles` are triples of (x, y, z); the normal is the winding's."""
    with open(path, "wb") as out:
        out.write(title.encode().ljust(80, b" "))
        out.write(struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            u = [b[k] - a[k] for k in range(3)]
            w = [c[k] - a[k] for k in range(3)]
            n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
            size = math.hypot(*n) or 1
            out.write(struct.pack("<12fH", *(x / size for x in n), *a, *b, *c, 0))
    print(f"{path}: {len(triangles)} facets")
