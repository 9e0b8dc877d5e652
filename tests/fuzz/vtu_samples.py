#!/usr/bin/env python3
"""Makes vtu_samples.h: one small mesh in every encoding of VTU, by Python's own struct, base64 and zlib.

    python3 tests/fuzz/vtu_samples.py > tests/fuzz/vtu_samples.h
"""
import base64
import struct
import zlib

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0.5, 0.5, 2), (2, 0.25, 0.5)]
# VTK's type, corners: a hexahedron with a pyramid on top and a tetrahedron aside, the same hexahedron as a voxel, a line, a face.
CELLS = [(12, [0, 1, 2, 3, 4, 5, 6, 7]), (3, [0, 1]), (14, [4, 5, 6, 7, 8]), (9, [0, 1, 2, 3]), (10, [1, 2, 5, 9]),
         (11, [0, 1, 3, 2, 4, 5, 7, 6]), (13, [0, 1, 2, 4, 5, 6])]
DEPTH = [0.5 * i for i in range(10)]
FLOW = [0.25 * i - 1 for i in range(30)]
ID = [7, 8, 9, 10, 11, 12, 2**31 - 1]
CODE = {"Int8": "b", "UInt8": "B", "Int32": "i", "Int64": "q", "UInt32": "I", "UInt64": "Q", "Float32": "f", "Float64": "d"}


class Writer:
    def __init__(self, where, base, comp, header, order, real, block=40):
        self.where, self.base, self.comp, self.header, self.order, self.real, self.block = where, base, comp, header, order, real, block
        self.appended = b""

    def sign(self):
        return ">" if self.order == "BigEndian" else "<"

    def sizes(self, *numbers):
        return struct.pack(self.sign() + str(len(numbers)) + CODE[self.header], *numbers)

    def encode(self, raw):
        enc = base64.b64encode if self.base else bytes
        if not self.comp:
            return enc(self.sizes(len(raw)) + raw)
        blocks = [raw[i:i + self.block] for i in range(0, len(raw), self.block)]
        packed = [zlib.compress(b) for b in blocks]
        return enc(self.sizes(len(blocks), self.block, len(raw) % self.block, *map(len, packed))) + enc(b"".join(packed))

    def array(self, kind, name, values, components=1):
        head = f'<DataArray type="{kind}" Name="{name}"' + (f' NumberOfComponents="{components}"' if components > 1 else "")
        if self.where == "ascii":
            return (head + ' format="ascii">\n' + " ".join(repr(v) for v in values) + "\n</DataArray>\n").encode()
        data = self.encode(struct.pack(self.sign() + str(len(values)) + CODE[kind], *values))
        if self.where == "inline":
            return (head + ' format="binary">\n  ').encode() + data + b"\n</DataArray>\n"
        self.appended += data
        return (head + f' format="appended" offset="{len(self.appended) - len(data)}"/>\n').encode()

    def piece(self, points, cells, depth, flow, ids):
        out = f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<PointData Scalars="depth" Vectors="flow">\n'.encode()
        out += self.array("Float32", "depth", depth) + self.array("Float64", "flow", flow, 3) + b"</PointData>\n<CellData>\n"
        out += self.array("Int32", "id", ids) + b"</CellData>\n<Points>\n"
        out += self.array(self.real, "Points", [float(x) for p in points for x in p], 3) + b"</Points>\n<Cells>\n"
        ends, end = [], 0
        for _, corners in cells:
            end += len(corners)
            ends.append(end)
        out += self.array("Int64", "connectivity", [c for _, corners in cells for c in corners])
        out += self.array("Int32", "offsets", ends) + self.array("UInt8", "types", [t for t, _ in cells]) + b"</Cells>\n</Piece>\n"
        return out

    def file(self, pieces):
        body = b"".join(self.piece(*p) for p in pieces)
        out = f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="{self.order}" header_type="{self.header}"'
        out += ' compressor="vtkZLibDataCompressor"' if self.comp else ""
        out = (out + ">\n<UnstructuredGrid>\n").encode() + body + b"</UnstructuredGrid>\n"
        if self.where == "appended":
            out += f'<AppendedData encoding="{"base64" if self.base else "raw"}">\n   _'.encode() + self.appended + b"\n</AppendedData>\n"
        return out + b"</VTKFile>\n"


WHOLE = [(POINTS, CELLS, DEPTH, FLOW, ID)]
TRIANGLES = [([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(5, [0, 1, 2])], [1.0, 2.0, 3.0], [0.0] * 9, [4]),
             ([], [], [], [], []),
             ([(1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 1, 0)], [(5, [0, 1, 2]), (5, [0, 3, 1])], [5.0, 6.0, 7.0, 8.0], [1.0] * 12, [5, 6])]
SAMPLES = [
    ("ascii", Writer("ascii", False, False, "UInt64", "LittleEndian", "Float64"), WHOLE),
    ("base64", Writer("inline", True, False, "UInt32", "BigEndian", "Float32"), WHOLE),
    ("base64_zlib", Writer("inline", True, True, "UInt64", "LittleEndian", "Float64"), WHOLE),
    ("raw", Writer("appended", False, False, "UInt32", "LittleEndian", "Float64"), WHOLE),
    ("raw_zlib", Writer("appended", False, True, "UInt32", "BigEndian", "Float32"), WHOLE),
    ("appended_base64", Writer("appended", True, False, "UInt64", "LittleEndian", "Float32"), WHOLE),
    ("appended_base64_zlib", Writer("appended", True, True, "UInt64", "BigEndian", "Float64"), WHOLE),
    ("pieces_ascii", Writer("ascii", False, False, "UInt32", "LittleEndian", "Float32"), TRIANGLES),
    ("pieces_raw", Writer("appended", False, False, "UInt64", "LittleEndian", "Float32"), TRIANGLES),
    ("pieces_zlib", Writer("appended", False, True, "UInt32", "LittleEndian", "Float64"), TRIANGLES),
]


def literal(line):
    """Some bytes as a C++ string literal; a digit after an escape would belong to it, so escapes are octal and whole."""
    text = "".join(chr(c) if 32 <= c < 127 and c not in b'"\\?' else "\\n" if c == 10 else '\\"' if c == 34 else f"\\{c:03o}" for c in line)
    return f'    "{text}"'


def print_header(function, said, doc, samples):
    """`samples`: name, bytes, and whether few of these are letters."""
    print(f'''#pragma once
// {said} with Python's struct, base64 and zlib; not by hand.
// clang-format off

#include <string_view>
#include <utility>
#include <vector>

namespace dmoscope::testing {{

/// {doc}
inline std::vector<std::pair<std::string_view, std::string_view>> {function}() {{
  using namespace std::string_view_literals;
  return {{''')
    for name, data, binary in samples:
        width = 60 if binary else 130
        lines = [data[i:i + width] for i in range(0, len(data), width)]
        print(f'  {{"{name}"sv,')
        print("\n".join(literal(line) for line in lines) + "sv},")
    print('''  };
}

}  // namespace dmoscope::testing''')


if __name__ == "__main__":
    print_header("vtu_samples", "One small mesh in every encoding of VTU. Made by vtu_samples.py",
                 'Name and bytes. Those named "pieces..." hold three triangles in two pieces and an empty one, the others volume elements.',
                 [(name, writer.file(pieces), writer.where == "appended" and not writer.base) for name, writer, pieces in SAMPLES])
