#pragma once
// A scene that stands on its own: what it needs lies in its folder's tree.

#include "scene/document.h"

#include <string>
#include <vector>

namespace candela {

struct ExportedFile {
  std::string from, to;
};

/// Writes the document as Candela JSON that reads back the same without files outside of its folder's tree:
/// meshes and pictures inside of it are named where they are, pictures from elsewhere are copied, byte by
/// byte, to the folder "<stem>_files" beside it, meshes from elsewhere are written inline, which keeps every
/// bit. Returns what was copied. All files appear whole or not at all; output_error if one cannot be written
/// or the document has a document_problem.
std::vector<ExportedFile> export_candela_json(Document document, const std::string& path);

} // namespace candela
