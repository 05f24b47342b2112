#pragma once

#include <string>
#include <string_view>

namespace candela {

/// `candela settings [--json|--markdown]`: prints the settings table, by default as aligned text. Returns 0.
int run_settings(bool json, bool markdown);

/// What it prints. The Markdown form is the table in scenes/settings.md.
std::string settings_text();
std::string settings_json();
std::string settings_markdown();
/// The text with what would end a cell of a Markdown table or be taken for HTML escaped.
std::string markdown_cell(std::string_view text);

} // namespace candela
