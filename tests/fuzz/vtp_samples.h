#pragma once
// One small surface as VTK's PolyData, in several encodings. Made by vtp_samples.py with Python's struct, base64 and zlib; not by hand.
// clang-format off

#include <string_view>
#include <utility>
#include <vector>

namespace dmoscope::testing {

/// Name and bytes: a point, a chain of two lines, a quadrilateral and a triangle.
inline std::vector<std::pair<std::string_view, std::string_view>> vtp_samples() {
  using namespace std::string_view_literals;
  return {
  {"ascii"sv,
    "<\077xml version=\"1.0\"\077>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<PolyData>\n<Piece Num"
    "berOfPoints=\"5\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"2\">\n<PointData Scalars=\"depth\">\n<DataArray t"
    "ype=\"Float32\" Name=\"depth\" format=\"ascii\">\n0.0 0.5 1.0 1.5 2.0\n</DataArray>\n</PointData>\n<CellData>\n<DataArray type=\"Int32\" Name=\""
    "id\" format=\"ascii\">\n7 8 9 2147483647\n</DataArray>\n</CellData>\n<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents="
    "\"3\" format=\"ascii\">\n0.0 0.0 0.0 1.0 0.0 0.0 1.0 1.0 0.0 0.0 1.0 0.0 2.0 0.5 0.0\n</DataArray>\n</Points>\n<Verts>\n<DataArray type=\"In"
    "t32\" Name=\"connectivity\" format=\"ascii\">\n4\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n1\n</DataArray>\n</Ve"
    "rts>\n<Lines>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n0 1 2\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\""
    " format=\"ascii\">\n3\n</DataArray>\n</Lines>\n<Strips>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n\n</DataArray>\n<DataA"
    "rray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n\n</DataArray>\n</Strips>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" forma"
    "t=\"ascii\">\n0 1 2 3 1 4 2\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n4 7\n</DataArray>\n</Polys>\n</Piece>\n</"
    "PolyData>\n</VTKFile>\n"sv},
  {"base64"sv,
    "<\077xml version=\"1.0\"\077>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<PolyData>\n<Piece Num"
    "berOfPoints=\"5\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"2\">\n<PointData Scalars=\"depth\">\n<DataArray t"
    "ype=\"Float32\" Name=\"depth\" format=\"binary\">\n  FAAAAAAAAAAAAAA/AACAPwAAwD8AAABA\n</DataArray>\n</PointData>\n<CellData>\n<DataArray typ"
    "e=\"Int32\" Name=\"id\" format=\"binary\">\n  EAAAAAcAAAAIAAAACQAAAP///38=\n</DataArray>\n</CellData>\n<Points>\n<DataArray type=\"Float64\" Na"
    "me=\"Points\" NumberOfComponents=\"3\" format=\"binary\">\n  eAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "APA/AAAAAAAA8D8AAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAAAAAAAAAAABAAAAAAAAA4D8AAAAAAAAAAA==\n</DataArray>\n</Points>\n<Verts>\n<DataA"
    "rray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n  BAAAAAQAAAA=\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\""
    "binary\">\n  BAAAAAEAAAA=\n</DataArray>\n</Verts>\n<Lines>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n  DAAAAAAAAAABA"
    "AAAAgAAAA==\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">\n  BAAAAAMAAAA=\n</DataArray>\n</Lines>\n<Strips>\n<Da"
    "taArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n  AAAAAA==\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"b"
    "inary\">\n  AAAAAA==\n</DataArray>\n</Strips>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n  HAAAAAAAAAABAAAAA"
    "gAAAAMAAAABAAAABAAAAAIAAAA=\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">\n  CAAAAAQAAAAHAAAA\n</DataArray>\n<"
    "/Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n"sv},
  {"base64_zlib"sv,
    "<\077xml version=\"1.0\"\077>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"BigEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCo"
    "mpressor\">\n<PolyData>\n<Piece NumberOfPoints=\"5\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"2\">\n<PointDa"
    "ta Scalars=\"depth\">\n<DataArray type=\"Float32\" Name=\"depth\" format=\"binary\">\n  AAAAAAAAAAEAAAAAAAAAKAAAAAAAAAAUAAAAAAAAABc=eJxjYGBg"
    "sAfhBiA+wMDgAGQDABSwAj4=\n</DataArray>\n</PointData>\n<CellData>\n<DataArray type=\"Int32\" Name=\"id\" format=\"binary\">\n  AAAAAAAAAAEAAAA"
    "AAAAAKAAAAAAAAAAQAAAAAAAAABc=eJxjYGBgZ2Bg4ABizvr///8DAAjWA5U=\n</DataArray>\n</CellData>\n<Points>\n<DataArray type=\"Float32\" Name=\"Po"
    "ints\" NumberOfComponents=\"3\" format=\"binary\">\n  AAAAAAAAAAIAAAAAAAAAKAAAAAAAAAAUAAAAAAAAABEAAAAAAAAAEg==eJxjYEAA+wZUNjIfAChwAj54nL"
    "NvYAADByC2hzAZABN4AT8=\n</DataArray>\n</Points>\n<Verts>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n  AAAAAAAAAAEAA"
    "AAAAAAAKAAAAAAAAAAEAAAAAAAAAAw=eJxjYGBgAQAACAAF\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">\n  AAAAAAAAAAE"
    "AAAAAAAAAKAAAAAAAAAAEAAAAAAAAAAw=eJxjYGBgBAAABQAC\n</DataArray>\n</Verts>\n<Lines>\n<DataArray type=\"Int32\" Name=\"connectivity\" format"
    "=\"binary\">\n  AAAAAAAAAAEAAAAAAAAAKAAAAAAAAAAMAAAAAAAAAA8=eJxjYAADRiBmAgAAEwAE\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" "
    "format=\"binary\">\n  AAAAAAAAAAEAAAAAAAAAKAAAAAAAAAAEAAAAAAAAAAw=eJxjYGBgBgAABwAE\n</DataArray>\n</Lines>\n<Strips>\n<DataArray type=\"In"
    "t32\" Name=\"connectivity\" format=\"binary\">\n  AAAAAAAAAAAAAAAAAAAAKAAAAAAAAAAA\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" f"
    "ormat=\"binary\">\n  AAAAAAAAAAAAAAAAAAAAKAAAAAAAAAAA\n</DataArray>\n</Strips>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" form"
    "at=\"binary\">\n  AAAAAAAAAAEAAAAAAAAAKAAAAAAAAAAcAAAAAAAAABY=eJxjYAADRiBmAmJmKJsFxAcAAJkADg==\n</DataArray>\n<DataArray type=\"Int32\" N"
    "ame=\"offsets\" format=\"binary\">\n  AAAAAAAAAAEAAAAAAAAAKAAAAAAAAAAIAAAAAAAAABA=eJxjYGBgYWBgYAcAACMADA==\n</DataArray>\n</Polys>\n</Piec"
    "e>\n</PolyData>\n</VTKFile>\n"sv},
  {"raw"sv,
    "<\077xml version=\"1.0\"\077>\n<VTKFile type=\"PolyData\" version=\"1.0\""
    " byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
    "<Piece NumberOfPoints=\"5\" NumberOfVerts=\"1\" NumberOfLines=\"1"
    "\" NumberOfStrips=\"0\" NumberOfPolys=\"2\">\n<PointData Scalars=\""
    "depth\">\n<DataArray type=\"Float32\" Name=\"depth\" format=\"appen"
    "ded\" offset=\"0\"/>\n</PointData>\n<CellData>\n<DataArray type=\"I"
    "nt32\" Name=\"id\" format=\"appended\" offset=\"28\"/>\n</CellData>\n"
    "<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfCom"
    "ponents=\"3\" format=\"appended\" offset=\"52\"/>\n</Points>\n<Verts"
    ">\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"append"
    "ed\" offset=\"180\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" fo"
    "rmat=\"appended\" offset=\"192\"/>\n</Verts>\n<Lines>\n<DataArray t"
    "ype=\"Int32\" Name=\"connectivity\" format=\"appended\" offset=\"20"
    "4\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"appended"
    "\" offset=\"224\"/>\n</Lines>\n<Strips>\n<DataArray type=\"Int32\" N"
    "ame=\"connectivity\" format=\"appended\" offset=\"236\"/>\n<DataArr"
    "ay type=\"Int32\" Name=\"offsets\" format=\"appended\" offset=\"244"
    "\"/>\n</Strips>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connecti"
    "vity\" format=\"appended\" offset=\"252\"/>\n<DataArray type=\"Int3"
    "2\" Name=\"offsets\" format=\"appended\" offset=\"288\"/>\n</Polys>\n"
    "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_\024\000\000\000\000\000\000\000"
    "\000\000\000\000\000\000\000\077\000\000\200\077\000\000\300\077\000\000\000@\020\000\000\000\000\000\000\000\007\000\000\000\010\000\000\000\011\000\000\000\377\377\377\177x\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000"
    "\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\360\077\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\360\077\000\000\000\000\000\000\360\077\000\000\000\000"
    "\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\360\077\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000@\000\000\000\000\000\000\340\077\000\000\000\000\000\000\000\000\004\000\000\000\000\000\000\000"
    "\004\000\000\000\004\000\000\000\000\000\000\000\001\000\000\000\014\000\000\000\000\000\000\000\000\000\000\000\001\000\000\000\002\000\000\000\004\000\000\000\000\000\000\000\003\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000"
    "\000\000\000\000\034\000\000\000\000\000\000\000\000\000\000\000\001\000\000\000\002\000\000\000\003\000\000\000\001\000\000\000\004\000\000\000\002\000\000\000\010\000\000\000\000\000\000\000\004\000\000\000\007\000\000\000\n</A"
    "ppendedData>\n</VTKFile>\n"sv},
  {"raw_zlib"sv,
    "<\077xml version=\"1.0\"\077>\n<VTKFile type=\"PolyData\" version=\"1.0\""
    " byte_order=\"BigEndian\" header_type=\"UInt32\" compressor=\"vtk"
    "ZLibDataCompressor\">\n<PolyData>\n<Piece NumberOfPoints=\"5\" Nu"
    "mberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberO"
    "fPolys=\"2\">\n<PointData Scalars=\"depth\">\n<DataArray type=\"Flo"
    "at32\" Name=\"depth\" format=\"appended\" offset=\"0\"/>\n</PointDat"
    "a>\n<CellData>\n<DataArray type=\"Int32\" Name=\"id\" format=\"appe"
    "nded\" offset=\"39\"/>\n</CellData>\n<Points>\n<DataArray type=\"Fl"
    "oat64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"appended"
    "\" offset=\"78\"/>\n</Points>\n<Verts>\n<DataArray type=\"Int32\" Na"
    "me=\"connectivity\" format=\"appended\" offset=\"153\"/>\n<DataArra"
    "y type=\"Int32\" Name=\"offsets\" format=\"appended\" offset=\"181\""
    "/>\n</Verts>\n<Lines>\n<DataArray type=\"Int32\" Name=\"connectivi"
    "ty\" format=\"appended\" offset=\"209\"/>\n<DataArray type=\"Int32\""
    " Name=\"offsets\" format=\"appended\" offset=\"240\"/>\n</Lines>\n<S"
    "trips>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"a"
    "ppended\" offset=\"268\"/>\n<DataArray type=\"Int32\" Name=\"offset"
    "s\" format=\"appended\" offset=\"280\"/>\n</Strips>\n<Polys>\n<DataA"
    "rray type=\"Int32\" Name=\"connectivity\" format=\"appended\" offs"
    "et=\"292\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ap"
    "pended\" offset=\"330\"/>\n</Polys>\n</Piece>\n</PolyData>\n<Append"
    "edData encoding=\"raw\">\n_\000\000\000\001\000\000\000(\000\000\000\024\000\000\000\027x\234c```\260\007\341\006 >\300\300\340\000d\003\000\024"
    "\260\002>\000\000\000\001\000\000\000(\000\000\000\020\000\000\000\027x\234c```g``\340\000b\316\372\377\377\377\003\000\010\326\003\225\000\000\000\003\000\000\000(\000\000\000\000\000\000\000\017\000\000"
    "\000\021\000\000\000\023x\234c`\300\016\354\077\240\362\001\022(\0010x\234c`\200\000\373\017\2504:\000\000@\220\002_x\234\263\377\300\200\002\034\240\264\375\003Tq\000E\240\002\217\000\000\000"
    "\001\000\000\000(\000\000\000\004\000\000\000\014x\234c```\001\000\000\010\000\005\000\000\000\001\000\000\000(\000\000\000\004\000\000\000\014x\234c```\004\000\000\005\000\002\000\000\000\001\000\000\000"
    "(\000\000\000\014\000\000\000\017x\234c`\000\003F f\002\000\000\023\000\004\000\000\000\001\000\000\000(\000\000\000\004\000\000\000\014x\234c```\006\000\000\007\000\004\000\000\000\000\000\000\000("
    "\000\000\000\000\000\000\000\000\000\000\000(\000\000\000\000\000\000\000\001\000\000\000(\000\000\000\034\000\000\000\026x\234c`\000\003F f\002bf(\233\005\304\007\000\000\231\000\016\000\000\000\001\000\000"
    "\000(\000\000\000\010\000\000\000\020x\234c```a```\007\000\000#\000\014\n</AppendedData>\n</VTKFile>\n"sv},
  {"appended_base64_zlib"sv,
    "<\077xml version=\"1.0\"\077>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\" compressor=\"vtkZLibDat"
    "aCompressor\">\n<PolyData>\n<Piece NumberOfPoints=\"5\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"2\">\n<Poin"
    "tData Scalars=\"depth\">\n<DataArray type=\"Float32\" Name=\"depth\" format=\"appended\" offset=\"0\"/>\n</PointData>\n<CellData>\n<DataArray ty"
    "pe=\"Int32\" Name=\"id\" format=\"appended\" offset=\"52\"/>\n</CellData>\n<Points>\n<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponen"
    "ts=\"3\" format=\"appended\" offset=\"104\"/>\n</Points>\n<Verts>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"appended\" offset=\"18"
    "0\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"appended\" offset=\"220\"/>\n</Verts>\n<Lines>\n<DataArray type=\"Int32\" Name=\"connec"
    "tivity\" format=\"appended\" offset=\"260\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"appended\" offset=\"308\"/>\n</Lines>\n<Strips>"
    "\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"appended\" offset=\"348\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"appen"
    "ded\" offset=\"364\"/>\n</Strips>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"appended\" offset=\"380\"/>\n<DataArray type"
    "=\"Int32\" Name=\"offsets\" format=\"appended\" offset=\"436\"/>\n</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"base64\">\n_AQAAACgAA"
    "AAUAAAAFQAAAA==eJxjYAADewaGBiA+AMQMDgAQeQI+AQAAACgAAAAQAAAAFQAAAA==eJxjZ2Bg4ABiTiD+//9/PQAKngOVAgAAACgAAAAUAAAAEQAAABIAAAA=eJxjYEA"
    "GDfaobAQfACS5Aj54nGNgaLBngAAHIAazARC+AT8=AQAAACgAAAAEAAAADAAAAA==eJxjYWBgAAAAFAAFAQAAACgAAAAEAAAADAAAAA==eJxjZGBgAAAACAACAQAAACgAA"
    "AAMAAAAEQAAAA==eJxjYGBgYARiJiAGAAAcAAQ=AQAAACgAAAAEAAAADAAAAA==eJxjZmBgAAAAEAAEAAAAACgAAAAAAAAAAAAAACgAAAAAAAAAAQAAACgAAAAcAAAAFgA"
    "AAA==eJxjYGBgYARiJiBmhrJZoHwAAMAADg==AQAAACgAAAAIAAAADgAAAA==eJxjYWBgYAdiAABEAAw=\n</AppendedData>\n</VTKFile>\n"sv},
  };
}

}  // namespace dmoscope::testing
