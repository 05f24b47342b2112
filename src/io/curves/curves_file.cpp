#include "io/curves/curves_file.h"

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

namespace candela {

namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(vec3) == 3 * sizeof(float));

constexpr std::string_view kMagic = "CNDLCRVS";

struct Header {
  std::uint32_t version = 1, basis = 0, strands = 0, points = 0, widths = 0;
};
constexpr std::size_t kHeaderBytes = kMagic.size() + sizeof(Header);

Error wrong(const std::string& path, std::string_view element, std::string_view cause) {
  return input_error({path}, element, cause, "write it again, as src/io/curves/curves_file.h describes it");
}

template <class T>
std::vector<T> take(ByteView& bytes, std::size_t count) {
  std::vector<T> out(count);
  if (count > 0) std::memcpy(out.data(), bytes.data(), count * sizeof(T));
  bytes = bytes.subspan(count * sizeof(T));
  return out;
}

template <class T>
void append(Bytes& bytes, const T* values, std::size_t count) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(values);
  bytes.insert(bytes.end(), begin, begin + count * sizeof(T));
}

} // namespace

std::shared_ptr<const Strands> read_curves_file(const std::string& path, WarningList& warnings) {
  const Bytes file = read_file_bytes(path, "curves", &warnings.progress());
  const ProgressPart part = warnings.part(path, file.size());
  ByteView bytes(file);
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    throw wrong(path, "header", "it is no file of curves");
  bytes = bytes.subspan(kMagic.size());
  Header header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  bytes = bytes.subspan(sizeof(header));
  if (header.version != 1) throw wrong(path, "version", fmt::format("{} is not known", header.version));
  if (header.basis > 1) throw wrong(path, "basis", fmt::format("{} is not 0 or 1", header.basis));
  if (header.widths != 2 && header.widths != header.points)
    throw wrong(path, "widths",
                fmt::format("there are {} for {} control points", header.widths, header.points));
  const std::uint64_t expected = 4 * std::uint64_t{header.strands} + 12 * std::uint64_t{header.points} +
                                 4 * std::uint64_t{header.widths};
  if (bytes.size() != expected)
    throw wrong(path, "size",
                fmt::format("{} bytes follow the header, which tells of {}", bytes.size(), expected));
  Strands strands;
  strands.source = path;
  strands.basis = header.basis == 0 ? CurveBasis::bspline : CurveBasis::bezier;
  strands.counts = take<std::uint32_t>(bytes, header.strands);
  warnings.check_stop();
  strands.points = take<vec3>(bytes, header.points);
  warnings.check_stop();
  strands.widths = take<float>(bytes, header.widths);
  if (strands.counts.empty()) throw wrong(path, "strands", "there are none");
  if (const std::string problem = strands_problem(strands); !problem.empty()) {
    const std::size_t colon = problem.find(':');
    throw wrong(path, problem.substr(0, colon), problem.substr(colon + 2));
  }
  return std::make_shared<const Strands>(std::move(strands));
}

void write_curves_file(const Strands& strands, const std::string& path) {
  Header header;
  header.basis = strands.basis == CurveBasis::bspline ? 0 : 1;
  header.strands = static_cast<std::uint32_t>(strands.counts.size());
  header.points = static_cast<std::uint32_t>(strands.points.size());
  header.widths = static_cast<std::uint32_t>(strands.widths.size());
  Bytes bytes;
  append(bytes, kMagic.data(), kMagic.size());
  append(bytes, &header, 1);
  append(bytes, strands.counts.data(), strands.counts.size());
  append(bytes, strands.points.data(), strands.points.size());
  append(bytes, strands.widths.data(), strands.widths.size());
  write_file_atomically(path, ByteView(bytes));
}

} // namespace candela
