#include "io/obj/obj_writer.h"

#include "core/color.h"
#include "io/files/atomic_file.h"

#include <fmt/format.h>

#include <iterator>

namespace candela {

namespace {

/// Collects text and writes it in large pieces: an OBJ of a million triangles has a hundred megabytes.
class TextPieces {
public:
  explicit TextPieces(PendingFile& file) : file_(file) {}

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
    if (buffer_.size() >= kPiece) flush();
  }
  void flush() {
    file_.write({reinterpret_cast<const std::uint8_t*>(buffer_.data()), buffer_.size()});
    buffer_.clear();
  }

private:
  static constexpr std::size_t kPiece = 1 << 20;
  PendingFile& file_;
  fmt::memory_buffer buffer_;
};

} // namespace

void write_obj(const Mesh& mesh, const std::string& library, const std::string& path) {
  PendingFile file(path);
  TextPieces text(file);
  if (!library.empty()) text.add("mtllib {}\n", library);
  auto srgb = [](float x) { return srgb_from_linear(std::clamp(x, 0.0f, 1.0f)); };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 p = mesh.positions[i];
    text.add("v {:.7g} {:.7g} {:.7g}", p.x, p.y, p.z);
    if (!mesh.vertex_colors.empty()) {
      const vec3 c = mesh.vertex_colors[i];
      text.add(" {:.7g} {:.7g} {:.7g}", srgb(c.x), srgb(c.y), srgb(c.z));
    }
    text.add("\n");
  }
  for (const vec2& uv : mesh.uvs) text.add("vt {:.7g} {:.7g}\n", uv.x, uv.y);
  for (const vec3& n : mesh.normals) text.add("vn {:.7g} {:.7g} {:.7g}\n", n.x, n.y, n.z);
  const bool uvs = !mesh.uvs.empty(), normals = !mesh.normals.empty();
  auto corner = [&](std::uint32_t i) {
    if (uvs && normals)
      text.add(" {0}/{0}/{0}", i + 1);
    else if (normals)
      text.add(" {0}//{0}", i + 1);
    else if (uvs)
      text.add(" {0}/{0}", i + 1);
    else
      text.add(" {}", i + 1);
  };
  std::size_t slot = mesh.slot_names.size(); // none yet
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t its = mesh.material_slots.empty() ? 0 : mesh.material_slots[i];
    if (its != slot && !mesh.slot_names[its].empty()) text.add("usemtl {}\n", mesh.slot_names[its]);
    slot = its;
    text.add("f");
    for (int c = 0; c < 3; ++c) corner(mesh.triangles[i][c]);
    text.add("\n");
  }
  text.flush();
  file.commit();
}

} // namespace candela
