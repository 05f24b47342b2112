#pragma once

#include <string>
#include <string_view>

namespace candela {

/// `candela settings [--json|--markdown]`: prints the settings table, by default as aligned text. Returns 0.
int run_settings(bool json, bool markdown);

/// The printed text. The Markdown form is the table in scenes/settings.md.
std::string settings_text();
std::string settings_json();
std::string settings_markdown();
/// Escapes characters that would end a cell of a Markdown table or be read as HTML.
std::string markdown_cell(std::string_view text);

} // namespace candela
