"""Binary PLY: triangles with normals."""

from struct import pack


def write_ply(file, comment, vertices, triangles):
    """vertices: (x, y, z, nx, ny, nz); triangles: three indices each."""
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"comment {comment}\n"
            f"element vertex {len(vertices)}\n"
            + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
            + f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    with open(file, "wb") as out:
        out.write(head.encode())
        for vertex in vertices:
            out.write(pack("<6f", *vertex))
        for triangle in triangles:
            out.write(pack("<B3i", 3, *triangle))
