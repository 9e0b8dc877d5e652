# Writes a C++ source that has the text of headers: see formula_headers(). Arguments: ROOT, HEADERS (names below it), STANDARD (stand-ins for
# headers of the standard library, by their files' names), OUTPUT.
set(content "// Made by embed_headers.cmake.\n#include \"gpu/defined/formula_source.h\"\n\nnamespace dmoscope::gpu {\n\nconst std::vector<SourceHeader>& formula_headers() {\n  static const std::vector<SourceHeader> headers{\n")
foreach(header ${HEADERS})
  file(READ ${ROOT}/${header} text)
  string(APPEND content "      {\"${header}\", R\"header(${text})header\"},\n")
endforeach()
foreach(header ${STANDARD})
  cmake_path(GET header STEM name)
  file(READ ${header} text)
  string(APPEND content "      {\"${name}\", R\"header(${text})header\"},\n")
endforeach()
string(APPEND content "  };\n  return headers;\n}\n\n}  // namespace dmoscope::gpu\n")
file(WRITE ${OUTPUT} "${content}")
