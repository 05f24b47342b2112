#pragma once
// Writing self-contained scenes, whose files are in their folder's tree.

#include "scene/document.h"

#include <string>
#include <vector>

namespace candela {

struct ExportedFile {
  std::string from, to;
};

/// Writes the document as Candela JSON that does not depend on files outside its folder's tree: meshes and
/// pictures and volumes inside are referred to, others are copied to the folder "<stem>_files" next to it,
/// and other meshes are written inline, bit-exactly. Returns the copied files. All files are written
/// atomically; output_error if one cannot be written or the document has a document_problem.
std::vector<ExportedFile> export_candela_json(Document document, const std::string& path);

} // namespace candela
