#include "render/face_records.h"

namespace dmoscope::render {

void records_of(const ElementTable& elements, std::span<const ElementFace> faces, std::vector<FaceRecord>& records, ThreadPool* pool) {
  records.resize(faces.size());
  for_chunks(pool, faces.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) records[i] = {vertices_of(elements, faces[i]), faces[i].element};
  });
}

void records_of(const PlaneCuts& cuts, std::vector<FaceRecord>& records) {
  records.clear();
  for (const CutPolygon& polygon : cuts.polygons) {
    const Index p = polygon.first;
    if (polygon.count == 4) {
      records.push_back({{p, p + 1, p + 2, p + 3}, polygon.element});
      continue;
    }
    for (Index i = 1; i + 1 < polygon.count; ++i) {
      const Index inner = (i > 1 ? 1U : 0U) + (i + 2 < polygon.count ? 4U : 0U);
      records.push_back({{p, p + i, p + i + 1, kNoIndex - inner}, polygon.element});
    }
  }
}

}  // namespace dmoscope::render
