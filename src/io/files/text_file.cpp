#include "io/files/text_file.h"

#include "io/files/file_bytes.h"
#include "io/files/warning_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace candela {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
/// Bytes processed between two checks for cancellation.
constexpr std::size_t kChunk = std::size_t{16} << 20;

/// Calls work(begin, end) for the pieces of [0, size).
template <class Work>
void in_pieces(std::size_t size, const WarningList* warnings, Work work) {
  for (std::size_t begin = 0; begin < size; begin += kChunk) {
    if (warnings) warnings->check_stop();
    work(begin, std::min(begin + kChunk, size));
  }
}

void append_utf8(std::string& out, std::uint32_t c) {
  auto follow = [&](int shift) { out += static_cast<char>(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xc0 | c >> 6), follow(0);
  } else if (c < 0x10000) {
    out += static_cast<char>(0xe0 | c >> 12), follow(6), follow(0);
  } else {
    out += static_cast<char>(0xf0 | c >> 18), follow(12), follow(6), follow(0);
  }
}

/// Converts UTF-16 with a byte order mark to UTF-8. Unpaired surrogates become U+FFFD.
std::string utf8_from_utf16(std::string_view text, const WarningList* warnings) {
  const bool big_endian = text[0] == '\xfe';
  auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(text[i]), b = static_cast<unsigned char>(text[i + 1]);
    return static_cast<std::uint32_t>(big_endian ? a << 8 | b : b << 8 | a);
  };
  std::string out;
  for (std::size_t i = 2; i + 1 < text.size(); i += 2) {
    if (warnings) warnings->check_stop();
    std::uint32_t c = unit(i);
    if (c >= 0xd800 && c < 0xe000) {
      const std::uint32_t low = c < 0xdc00 && i + 3 < text.size() ? unit(i + 2) : 0;
      const bool pair = low >= 0xdc00 && low < 0xe000;
      c = pair ? 0x10000 + ((c - 0xd800) << 10 | (low - 0xdc00)) : 0xfffd;
      if (pair) i += 2;
    }
    append_utf8(out, c);
  }
  return out;
}

void drop_front(std::string& text, std::size_t count, const WarningList* warnings) {
  const std::size_t left = text.size() - count;
  in_pieces(left, warnings, [&](std::size_t begin, std::size_t end) {
    std::memmove(text.data() + begin, text.data() + count + begin, end - begin);
  });
  text.resize(left);
}

void drop_end(std::string& text, const std::string& path, WarningList* warnings) {
  auto is_filler = [](char c) { return c == '\0' || c == '\x1a'; };
  std::size_t end = text.size();
  while (end > 0 && is_filler(text[end - 1])) --end;
  if (end < text.size() && warnings)
    warnings->add({path}, fmt::format("{} bytes at the end that are no text are ignored", text.size() - end));
  text.resize(end);
  if (text.size() > kByteOrderMark.size() && text.ends_with(kByteOrderMark))
    text.resize(text.size() - kByteOrderMark.size());
}

} // namespace

std::string read_text_file(const std::string& path, const char* element, std::size_t max_bytes,
                           WarningList* warnings) {
  const Progress* progress = warnings ? &warnings->progress() : nullptr;
  std::string text = read_file_characters(path, element, max_bytes, progress);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) text = utf8_from_utf16(text, warnings);
  drop_end(text, path, warnings);
  if (text.starts_with(kByteOrderMark)) drop_front(text, kByteOrderMark.size(), warnings);
  in_pieces(text.size(), warnings, [&](std::size_t begin, std::size_t end) {
    if (const void* nul = std::memchr(text.data() + begin, 0, end - begin))
      throw input_error(
          locate(path, text, static_cast<std::size_t>(static_cast<const char*>(nul) - text.data())), element,
          "a NUL byte: this is no text file", "give a text file in UTF-8");
  });
  return text;
}

Location locate(const std::string& file, std::string_view text, std::size_t offset) {
  std::string_view before = text.substr(0, std::min(offset, text.size()));
  auto line = 1 + std::count(before.begin(), before.end(), '\n');
  auto last_break = before.rfind('\n');
  std::size_t column = last_break == std::string_view::npos ? before.size() + 1 : before.size() - last_break;
  return {file, static_cast<int>(line), static_cast<int>(column)};
}

std::string_view trimmed(std::string_view text) {
  auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

namespace {

/// Length of the valid UTF-8 sequence at the start (RFC 3629), 0 if there is none.
std::size_t sequence_length(std::string_view s) {
  auto byte = [&](std::size_t i) {
    return i < s.size() ? static_cast<unsigned>(static_cast<unsigned char>(s[i])) : 0u;
  };
  auto follows = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
  unsigned a = byte(0);
  if (a < 0x80) return 1;
  if (a >= 0xc2 && a <= 0xdf) return follows(1) ? 2 : 0;
  if (a >= 0xe0 && a <= 0xef) {
    bool overlong = a == 0xe0 && byte(1) < 0xa0, surrogate = a == 0xed && byte(1) > 0x9f;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (a >= 0xf0 && a <= 0xf4) {
    bool overlong = a == 0xf0 && byte(1) < 0x90, too_large = a == 0xf4 && byte(1) > 0x8f;
    return follows(1) && follows(2) && follows(3) && !overlong && !too_large ? 4 : 0;
  }
  return 0;
}

} // namespace

std::string utf8_name(std::string_view bytes) {
  std::string out;
  while (!bytes.empty()) {
    std::size_t n = sequence_length(bytes);
    if (n > 0) {
      out += bytes.substr(0, n);
      bytes.remove_prefix(n);
    } else {
      auto c = static_cast<unsigned char>(bytes[0]);
      out += static_cast<char>(0xc0 | (c >> 6));
      out += static_cast<char>(0x80 | (c & 0x3f));
      bytes.remove_prefix(1);
    }
  }
  return out;
}

std::string lower_ending(std::string_view path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

} // namespace candela
