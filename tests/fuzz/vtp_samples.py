#!/usr/bin/env python3
"""Makes vtp_samples.h: one small surface as VTK's PolyData in several encodings, by Python's own struct, base64 and zlib.

    python3 tests/fuzz/vtp_samples.py > tests/fuzz/vtp_samples.h
"""
from vtu_samples import Writer, print_header

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0.5, 0)]
DEPTH = [0.5 * i for i in range(5)]
LISTS = [("Verts", [[4]]), ("Lines", [[0, 1, 2]]), ("Strips", []), ("Polys", [[0, 1, 2, 3], [1, 4, 2]])]
IDS = [7, 8, 9, 2**31 - 1]
ENCODINGS = {"ascii": ("ascii", False, False, "UInt32", "LittleEndian", "Float64"), "base64": ("inline", True, False, "UInt32", "LittleEndian", "Float64"),
             "base64_zlib": ("inline", True, True, "UInt64", "BigEndian", "Float32"), "raw": ("appended", False, False, "UInt64", "LittleEndian", "Float64"),
             "raw_zlib": ("appended", False, True, "UInt32", "BigEndian", "Float64"),
             "appended_base64_zlib": ("appended", True, True, "UInt32", "LittleEndian", "Float32")}


def sample(where, base, comp, header, order, real):
    w = Writer(where, base, comp, header, order, real)
    counts = " ".join(f'NumberOf{name}="{len(cells)}"' for name, cells in LISTS)
    out = f'<Piece NumberOfPoints="{len(POINTS)}" {counts}>\n<PointData Scalars="depth">\n'.encode() + w.array("Float32", "depth", DEPTH)
    out += b"</PointData>\n<CellData>\n" + w.array("Int32", "id", IDS) + b"</CellData>\n<Points>\n"
    out += w.array(real, "Points", [float(x) for p in POINTS for x in p], 3) + b"</Points>\n"
    for name, cells in LISTS:
        ends, end = [], 0
        for corners in cells:
            end += len(corners)
            ends.append(end)
        out += f"<{name}>\n".encode() + w.array("Int32", "connectivity", [c for corners in cells for c in corners])
        out += w.array("Int32", "offsets", ends) + f"</{name}>\n".encode()
    head = f'<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="{order}" header_type="{header}"'
    head += ' compressor="vtkZLibDataCompressor">\n' if comp else ">\n"
    tail = b"</PolyData>\n"
    if where == "appended":
        tail += f'<AppendedData encoding="{"base64" if base else "raw"}">\n_'.encode() + w.appended + b"\n</AppendedData>\n"
    return head.encode() + b"<PolyData>\n" + out + b"</Piece>\n" + tail + b"</VTKFile>\n"


if __name__ == "__main__":
    print_header("vtp_samples", "One small surface as VTK's PolyData, in several encodings. Made by vtp_samples.py",
                 "Name and bytes: a point, a chain of two lines, a quadrilateral and a triangle.",
                 [(name, sample(*encoding), encoding[0] == "appended" and not encoding[1]) for name, encoding in ENCODINGS.items()])
